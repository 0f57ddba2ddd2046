#include "master/study/results/provenance.h"

#include <algorithm>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/process/host_name.h"
#include "master/study/results/output_paths.h"
#include "master/system/scenario/remote_units.h"

namespace stride::results {

std::string utc_text(std::time_t time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(time));
}

recorders::Provenance provenance_of(const scenario::RunPlan& loaded, recorders::Command command,
                                    core::FileDigests& digests) {
  recorders::Provenance made{.version = STRIDE_VERSION,
                             .date = utc_text(std::time(nullptr)),
                             .host = core::host_name(),
                             .commands = {std::move(command)},
                             .swaps = loaded.changes().swaps,
                             .values = loaded.changes().values};
  const auto add_source = [&](recorders::Source source) {
    if (std::ranges::find(made.sources, source) == made.sources.end()) {
      made.sources.push_back(std::move(source));
    }
  };
  const auto add = [&](const std::string& what, const std::filesystem::path& path) {
    add_source(recorders::make_source(what, path, digests));
  };
  for (const KeptPath& input : inputs_of(loaded)) {
    if (core::path_exists(input.path)) add(input.what, input.path);  // else a unit in a package
  }
  for (const auto& fmu : loaded.fmus()) {
    const bool is_library = fmu->path().extension() == ".so";
    if (is_library && core::is_folder(fmu->resources())) {
      add("the resources of " + fmu->path().filename().string(), fmu->resources());
    }
  }
  for (std::size_t i = 0; i < loaded.fmus().size(); ++i) {
    if (!loaded.stays_elsewhere(i)) continue;
    const importer::Fmu& fmu = *loaded.fmus()[i];
    add_source({"the description of a unit on another machine", fmu.path(),
                scenario::description_digest(fmu)});
  }
  return made;
}

void require_same(const recorders::Provenance& before, const recorders::Provenance& now,
                  const std::filesystem::path& checkpoint) {
  const std::vector<std::string> texts = recorders::differences(before, now);
  if (texts.empty()) return;
  core::fail_input({.where = {checkpoint.string(), 0}},
                   fmt::format("the checkpoint is of another run: {}", fmt::join(texts, "; ")),
                   "put back what was changed, or let the run begin at its start");
}

void restore_units(checkpoint::Journals& journals, const checkpoint::Checkpoint& from,
                   const std::filesystem::path& checkpoint) {
  try {
    journals.restore(from);
  } catch (const core::BadState& mistake) {
    fail_checkpoint(checkpoint, mistake);
  }
}

void fail_checkpoint(const std::filesystem::path& checkpoint, const core::BadState& mistake) {
  core::fail_input(
      {.where = {checkpoint.string(), 0}},
      fmt::format("the checkpoint is not one of this run, or damaged: {}", mistake.what()),
      "name another checkpoint, or let the run begin at its start");
}

}  // namespace stride::results
