#include "master/loader/fmu/library/unpacked_fmu.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/archive/displaced_file.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDescription = "modelDescription.xml";

[[noreturn]] void fail_without_description(const std::string& shown_as, const fs::path& folder,
                                           const std::vector<fs::path>& found,
                                           const core::Location& where) {
  std::vector<std::string> names;
  for (const fs::path& file : found) names.push_back(file.lexically_relative(folder).string());
  core::fail_input(
      {.where = where},
      fmt::format("'{}' has no {} at its top{}", shown_as, kDescription,
                  names.empty() ? "" : ", and several below: " + core::quoted(names)),
      names.empty()
          ? "expected an FMU; an SSP package or another kind of archive cannot be used as a unit"
          : "these are several FMUs: pack the contents of each folder as one of its own");
}

}  // namespace

UnpackedFmu::UnpackedFmu(const fs::path& path, const core::Location& where,
                         const fs::path& shown_as, const archive::UnpackLimits& limits)
    : archive_(path, "an FMU: a .fmu archive (zip), or the folder that such an archive unpacks to",
               where, limits, shown_as.string()) {
  const std::string shown = (shown_as.empty() ? path : shown_as).string();
  const std::vector<fs::path> found = archive::find_files(archive_.folder(), kDescription);
  if (found.size() != 1) fail_without_description(shown, archive_.folder(), found, where);
  description_ = found.front();  // reading it checks the rest
  if (description_ == archive_.folder() / kDescription) return;
  warning_ = core::to_text({.where = where}) +
             archive::displaced_text(shown, kDescription, archive_.folder(), description_);
}

void add_fmu(archive::Contents& contents, const UnpackedFmu& fmu) {
  archive::add_folder(contents, "", fmu.folder());
  auto description = contents.extract(fmu.description().filename().string());
  description.key() = kDescription;
  contents.insert(std::move(description));
}

}  // namespace stride::importer
