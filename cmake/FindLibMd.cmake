# Finds libmd, the message digests of the BSD systems (Debian's libmd-dev), and defines LibMd::md.
find_path(LibMd_INCLUDE_DIR sha2.h)
find_library(LibMd_LIBRARY md)
mark_as_advanced(LibMd_INCLUDE_DIR LibMd_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LibMd
  REQUIRED_VARS LibMd_LIBRARY LibMd_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libmd-dev")

if(LibMd_FOUND AND NOT TARGET LibMd::md)
  add_library(LibMd::md UNKNOWN IMPORTED)
  set_target_properties(LibMd::md PROPERTIES
    IMPORTED_LOCATION "${LibMd_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${LibMd_INCLUDE_DIR}")
endif()
