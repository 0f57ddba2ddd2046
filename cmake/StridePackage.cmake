# What `cpack` makes of the installed tree: a .deb for the Debian that builds it, and a .tar.gz for any folder.
set(CPACK_PACKAGE_VENDOR "the stride authors")
set(CPACK_PACKAGE_CONTACT "the stride authors <stride@stride.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
string(CONCAT CPACK_PACKAGE_DESCRIPTION
  "stride runs units of FMI 1.0, 2.0 and 3.0 as a system file of SSP wires them. Among\n"
  "those that come with it are a robot's world in MuJoCo, channels, a reader and a\n"
  "sensor in SystemC; a kit makes more of them.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "cmake, g++, libosmesa6, libsystemc-dev")  # to make units, and films
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/StridePackageDepends.cmake")
include(CPack)
