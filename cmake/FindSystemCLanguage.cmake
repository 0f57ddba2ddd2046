# Finds SystemC and defines SystemC::systemc, as SystemC's own CMake package does. That package is used where it is
# installed; distributions that build SystemC with autotools (Debian's libsystemc-dev) ship a pkg-config file only.
# What includes SystemC has to have its standard of C++ (SystemC_CXX_STANDARD of its package, else 17), which is part of
# the names that it links with.
find_package(SystemCLanguage CONFIG QUIET)
if(NOT SystemC_CXX_STANDARD)
  set(SystemC_CXX_STANDARD 17)
endif()
if(TARGET SystemC::systemc)
  return()
endif()

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PC_SYSTEMC QUIET systemc)
endif()
find_path(SystemC_INCLUDE_DIR systemc HINTS ${PC_SYSTEMC_INCLUDE_DIRS} ENV SYSTEMC_HOME PATH_SUFFIXES include)
find_library(SystemC_LIBRARY systemc
  HINTS ${PC_SYSTEMC_LIBRARY_DIRS} ENV SYSTEMC_HOME PATH_SUFFIXES lib lib-linux64 lib-linuxaarch64)
mark_as_advanced(SystemC_INCLUDE_DIR SystemC_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SystemCLanguage
  REQUIRED_VARS SystemC_LIBRARY SystemC_INCLUDE_DIR
  VERSION_VAR PC_SYSTEMC_VERSION
  REASON_FAILURE_MESSAGE "install libsystemc-dev, or set SYSTEMC_HOME")

if(SystemCLanguage_FOUND)
  add_library(SystemC::systemc UNKNOWN IMPORTED)
  set_target_properties(SystemC::systemc PROPERTIES
    IMPORTED_LOCATION "${SystemC_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${SystemC_INCLUDE_DIR}"
    INTERFACE_COMPILE_FEATURES cxx_std_17)
endif()
