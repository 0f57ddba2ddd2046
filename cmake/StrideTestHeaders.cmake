# stride_use_test_headers(NAME)
#
# Headers that nearly every test includes are compiled once per language standard, for all tests. A test's sources
# include what they use all the same: with STRIDE_PRECOMPILED_HEADERS=OFF nothing is compiled beforehand. Nor is it in a
# unity build, which reads a header so few times that it gains nothing. Units made for tests have headers of their own,
# in each build (tests/test_units).
set(stride_has_test_headers OFF)
set(stride_printed_times "${PROJECT_SOURCE_DIR}/tests/printed_times.h")  # for all tests, in each build
if(STRIDE_PRECOMPILED_HEADERS AND NOT CMAKE_UNITY_BUILD)
  set(stride_has_test_headers ON)
  # executables, because GCC takes only what was compiled with the flags of a test
  file(CONFIGURE OUTPUT empty_main.cpp CONTENT "int main() {}\n")
  foreach(standard IN ITEMS 17 20)
    set(headers stride_test_headers_${standard})
    add_executable(${headers} EXCLUDE_FROM_ALL "${CMAKE_CURRENT_BINARY_DIR}/empty_main.cpp")
    set_target_properties(${headers} PROPERTIES CXX_STANDARD ${standard})
    target_link_libraries(${headers} PRIVATE Catch2::Catch2)
    target_include_directories(${headers} PRIVATE "${PROJECT_SOURCE_DIR}/interfaces")
    stride_test_code(${headers})
    target_precompile_headers(${headers} PRIVATE
      <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map> <memory>
      <optional> <random> <set> <sstream> <stdexcept> <string> <utility> <vector> "${stride_printed_times}")
  endforeach()
endif()

# 20 if a target, or what it links, asks for it.
function(stride_standard_of result)
  set(standard 17)
  foreach(target IN LISTS ARGN)
    if(TARGET ${target})
      get_target_property(features ${target} INTERFACE_COMPILE_FEATURES)
      get_target_property(libraries ${target} INTERFACE_LINK_LIBRARIES)
      if(NOT features MATCHES cxx_std_20)
        stride_standard_of(standard ${libraries})
      else()
        set(standard 20)
      endif()
    endif()
    if(standard EQUAL 20)
      break()
    endif()
  endforeach()
  set(${result} ${standard} PARENT_SCOPE)
endfunction()

function(stride_use_test_headers name)
  get_target_property(sources ${name} SOURCES)
  if(NOT stride_has_test_headers OR sources MATCHES "\\.c(;|$)")  # there are none for C
    target_compile_options(${name} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${stride_printed_times}>")
    target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/interfaces")
    return()
  endif()
  get_target_property(libraries ${name} LINK_LIBRARIES)
  stride_standard_of(standard ${libraries})
  target_precompile_headers(${name} REUSE_FROM stride_test_headers_${standard})
endfunction()
