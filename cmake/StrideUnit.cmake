# stride_add_unit(NAME SOURCES file... [LIBRARIES target...] [RESOURCES folder] [BUNDLE file...])
#
# Builds a shared library from a unit's sources (a class derived from stride::Unit and STRIDE_UNIT(Class)), asks it for
# its modelDescription.xml and packs NAME.fmu into ${CMAKE_BINARY_DIR}/units (or STRIDE_UNIT_DIR, if set). RESOURCES is
# the FMU's resources folder; BUNDLE names shared libraries that go into the archive beside the unit's own.
#
# stride_add_systemc_unit(NAME SOURCES file... [LIBRARIES target...] [RESOURCES folder] [BUNDLE file...])
#
# The same for a unit that is made with the SystemC kit, which is linked and goes into the archive.
#
# stride_pack_unit(NAME UNIT unit RESOURCES folder)
#
# Packs the library of an existing unit with other resources, as NAME.fmu.
#
# stride_pack_program(NAME DECLARATION file.xml [DEPENDS target or file...])
#
# Packs the program that the file declares, with the files that it names, as NAME.fmu (docs/process-protocol.md).
#
# stride_pack_python_unit(NAME FILE file.py [CLASS class] [PYTHON program] [FILES file...])
#
# Packs a class of Python, with other files that it needs, as NAME.fmu (docs/python-units.md). PYTHON runs it.

function(stride_add_unit name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "RESOURCES" "SOURCES;LIBRARIES;BUNDLE")
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "stride_add_unit(${name}): SOURCES is missing")
  endif()
  add_library(${name} MODULE ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES
    PREFIX ""
    SUFFIX ".so"
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    BUILD_RPATH "$ORIGIN"
    BUILD_WITH_INSTALL_RPATH ON
    INSTALL_RPATH "$ORIGIN"
    STRIDE_BUNDLE "${arg_BUNDLE}"
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  target_compile_definitions(${name} PRIVATE STRIDE_UNIT_NAME="${name}")
  target_link_libraries(${name} PRIVATE "$<LINK_LIBRARY:WHOLE_ARCHIVE,stride::unit>" ${arg_LIBRARIES})
  target_link_options(${name} PRIVATE
    "LINKER:--version-script=${STRIDE_UNIT_EXPORTS}" "LINKER:--no-undefined")
  set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS "${STRIDE_UNIT_EXPORTS}")
  stride_pack_unit(${name} UNIT ${name} RESOURCES "${arg_RESOURCES}")
endfunction()

function(stride_add_systemc_unit name)
  if(NOT TARGET stride::systemc)
    message(FATAL_ERROR "stride_add_systemc_unit(${name}): the SystemC kit is missing; outside of stride's own build "
      "use find_package(stride REQUIRED COMPONENTS systemc)")
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "RESOURCES" "SOURCES;LIBRARIES;BUNDLE")
  set(resources "")
  if(arg_RESOURCES)
    set(resources RESOURCES "${arg_RESOURCES}")
  endif()
  stride_add_unit(${name} SOURCES ${arg_SOURCES} ${resources}
    LIBRARIES stride::systemc ${arg_LIBRARIES}
    BUNDLE "$<TARGET_FILE:stride::systemc>" ${arg_BUNDLE})
endfunction()

function(stride_pack_unit name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "UNIT;RESOURCES" "")
  if(NOT arg_UNIT)
    message(FATAL_ERROR "stride_pack_unit(${name}): UNIT is missing")
  endif()
  set(options "")
  set(inputs "")
  if(arg_RESOURCES)
    cmake_path(ABSOLUTE_PATH arg_RESOURCES BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    file(GLOB_RECURSE inputs CONFIGURE_DEPENDS "${arg_RESOURCES}/*")
    list(APPEND options --resources "${arg_RESOURCES}")
  endif()
  get_target_property(bundle ${arg_UNIT} STRIDE_BUNDLE)
  foreach(library IN LISTS bundle)
    list(APPEND options --bundle "${library}")
  endforeach()
  stride_run_pack(${name} "$<TARGET_FILE:${arg_UNIT}>" OPTIONS ${options} DEPENDS ${arg_UNIT} ${inputs})
endfunction()

function(stride_pack_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "DECLARATION" "DEPENDS")
  if(NOT arg_DECLARATION)
    message(FATAL_ERROR "stride_pack_program(${name}): DECLARATION is missing")
  endif()
  cmake_path(ABSOLUTE_PATH arg_DECLARATION BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  if(TARGET process_fmu)
    list(APPEND arg_DEPENDS process_fmu)
  endif()
  stride_run_pack(${name} "${arg_DECLARATION}" DEPENDS "${arg_DECLARATION}" ${arg_DEPENDS})
endfunction()

function(stride_pack_python_unit name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FILE;CLASS;PYTHON" "FILES")
  if(NOT arg_FILE)
    message(FATAL_ERROR "stride_pack_python_unit(${name}): FILE is missing")
  endif()
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
  set(options "")
  set(inputs "")
  foreach(file IN LISTS arg_FILE arg_FILES)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    list(APPEND inputs "${file}")
  endforeach()
  list(POP_FRONT inputs source)
  foreach(file IN LISTS inputs)
    list(APPEND options --file "${file}")
  endforeach()
  if(arg_CLASS)
    list(APPEND options --class "${arg_CLASS}")
  endif()
  if(arg_PYTHON)
    list(APPEND options --python "${arg_PYTHON}")
  endif()
  if(TARGET process_fmu)
    list(APPEND inputs process_fmu)
  endif()
  file(GLOB package "${STRIDE_PYTHON_DIR}/stride/unit/*.py")
  stride_make_fmu(${name}
    COMMAND ${CMAKE_COMMAND} -E env "PYTHONPATH=${STRIDE_PYTHON_DIR}" PYTHONDONTWRITEBYTECODE=1
      "STRIDE_PREFIX=$<PATH:GET_PARENT_PATH,$<TARGET_FILE_DIR:stride::stride>>"
      "${Python3_EXECUTABLE}" -m stride.unit "${source}" ${options}
    DEPENDS "${source}" ${inputs} ${package})
endfunction()

# `stride pack FILE`, as a target NAME_fmu.
function(stride_run_pack name file)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "OPTIONS;DEPENDS")
  stride_make_fmu(${name} COMMAND stride::stride pack "${file}" ${arg_OPTIONS} DEPENDS ${arg_DEPENDS})
endfunction()

# A target NAME_fmu, whose command gets `--output NAME.fmu` appended.
function(stride_make_fmu name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "COMMAND;DEPENDS")
  set(folder "${CMAKE_BINARY_DIR}/units")
  if(STRIDE_UNIT_DIR)
    set(folder "${STRIDE_UNIT_DIR}")
  endif()
  set(fmu "${folder}/${name}.fmu")
  add_custom_command(OUTPUT "${fmu}"
    COMMAND ${CMAKE_COMMAND} -E make_directory "${folder}"
    COMMAND ${arg_COMMAND} --output "${fmu}"
    DEPENDS stride::stride ${arg_DEPENDS}
    COMMENT "Packing ${name}.fmu"
    VERBATIM)
  add_custom_target(${name}_fmu ALL DEPENDS "${fmu}")
  set_property(GLOBAL APPEND PROPERTY STRIDE_FMUS "${fmu}")
endfunction()
