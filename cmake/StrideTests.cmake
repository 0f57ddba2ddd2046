# stride_add_test(NAME SOURCES file... [LIBRARIES target...] [FMUS unit...])
#
# One Catch2 executable, run by ctest under its name. FMUS are units that the test loads: they are built before it, and
# their folders are known to it as STRIDE_FMU_DIR (this repository's units) and STRIDE_TEST_FMU_DIR (units for tests).
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

function(stride_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LIBRARIES;FMUS")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} stride_catch_main)
  target_compile_definitions(${name} PRIVATE
    STRIDE_FMU_DIR="${CMAKE_BINARY_DIR}/units"
    STRIDE_TEST_FMU_DIR="${CMAKE_BINARY_DIR}/tests/units"
    STRIDE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_compile_options(${name} PRIVATE ${stride_test_flags})
  stride_use_test_headers(${name})
  foreach(unit IN LISTS arg_FMUS)
    add_dependencies(${name} ${unit}_fmu)
  endforeach()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT 300)
endfunction()

# stride_parallel_tests(NAME...)
#
# Tests with several threads: the label `parallel` and the target `parallel_tests`, for the build with the thread
# sanitizer.
add_custom_target(parallel_tests)
function(stride_parallel_tests)
  set_tests_properties(${ARGV} PROPERTIES LABELS parallel)
  add_dependencies(parallel_tests ${ARGV})
endfunction()
