# Read by cpack when the files to be packed are together: which packages the program and the units need. CPack could ask
# dpkg-shlibdeps by itself, but that does not look into FMUs.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps REQUIRED)
set(work "${CPACK_TOPLEVEL_DIRECTORY}/depends")
file(REMOVE_RECURSE "${work}")
file(WRITE "${work}/debian/control" "")  # it has to be there
file(GLOB_RECURSE fmus "${CPACK_TEMPORARY_DIRECTORY}/*.fmu")
foreach(fmu IN LISTS fmus)
  cmake_path(GET fmu STEM name)
  file(ARCHIVE_EXTRACT INPUT "${fmu}" DESTINATION "${work}/${name}" PATTERNS "binaries/*")
endforeach()
file(GLOB_RECURSE binaries "${work}/*.so" "${CPACK_TEMPORARY_DIRECTORY}/*.so" "${CPACK_TEMPORARY_DIRECTORY}/*/bin/*")
list(TRANSFORM binaries PREPEND "-e")
# libraries of stride's own are in no package
execute_process(COMMAND "${DPKG_SHLIBDEPS}" -O --ignore-missing-info ${binaries}
  WORKING_DIRECTORY "${work}" OUTPUT_VARIABLE found ERROR_VARIABLE said RESULT_VARIABLE failed)
if(failed OR NOT found MATCHES "shlibs:Depends=([^\n]+)")
  message(FATAL_ERROR "It is not known which packages the program and the units need:\n${said}")
endif()
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
file(REMOVE_RECURSE "${work}")
