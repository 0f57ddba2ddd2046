# What `cmake --install` puts where: the program, the public headers and the kits, a package for find_package(stride), and
# the units and scenarios as examples.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/stride")

install(TARGETS stride_cli EXPORT stride RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS stride_api EXPORT stride LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
configure_file(cmake/stride.pc.in "${PROJECT_BINARY_DIR}/stride.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/stride.pc" DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
# lib, whatever the libraries' folder is called here: the program looks in ../lib/stride beside itself
install(TARGETS stride_optimisers LIBRARY DESTINATION lib/stride)
if(TARGET stride_robot)
  install(TARGETS stride_robot RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY "${STRIDE_REFERENCE_DIR}/man/" DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1")
install(FILES "${STRIDE_REFERENCE_DIR}/stride" DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES "${STRIDE_REFERENCE_DIR}/_stride" DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES "${STRIDE_REFERENCE_DIR}/stride.fish" DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(TARGETS stride_interfaces stride_unit stride_program EXPORT stride
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY interfaces/stride DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY units/process/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES interfaces/schemas/org.stride.idle.xsd DESTINATION ${CMAKE_INSTALL_DATADIR}/stride/schemas)
install(EXPORT stride NAMESPACE stride:: FILE strideTargets.cmake DESTINATION ${package_dir})

# the components of the package
if(STRIDE_BUILD_UNITS)
  foreach(component IN ITEMS nfc systemc)
    install(TARGETS stride_${component} EXPORT stride_${component}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT stride_${component}
      NAMESPACE stride:: FILE stride-${component}.cmake DESTINATION ${package_dir})
    install(DIRECTORY units/${component}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
  endforeach()
  install(FILES cmake/FindSystemCLanguage.cmake DESTINATION ${package_dir})
endif()

# what packs units in Python
set(python_dir "${CMAKE_INSTALL_DATADIR}/stride/python")
install(DIRECTORY python/stride DESTINATION ${python_dir} FILES_MATCHING PATTERN "*.py")

configure_package_config_file(cmake/strideConfig.cmake.in "${PROJECT_BINARY_DIR}/strideConfig.cmake"
  INSTALL_DESTINATION ${package_dir} PATH_VARS python_dir)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/strideConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/strideConfig.cmake"
  "${PROJECT_BINARY_DIR}/strideConfigVersion.cmake"
  cmake/StrideUnit.cmake
  interfaces/unit/exports.map
  DESTINATION ${package_dir})

# likewise: it looks for units in ../lib/stride/units
get_property(fmus GLOBAL PROPERTY STRIDE_FMUS)
foreach(fmu IN LISTS fmus)
  cmake_path(GET fmu PARENT_PATH folder)
  if(folder STREQUAL "${PROJECT_BINARY_DIR}/units")  # the others are made for tests
    install(FILES "${fmu}" DESTINATION lib/stride/units)
  endif()
endforeach()
# likewise: by their names it looks for them in ../share/stride/scenarios
install(DIRECTORY scenarios/ DESTINATION share/stride/scenarios USE_SOURCE_PERMISSIONS
  PATTERN CMakeLists.txt EXCLUDE
  PATTERN golden EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
