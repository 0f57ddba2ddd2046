// Libraries that an FMU brings along for its own library.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_COMPANION_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_COMPANION_H

#include <filesystem>
#include <string>
#include <vector>

namespace stride::importer {

/// Where an FMU may have a library that its own needs by this name: beside it, in the folders
/// below, or in the resources; empty if there is none. A name with folders, as it was on another
/// machine, is looked for without them, and one with a version, "libx.so.1", also with less or more
/// of it, since archives have no links.
std::filesystem::path find_companion(const std::filesystem::path& library, const std::string& name);

/// The files of this name anywhere in the FMU, relative to its top: for messages.
std::vector<std::string> find_namesakes(const std::filesystem::path& library,
                                        const std::string& name);

/// While it lives, the loader takes a library that is loaded for the one of this name, whatever its
/// file and its own name (SONAME) are called. The library must outlive it; nothing else may load
/// libraries meanwhile.
class LoaderName {
 public:
  LoaderName(void* handle, std::string name);
  ~LoaderName();
  LoaderName(const LoaderName&) = delete;
  LoaderName& operator=(const LoaderName&) = delete;

 private:
  std::string name_;
  char** place_ = nullptr;
  char* before_ = nullptr;
};

}  // namespace stride::importer

#endif
