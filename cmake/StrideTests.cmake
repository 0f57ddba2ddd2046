# stride_add_tests(PREFIX [PROGRAM name] SOURCES pattern... [EXCEPT file...] [LIBRARIES target...] [FMUS unit...]
#   [DEPENDS target...] [DEFINITIONS macro...])
#
# The Catch2 program of a folder, PREFIX_tests unless named. SOURCES are files, or patterns of their names such as
# *_test.cpp. Each file X_test.cpp is one entry of ctest, PREFIX_X_test, which runs its test cases in a process of their
# own; other files are what the tests share. FMUS are units that the tests load: they are built before the program, and
# found with tests/build.h. DEPENDS are other targets that the tests use when they run.
#
# stride_add_test(NAME SOURCES file... ...)
#
# The same for a test that needs a program of its own: one entry of ctest, which has the program's name.
include(CheckLinkerFlag)
find_package(Catch2 2.13 REQUIRED)
check_linker_flag(CXX -fuse-ld=mold STRIDE_HAS_MOLD)  # links a test in a third of the time

set(stride_is_sanitized false)
if(STRIDE_SANITIZE)
  set(stride_is_sanitized true)
endif()

# stride_unsanitized_code(TARGET): code that is compiled alike in each build, with and without sanitizers, so that ccache
# has it for the second one
function(stride_unsanitized_code target)
  set_target_properties(${target} PROPERTIES STRIDE_UNSANITIZED ON)
  target_compile_options(${target} PRIVATE -Og -UNDEBUG)
endfunction()

# stride_test_code(TARGET): its sources are tests' own code, which is the larger part of what there is to compile, and not
# what is under test. The thread sanitizer has to see all code that takes part in threads, or it reports false races.
function(stride_test_code target)
  if(NOT STRIDE_SANITIZE MATCHES thread)
    stride_unsanitized_code(${target})
  endif()
endfunction()

# The static libraries of this repository that these link, but for tests' own code and the kit, which is not whole
# without a unit.
function(stride_libraries_under_test result)
  set(found "")
  foreach(library IN LISTS ARGN)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" library "${library}")
    if(NOT TARGET ${library})
      continue()
    endif()
    get_target_property(aliased ${library} ALIASED_TARGET)
    if(aliased)
      set(library ${aliased})
    endif()
    get_target_property(type ${library} TYPE)
    get_target_property(is_imported ${library} IMPORTED)
    get_target_property(is_test_code ${library} STRIDE_UNSANITIZED)
    get_target_property(needs_a_unit ${library} STRIDE_NEEDS_A_UNIT)
    if(type STREQUAL STATIC_LIBRARY AND NOT is_imported AND NOT is_test_code AND NOT needs_a_unit)
      list(APPEND found ${library})
    endif()
    get_target_property(links ${library} INTERFACE_LINK_LIBRARIES)
    stride_libraries_under_test(more ${links})
    list(APPEND found ${more})
  endforeach()
  list(REMOVE_DUPLICATES found)
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# stride_link_test(PROGRAM): of an inline function that a test and a library both have, the linker takes the copy that it
# sees first. That is to be the library's, with sanitizers.
function(stride_link_test program)
  if(STRIDE_HAS_MOLD)
    # RELRO of mold 1.10 ends behind what is mapped where its size is a multiple of a page, and nothing starts then
    target_link_options(${program} PRIVATE -fuse-ld=mold "LINKER:-z,norelro")
  endif()
  if(NOT STRIDE_SANITIZE MATCHES address)
    return()
  endif()
  get_target_property(libraries ${program} LINK_LIBRARIES)
  stride_libraries_under_test(libraries ${libraries})
  if(libraries)
    list(TRANSFORM libraries REPLACE "(.+)" "$<TARGET_FILE:\\1>")
    list(JOIN libraries "," libraries)
    target_link_options(${program} PRIVATE "LINKER:--whole-archive,${libraries},--no-whole-archive")
  endif()
endfunction()

add_library(stride_test_build STATIC ${CMAKE_CURRENT_SOURCE_DIR}/build.cpp)
target_compile_definitions(stride_test_build PRIVATE
  STRIDE_BUILD_FOLDER="${CMAKE_BINARY_DIR}" STRIDE_IS_SANITIZED=${stride_is_sanitized})
stride_unsanitized_code(stride_test_build)

# Debian has Catch2's own code compiled; where it is a header alone, compiling it takes as long as a folder of tests
if(TARGET Catch2::Catch2WithMain)
  add_library(stride_catch_main INTERFACE)
  target_link_libraries(stride_catch_main INTERFACE Catch2::Catch2WithMain stride_test_build)
else()
  add_library(stride_catch_main STATIC ${CMAKE_CURRENT_SOURCE_DIR}/catch_main.cpp)
  target_link_libraries(stride_catch_main PUBLIC Catch2::Catch2 stride_test_build)
  stride_unsanitized_code(stride_catch_main)
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
  target_compile_definitions(${name} PRIVATE STRIDE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ${arg_DEFINITIONS})
  stride_test_code(${name})
  stride_link_test(${name})
  stride_use_test_headers(${name})
  list(TRANSFORM arg_FMUS APPEND _fmu)
  if(arg_FMUS OR arg_DEPENDS)
    add_dependencies(${name} ${arg_FMUS} ${arg_DEPENDS})
  endif()
endfunction()

# stride_machine_tests(NAME...)
#
# Tests that watch what else a machine may have a say in: processes that are late, end or are killed, their time limits
# and memory. The label `machine`: scripts/test.sh gives them, and no others, a second chance.
function(stride_machine_tests)
  set_tests_properties(${ARGV} PROPERTIES LABELS machine)
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

# stride_thorough_tests(NAME...)
#
# Tests that install, pack or build something of their own. The label `thorough`: `scripts/test.sh --all` runs them.
function(stride_thorough_tests)
  set_tests_properties(${ARGV} PROPERTIES LABELS thorough)
endfunction()
