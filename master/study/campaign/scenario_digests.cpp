#include "master/study/campaign/scenario_digests.h"

#include "master/base/files/input_file.h"
#include "master/base/files/sha256.h"
#include "master/system/scenario/remote_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::campaign {

namespace fs = std::filesystem;

std::map<std::string, std::string> scenario_digests(const scenario::Scenario& scenario,
                                                    core::FileDigests& digests) {
  std::map<std::string, std::string> found;
  const fs::path around = fs::absolute(scenario.path).lexically_normal().parent_path();
  for (const fs::path& document : scenario.files->documents()) {
    if (!core::is_file(document)) continue;  // of an FMU alone, which is a unit
    const fs::path shown = fs::absolute(scenario.files->shown(document)).lexically_normal();
    found[shown.lexically_relative(around).generic_string()] = digests.of(document);
  }
  return found;
}

std::string unit_digest(const scenario::RunPlan& loaded, std::size_t component,
                        core::FileDigests& digests) {
  if (loaded.stays_elsewhere(component)) {
    return scenario::description_digest(*loaded.fmus()[component]);
  }
  const fs::path path = scenario::find_unit(loaded.scenario().sources[component], {});
  const fs::path& resources = loaded.fmus()[component]->resources();
  if (path.extension() != ".so" || !core::is_folder(resources)) return digests.of(path);
  return core::sha256(digests.of(path) + digests.of(resources));
}

}  // namespace stride::campaign
