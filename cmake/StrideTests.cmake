# stride_add_tests(PREFIX [PROGRAM name] SOURCES pattern... [EXCEPT file...] [LIBRARIES target...] [FMUS unit...]
#   [DEPENDS target...] [DEFINITIONS macro...])
#
# The Catch2 program of a folder, PREFIX_tests unless named. SOURCES are files, or patterns of their names such as
# *_test.cpp. Each file X_test.cpp is one entry of ctest, PREFIX_X_test, which runs its test cases in a process of their
# own; other files are what the tests share. FMUS are units that the tests load: they are built before the program, and
# their folders are known to it as STRIDE_FMU_DIR (this repository's units) and STRIDE_TEST_FMU_DIR (units for tests).
# DEPENDS are other targets that the tests use when they run.
#
# stride_add_test(NAME SOURCES file... ...)
#
# The same for a test that needs a program of its own: one entry of ctest, which has the program's name.
find_package(Catch2 2.13 REQUIRED)

add_library(stride_catch_main STATIC ${CMAKE_CURRENT_SOURCE_DIR}/catch_main.cpp)
target_link_libraries(stride_catch_main PUBLIC Catch2::Catch2)
target_compile_options(stride_catch_main PRIVATE -w)  # GCC 12 warns of Catch2 itself under sanitizers

set(stride_test_flags -O0)  # checks are long to optimise, and run once
if(STRIDE_SANITIZE MATCHES undefined)
  # in a test's own code, where these are a fifth of the compile time; the libraries under test keep them
  list(APPEND stride_test_flags -fno-sanitize=null,alignment,vptr,object-size)
endif()

include(StrideTestHeaders)

function(stride_add_tests prefix)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PROGRAM" "SOURCES;EXCEPT;LIBRARIES;FMUS;DEPENDS;DEFINITIONS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "stride_add_tests(${prefix}): ${arg_UNPARSED_ARGUMENTS} belongs to nothing")
  endif()
  set(program ${prefix}_tests)
  if(arg_PROGRAM)
    set(program ${arg_PROGRAM})
  endif()
  file(GLOB sources RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${arg_SOURCES})
  list(REMOVE_ITEM sources ${arg_EXCEPT})
  stride_add_test_program(${program}
    SOURCES ${sources}
    LIBRARIES ${arg_LIBRARIES}
    FMUS ${arg_FMUS}
    DEPENDS ${arg_DEPENDS}
    DEFINITIONS ${arg_DEFINITIONS})
  set(tests "")
  foreach(source IN LISTS sources)
    cmake_path(GET source STEM test)
    if(NOT test MATCHES "_test$")
      continue()
    endif()
    if(test IN_LIST tests)  # Catch2 knows the file's name only
      message(FATAL_ERROR "stride_add_tests(${prefix}): two sources are called ${test}.cpp")
    endif()
    list(APPEND tests ${test})
    add_test(NAME ${prefix}_${test} COMMAND ${program} --filenames-as-tags --warn NoTests "[#${test}]")
    set_tests_properties(${prefix}_${test} PROPERTIES TIMEOUT 300)
  endforeach()
endfunction()

function(stride_add_test name)
  stride_add_test_program(${name} ${ARGN})
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT 300)
endfunction()

function(stride_add_test_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES;FMUS;DEPENDS;DEFINITIONS")
  if(NOT arg_SOURCES OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${name}: SOURCES is missing, or there is something else: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} stride_catch_main)
  target_compile_definitions(${name} PRIVATE
    STRIDE_FMU_DIR="${CMAKE_BINARY_DIR}/units"
    STRIDE_TEST_FMU_DIR="${CMAKE_BINARY_DIR}/tests/units"
    STRIDE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    ${arg_DEFINITIONS})
  target_compile_options(${name} PRIVATE ${stride_test_flags})
  stride_use_test_headers(${name})
  list(TRANSFORM arg_FMUS APPEND _fmu)
  if(arg_FMUS OR arg_DEPENDS)
    add_dependencies(${name} ${arg_FMUS} ${arg_DEPENDS})
  endif()
endfunction()

# stride_parallel_tests(NAME...)
#
# Tests with several threads, in programs of their own: the label `parallel` and the target `parallel_tests`, for the
# build with the thread sanitizer.
add_custom_target(parallel_tests)
function(stride_parallel_tests)
  set_tests_properties(${ARGV} PROPERTIES LABELS parallel)
  add_dependencies(parallel_tests ${ARGV})
endfunction()
