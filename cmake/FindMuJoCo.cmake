# Finds MuJoCo 2.2 (Debian's libmujoco-dev) or MuJoCo 3: in an official release, or in the Python package `mujoco`,
# which holds the headers and the library, too. For the latter set MuJoCo_ROOT to the folder `mujoco` of the package
# (scripts/fetch_mujoco3.sh fetches one).
#
#   MuJoCo::mujoco   imported target
#   MuJoCo_VERSION   from the header, such as 2.2.2 or 3.17.0
#   MuJoCo_BUNDLE    the library's file if it lies below MuJoCo_ROOT and so has to travel with what uses it, else empty

find_path(MuJoCo_INCLUDE_DIR mujoco/mujoco.h)

# the header contains 222 for 2.2.2, but 3017000 for 3.17.0
set(MuJoCo_VERSION "")
foreach(header IN ITEMS mujoco.h mjmodel.h)
  if(NOT EXISTS "${MuJoCo_INCLUDE_DIR}/mujoco/${header}")
    continue()
  endif()
  file(STRINGS "${MuJoCo_INCLUDE_DIR}/mujoco/${header}" line REGEX "#define +mjVERSION_HEADER +[0-9]+")
  if(line MATCHES "mjVERSION_HEADER +([0-9]+)")
    set(number ${CMAKE_MATCH_1})
    if(number GREATER_EQUAL 1000000)
      math(EXPR major "${number} / 1000000")
      math(EXPR minor "${number} / 1000 % 1000")
      math(EXPR patch "${number} % 1000")
    else()
      math(EXPR major "${number} / 100")
      math(EXPR minor "${number} / 10 % 10")
      math(EXPR patch "${number} % 10")
    endif()
    set(MuJoCo_VERSION ${major}.${minor}.${patch})
    break()
  endif()
endforeach()

# the Python package has its library at the top, and under its full name only
find_library(MuJoCo_LIBRARY NAMES libmujoco.so.${MuJoCo_VERSION} mujoco PATH_SUFFIXES lib .)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuJoCo
  REQUIRED_VARS MuJoCo_LIBRARY MuJoCo_INCLUDE_DIR
  VERSION_VAR MuJoCo_VERSION
  REASON_FAILURE_MESSAGE "install libmujoco-dev, or set MuJoCo_ROOT to an unpacked MuJoCo 3")
mark_as_advanced(MuJoCo_LIBRARY MuJoCo_INCLUDE_DIR)

set(MuJoCo_BUNDLE "")
if(MuJoCo_FOUND AND MuJoCo_ROOT)
  cmake_path(IS_PREFIX MuJoCo_ROOT "${MuJoCo_LIBRARY}" NORMALIZE is_below)
  if(is_below)
    set(MuJoCo_BUNDLE "${MuJoCo_LIBRARY}")
  endif()
endif()

if(MuJoCo_FOUND AND NOT TARGET MuJoCo::mujoco)
  add_library(MuJoCo::mujoco SHARED IMPORTED)
  set_target_properties(MuJoCo::mujoco PROPERTIES
    IMPORTED_LOCATION "${MuJoCo_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${MuJoCo_INCLUDE_DIR}")
endif()
