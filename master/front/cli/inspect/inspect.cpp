// stride inspect: the description of a unit or a system.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/text/counted.h"
#include "master/base/text/lower_case.h"
#include "master/base/time_text.h"
#include "master/front/cli/inspect/variants.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/loader/fmu/description/terminals.h"
#include "master/loader/fmu/fmu.h"
#include "master/system/declaration/scenario.h"
#include "master/system/scenario/units/file_units.h"
#include "master/system/scenario/units/unit_path.h"

namespace stride::cli {
namespace {

std::string range(const core::Variable& variable) {
  if (variable.min.empty() && variable.max.empty()) return "";
  if (variable.max.empty()) return "≥ " + variable.min;
  if (variable.min.empty()) return "≤ " + variable.max;
  return variable.min + " … " + variable.max;
}

std::string type(const core::Variable& variable) {
  std::string text = core::name(variable.type);
  for (const core::Dimension& d : variable.dimensions) text += fmt::format("[{}]", d.size);
  if (variable.is_time_based_clock())
    text += fmt::format(" ({})", name(variable.clock->variability));
  return text;
}

std::string clock_names(const core::UnitDescription& unit, const core::Variable& variable) {
  std::string names;
  for (const core::ValueReference clock : variable.clocks) {
    names += (names.empty() ? " at " : ", ") + unit.variables[*unit.find(clock)].name;
  }
  return names;
}

std::string capabilities(const core::UnitDescription& unit) {
  std::string text;
  const auto add = [&](bool has, const std::string& what) {
    if (has) text += (text.empty() ? "" : ", ") + what;
  };
  add(unit.has_event_mode, "event mode");
  add(unit.can_save_state, "can be rolled back");
  add(unit.can_serialize_state, "state can be serialised");
  add(unit.can_vary_step, "variable step");
  add(unit.may_return_early, "may return early");
  add(unit.provides_intermediate_update, "inputs may change within a step");
  add(unit.provides_directional_derivatives, "directional derivatives");
  add(unit.max_output_derivative_order > 0,
      fmt::format("output derivatives up to order {}", unit.max_output_derivative_order));
  add(unit.fixed_internal_step.has_value(),
      fmt::format("internal step {} s",
                  core::to_text(unit.fixed_internal_step.value_or(core::Interval{}))));
  add(unit.promises_idle, "promises to be idle");
  add(unit.single_instance, "one instance per process");
  add(unit.needs_execution_tool, "needs its own tool");
  return text;
}

std::string verdict(const core::UnitDescription& unit) {
  if (!unit.verdict) return "";
  const std::string passed = unit.variables[*unit.verdict].name;
  if (!unit.verdict_text) return fmt::format("verdict on the run: {}\n", passed);
  return fmt::format("verdict on the run: {}, explained by {}\n", passed,
                     unit.variables[*unit.verdict_text].name);
}

std::string unit_of_measure(const core::Variable& variable) {
  if (!variable.is_relative) return variable.unit;
  return variable.unit + (variable.unit.empty() ? "difference" : " (difference)");
}

std::string items(const core::Variable& variable) {
  std::string text;
  for (const auto& [name, value] : variable.items) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", value, name);
  }
  return text;
}

std::string meaning(const core::Variable& variable) {
  std::string text = variable.description;
  if (!variable.items.empty()) text += (text.empty() ? "" : "; ") + items(variable);
  for (const std::string& alias : variable.aliases) {
    text += fmt::format("{}also {}", text.empty() ? "" : "; ", alias);
  }
  return text;
}

/// Empty if there are none.
std::string terminal_table(const importer::Fmu& fmu) {
  Table table({{"terminal"}, {"kind"}, {"matching rule"}, {"member"}, {"variable"}});
  for (const importer::Terminal& terminal :
       importer::read_terminals(fmu.folder(), fmu.path().string())) {
    std::vector<std::string> row{terminal.name, terminal.kind, terminal.matching_rule, "", ""};
    for (const importer::TerminalMember& member : terminal.members) {
      row[3] = member.name;
      row[4] = member.variable;
      table.add(std::exchange(row, std::vector<std::string>(row.size())));
    }
    if (terminal.members.empty()) table.add(row);
  }
  return table.size() == 0 ? "" : "\n" + table.text();
}

/// Whether it is a system file, or a package of them.
bool is_system(const std::filesystem::path& file) {
  const std::string extension = core::lower_case(file.extension().string());
  return extension == ".ssd" || extension == ".ssp" ||
         core::path_exists(file / "SystemStructure.ssd");
}

void inspect_system(const std::filesystem::path& file) {
  const scenario::Scenario scenario = scenario::read_scenario(file, {scenario::find_unit, {}});
  print_warnings(scenario.warnings);
  print_text("{}: SSP {}, {}, {}\n", scenario.name, scenario.ssp_version,
             core::counted(scenario.system.components.size(), "component"),
             core::counted(scenario.system.connections.size(), "connection"));
  print_text("{}", variant_table(*scenario.files, file));
  Table table({{"component"}, {"source"}});
  for (std::size_t i = 0; i < scenario.sources.size(); ++i) {
    table.add({scenario.system.components[i].name, scenario.files->shown(scenario.sources[i])});
  }
  print_text("\n{}", table.text());
}

void inspect(const std::filesystem::path& file) {
  if (is_system(file)) return inspect_system(file);
  const CrashGuard guard;
  const auto fmu = scenario::load_unit(scenario::find_unit(file, {}));
  const LimitedEnd end;
  const core::UnitDescription& unit = *fmu->description();
  print_warnings(unit.warnings);
  print_text("{}: FMI {} Co-Simulation{}\n", unit.model_name, unit.fmi_version,
             unit.generation_tool.empty() ? "" : ", made with " + unit.generation_tool);
  if (!unit.description.empty()) print_text("{}\n", unit.description);
  if (const std::string can = capabilities(unit); !can.empty()) print_text("{}\n", can);
  print_text("{}", verdict(unit));
  Table table({{"variable"}, {"causality"}, {"type"}, {"unit"}, {"start"}, {"range"}, {"meaning"}});
  for (const core::Variable& variable : unit.variables) {
    table.add({variable.name, core::name(variable.causality),
               type(variable) + clock_names(unit, variable), unit_of_measure(variable),
               variable.start, range(variable), meaning(variable)});
  }
  print_text("\n{}", table.text());
  warn_of_failure([&] { print_text("{}", terminal_table(*fmu)); });
}

}  // namespace

void add_inspect(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("inspect",
                         "Show a unit's variables and terminals, or a system's components and "
                         "variants, in tables");
  const auto file = std::make_shared<std::filesystem::path>();
  command
      ->add_option("FILE", *file,
                   "A .fmu, its unpacked folder, a .so of the unit kit, a table (.csv, .parquet, "
                   ".mcap), or an SSP "
                   "system file (.ssd) or package (.ssp)")
      ->required()
      ->type_name("");
  command->callback([file] { inspect(*file); });
}

}  // namespace stride::cli
