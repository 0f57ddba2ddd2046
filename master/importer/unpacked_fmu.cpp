#include "master/importer/unpacked_fmu.h"

#include <fmt/format.h>

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// A frequent mistake: the folder was packed, not what is in it.
std::string missing_description_hint(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (!fs::exists(entry.path() / "modelDescription.xml")) continue;
    return fmt::format(
        "it is in the folder '{0}' there; the contents of '{0}' belong at the "
        "top",
        entry.path().filename().string());
  }
  return "expected an FMU; an SSP package or another kind of archive cannot be used as a unit";
}

}  // namespace

UnpackedFmu::UnpackedFmu(const fs::path& path, const core::Location& where)
    : archive_(path, "an FMU: a .fmu archive (zip), or the folder that such an archive unpacks to",
               where) {
  if (fs::is_regular_file(folder() / "modelDescription.xml")) return;
  core::fail_input({.where = where},
                   fmt::format("'{}' has no modelDescription.xml at its top", path.string()),
                   missing_description_hint(folder()));
}

}  // namespace stride::importer
