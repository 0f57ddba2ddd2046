#include "master/importer/unpacked_fmu.h"

#include <fmt/format.h>

#include "master/util/input_file.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// A frequent mistake: the folder was packed, not what is in it.
std::string missing_description_hint(const fs::path& folder) {
  for (const fs::path& entry : core::folder_entries(folder)) {
    if (!core::path_exists(entry / "modelDescription.xml")) continue;
    return fmt::format(
        "it is in the folder '{0}' there; the contents of '{0}' belong at the "
        "top",
        entry.filename().string());
  }
  return "expected an FMU; an SSP package or another kind of archive cannot be used as a unit";
}

}  // namespace

UnpackedFmu::UnpackedFmu(const fs::path& path, const core::Location& where,
                         const fs::path& shown_as)
    : archive_(path, "an FMU: a .fmu archive (zip), or the folder that such an archive unpacks to",
               where, {}, shown_as.string()) {
  if (core::path_exists(folder() / "modelDescription.xml")) return;  // reading it checks the rest
  core::fail_input({.where = where},
                   fmt::format("'{}' has no modelDescription.xml at its top",
                               (shown_as.empty() ? path : shown_as).string()),
                   missing_description_hint(folder()));
}

}  // namespace stride::importer
