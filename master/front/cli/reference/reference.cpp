// stride reference: the reference of the command line, for the documentation and for shells.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/files/output_file.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/reference/command_tree.h"
#include "master/front/cli/reference/writers.h"
#include "master/system/declaration/scenario.h"
#include "master/system/declaration/scenario_path.h"
#include "master/system/scenario/units/unit_path.h"
#include "master/system/settings/scenario_options.h"

namespace stride::cli {
namespace {

using Write = std::string (*)(const reference::Command& program);

void add_text(CLI::App& app, CLI::App& group, const std::string& name, const std::string& meaning,
              Write write) {
  group.add_subcommand(name, meaning)->callback([&app, write] {
    fmt::print("{}", write(reference::describe(app)));
  });
}

void write_pages(const CLI::App& app, const std::filesystem::path& folder) {
  for (const auto& [name, text] : reference::man_pages(reference::describe(app), STRIDE_VERSION)) {
    core::OutputFile file(folder / name);
    file.write(text);
    file.close();
  }
}

void print_components(const std::filesystem::path& file) {
  const scenario::Scenario scenario = scenario::read_scenario(file, {scenario::find_unit, {}});
  for (const core::ComponentDeclaration& component : scenario.system.components) {
    print_text("{}\n", component.name);
  }
}

void print_scenarios() {
  for (const std::string& name : scenario::scenario_names()) print_text("{}\n", name);
}

}  // namespace

/// Hidden from the help: for building and installing the program.
void add_reference(CLI::App& app) {
  CLI::App* group = app.add_subcommand("reference", "Write the reference of the command line");
  group->group("")->require_subcommand(1);
  add_text(app, *group, "markdown", "As a page of the documentation", &reference::markdown);
  add_text(app, *group, "bash", "As completion for bash", &reference::bash_completion);
  add_text(app, *group, "zsh", "As completion for zsh", &reference::zsh_completion);
  add_text(app, *group, "fish", "As completion for fish", &reference::fish_completion);
  const auto path = std::make_shared<std::filesystem::path>();
  CLI::App* man = group->add_subcommand("man", "As man pages, in a folder that exists");
  man->add_option("FOLDER", *path, "Where they are written")->required()->type_name("");
  man->callback([&app, path] { write_pages(app, *path); });
  CLI::App* components =
      group->add_subcommand("components", "List the components of a scenario, for completion");
  settings::add_scenario_argument(*components, *path,
                                  "An SSP system file (.ssd) or package (.ssp)");
  components->callback([path] { print_components(*path); });
  group->add_subcommand("scenarios", "List the scenarios that come with stride, for completion")
      ->callback(print_scenarios);
}

}  // namespace stride::cli
