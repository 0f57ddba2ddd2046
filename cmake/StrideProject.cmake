# Settings of this repository's own targets.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
endif()

find_program(STRIDE_CCACHE ccache)
if(STRIDE_CCACHE)
  # what two builds of one source tree compile alike, such as those for two versions of MuJoCo, is compiled once
  set(launcher ${CMAKE_COMMAND} -E env
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
    CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros  # without which nothing that uses a precompiled header is kept
    ${STRIDE_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()

set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_STANDARD 17)  # master/ uses 20
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_compile_options(-Wall -Wextra -Wpedantic)
if(CMAKE_UNITY_BUILD)
  # GCC takes a source in a unity build for a header, where a class must not have members of unnamed namespaces
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()
if(STRIDE_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC looks for memory to free whenever the heap has grown by a third; a sixth of the time, and memory is not short
  add_compile_options(--param=ggc-min-expand=200 --param=ggc-min-heapsize=524288)
endif()
if(STRIDE_SANITIZE)
  # What AddressSanitizer finds by itself, or what is nothing on this processor, would double the time to compile. A
  # target with STRIDE_UNSANITIZED is linked with libraries that have sanitizers, but has none in its own code.
  set(flags -Og -g1 -UNDEBUG -fsanitize=${STRIDE_SANITIZE} -fno-sanitize=null,alignment,vptr,object-size
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options("$<$<NOT:$<BOOL:$<TARGET_PROPERTY:STRIDE_UNSANITIZED>>>:${flags}>")
  add_link_options(-fsanitize=${STRIDE_SANITIZE})
endif()

# stride_brief_code(TARGET): what runs for moments, such as reading a command line or a system file. It is compiled with
# -Og, which takes little more than half of the time of -O2.
function(stride_brief_code target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo,Release>:-Og>)
endfunction()

include_directories(${PROJECT_SOURCE_DIR})
