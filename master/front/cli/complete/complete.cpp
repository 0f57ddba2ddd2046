// stride complete: adds the connectors of the units to a scenario.
#include "master/system/ssp/complete.h"

#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/archive/zip.h"
#include "master/base/files/replacement.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/study/results/output_paths.h"
#include "master/system/declaration/scenario_path.h"
#include "master/system/plan/load_units.h"
#include "master/system/scenario/units/unit_path.h"
#include "master/system/settings/scenario_options.h"

namespace stride::cli {
namespace {

struct CompleteArguments {
  std::filesystem::path scenario;
  std::filesystem::path output;
};

/// A package is packed again, with the one file changed.
void write_package(const CompleteArguments& arguments, const ssp::Files::Archive& package,
                   const std::filesystem::path& file, const std::string& text) {
  archive::Contents contents;
  archive::add_folder(contents, "", package.folder);
  contents[file.lexically_relative(package.folder).string()] = {text, {}, false};
  archive::write_zip(arguments.output.empty() ? package.path : arguments.output, contents);
}

/// The scenario itself may be replaced, unless it comes with stride, and nothing else that it
/// consists of.
void check_output_path_of(const CompleteArguments& arguments) {
  if (arguments.output.empty()) {
    if (arguments.scenario.parent_path().parent_path() != scenario::scenario_folder()) return;
    core::fail_input({.where = {arguments.scenario.string(), 0}},
                     "this scenario comes with stride, and is not changed",
                     "name the file to be written with --output");
  }
  const results::OutputPath output{"--output " + arguments.output.string(), arguments.output};
  std::vector<results::KeptPath> kept = results::files_of_scenario(arguments.scenario).inputs;
  std::erase_if(kept,
                [](const results::KeptPath& path) { return path.what == results::kTheScenario; });
  results::refuse_kept_paths({&output, 1}, kept);
}

/// The components of the scenario with what their FMUs declare, in the sizes that the scenario
/// gives their arrays.
std::vector<core::ComponentDeclaration> with_descriptions(
    const scenario::Scenario& scenario, const std::vector<std::shared_ptr<importer::Fmu>>& fmus) {
  core::SystemDeclaration system = scenario.system;
  for (std::size_t i = 0; i < fmus.size(); ++i) {
    system.components[i].description = fmus[i]->description();
  }
  const auto descriptions = core::System::sized_descriptions(system);
  for (std::size_t i = 0; i < fmus.size(); ++i) system.components[i].description = descriptions[i];
  return std::move(system.components);
}

void complete(const CompleteArguments& arguments) {
  check_output_path_of(arguments);
  const CrashGuard guard;
  const scenario::Scenario scenario =
      scenario::read_scenario(arguments.scenario, {scenario::find_unit, {}});
  const auto fmus = scenario::load_fmus(scenario);
  const LimitedEnd end;
  const std::vector<core::ComponentDeclaration> components = with_descriptions(scenario, fmus);
  ssp::Descriptions descriptions;
  for (const auto& component : components) descriptions[component.name] = component.description;
  const std::filesystem::path file = scenario.files->system_file(arguments.scenario);
  const std::string text =
      ssp::complete(file, descriptions, scenario.files->shown(file),
                    scenario::connect_terminals(scenario.annotation.terminals, components, fmus));
  const auto archive = scenario.files->archive_of(file);
  if (archive) return write_package(arguments, *archive, file, text);
  core::Replacement output(arguments.output.empty() ? file : arguments.output);
  output.file().write(text);
  output.commit();
}

}  // namespace

void add_complete(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "complete", "Add the connectors that a scenario leaves out, as other SSP tools need them");
  const auto arguments = std::make_shared<CompleteArguments>();
  settings::add_scenario_argument(*command, arguments->scenario,
                                  "An SSP system file (.ssd) or package (.ssp)");
  command
      ->add_option("--output,--out,-o", arguments->output,
                   "Write there instead of into the scenario itself")
      ->type_name("FILE");
  command->callback([arguments] { complete(*arguments); });
}

}  // namespace stride::cli
