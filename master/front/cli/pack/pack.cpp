// stride pack: a library made with the unit kit, another .fmu, captured stimuli, a table or the
// declaration of a program become a .fmu, a scenario a .ssp.
#include "master/loader/fmu/pack.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/archive/zip.h"
#include "master/base/files/input_file.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/study/results/output_paths.h"
#include "master/system/declaration/scenario.h"
#include "master/system/declaration/scenario_path.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/fmu_archives.h"
#include "master/system/scenario/units/unit_path.h"
#include "master/system/ssp/package.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

bool is_scenario(const fs::path& path) {
  return core::is_folder(path) || path.extension() == ".ssd" || path.extension() == ".ssp";
}

/// A scenario may be one of a package, which is at no path of its own.
fs::path found_input(const fs::path& named) {
  if (const auto bundled = scenario::named_scenario(named)) return *bundled;
  return is_scenario(named) ? named : scenario::find_unit(named, {});
}

/// Whether a package, or the folder that one unpacks to, is named and not a system in it.
bool is_whole_package(const fs::path& named, const fs::path& system, const ssp::Files& files) {
  return core::is_folder(named) || (core::is_file(named) && files.archive_of(system));
}

/// What SSP lets a package have beside its systems and their resources.
void add_further_folders(archive::Contents& contents, const fs::path& package) {
  for (const char* const name : {"extra", "documentation"}) {
    if (core::is_folder(package / name)) {
      archive::add_folder(contents, std::string(name) + "/", package / name);
    }
  }
}

/// The other systems of a package; each is one that can be read.
std::vector<fs::path> other_variants(const fs::path& named, const fs::path& system,
                                     const std::shared_ptr<ssp::Files>& files) {
  if (!is_whole_package(named, system, *files)) return {};
  std::vector<fs::path> others = files->variants(named, system);
  std::erase(others, system);
  for (const fs::path& other : others) {
    scenario::read_scenario(other, {scenario::find_unit, {}, files});
  }
  return others;
}

/// The package replaces neither what is packed nor what is bundled with it.
void check_output_path(const importer::PackRequest& request) {
  std::vector<results::KeptPath> kept{{request.library, "what is to be packed"}};
  if (is_scenario(request.library)) kept = results::files_of_scenario(request.library).inputs;
  for (const fs::path& library : request.bundled) kept.push_back({library, "a bundled library"});
  const results::OutputPath output{"--output " + request.output.string(), request.output};
  results::refuse_kept_paths({&output, 1}, kept);
}

/// Returns warnings.
std::vector<std::string> pack_unit(const importer::PackRequest& request) {
  if (scenario::is_stimuli(request.library)) return scenario::pack_stimuli(request);
  if (scenario::is_program(request.library)) return scenario::pack_program(request);
  return importer::pack(request);
}

void pack_scenario(const importer::PackRequest& request) {
  if (!request.resources.empty() || !request.bundled.empty()) {
    core::fail_input({}, "--resources and --bundle are for the library of a unit",
                     "a scenario is packed with all that it names");
  }
  if (request.output.extension() != ".ssp") {
    core::fail_input(
        {},
        fmt::format("--output {}: a scenario becomes a package (.ssp)", request.output.string()),
        "give the output a name that ends in .ssp");
  }
  const scenario::Scenario scenario =
      scenario::read_scenario(request.library, {scenario::find_unit, {}});
  const fs::path system = scenario.files->system_file(request.library);
  const std::vector<fs::path> others = other_variants(request.library, system, scenario.files);
  scenario::FmuArchives fmus;
  archive::Contents contents =
      ssp::package_contents(system, *scenario.files, std::ref(fmus), others);
  if (is_whole_package(request.library, system, *scenario.files)) {
    add_further_folders(contents, system.parent_path());
  }
  archive::write_zip(request.output, contents);
}

}  // namespace

void add_pack(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "pack",
      "Make a .fmu from a library of the unit kit, or from another .fmu, and a resources folder, "
      "from stimuli that --capture wrote, from a table of values over time, or from the "
      "declaration of a program; or a .ssp from a scenario and all that it names");
  const auto request = std::make_shared<importer::PackRequest>();
  command
      ->add_option(
          "FILE", request->library,
          "The unit's shared library (.so) or .fmu, captured stimuli or a table (.csv, .parquet, "
          ".mcap), the declaration of a program (.xml), or a scenario (.ssd; .ssp with all systems "
          "in it, or FILE.ssp/VARIANT.ssd; or the name of one that comes with stride)")
      ->required()
      ->type_name("");
  command->add_option("--output,--out,-o", request->output, "The .fmu or .ssp to write")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--resources", request->resources, "The unit's resources: an MJCF, a program, …")
      ->type_name("FOLDER");
  command
      ->add_option("--bundle", request->bundled,
                   "Shared library to put beside the unit's own; may be given several times")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->callback([request] {
    const CrashGuard guard;
    request->library = found_input(request->library);
    check_output_path(*request);
    if (is_scenario(request->library)) return pack_scenario(*request);
    print_warnings(pack_unit(*request));
  });
}

}  // namespace stride::cli
