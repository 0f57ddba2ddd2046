// The libraries in an unpacked FMU, and which of them is for this machine.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_BINARIES_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_BINARIES_H

#include <filesystem>
#include <string>

#include "master/base/error.h"

namespace stride::importer {

/// The name of this build's folder in binaries/: the platform tuple of FMI 3.0 ("x86_64-linux").
const char* platform();
/// Likewise that of FMI 1.0 and 2.0 ("linux64"), which knows the tuple where it has no name of its
/// own.
const char* fmi2_platform();

/// The one of them that this version of FMI has.
const char* platform_of(const std::string& fmi_version);

struct FoundLibrary {
  std::filesystem::path path;
  std::string warning;  ///< if it is not named as the standard wants it
};

/// The library in an unpacked FMU of this version, "1.0", "2.0" or "3.0". It is the one of this
/// name in the folder of this platform; if there is none, the one of the name in another case, or
/// the only one, there or in the folder that has the platform's name of the other version. The case
/// of the folders' names does not count, and the folder `binaries` may be in another one, if it is
/// not at the top. Throws core::Error of the kind Input, at `user` or at the name, that lists the
/// platforms that there are, if it is not built for this one, and states how to get such a library.
FoundLibrary find_library(const std::filesystem::path& fmu_folder, const std::string& fmi_version,
                          const std::string& model_identifier, const core::Context& user = {});

}  // namespace stride::importer

#endif
