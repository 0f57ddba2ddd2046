// stride check: everything up to the first step.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/algorithm/stepping/step_order.h"
#include "master/cli/commands.h"
#include "master/cli/evaluation_text.h"
#include "master/cli/scenario_options.h"
#include "master/cli/table.h"
#include "master/scenario/loaded_scenario.h"
#include "master/util/time_text.h"

namespace stride::cli {
namespace {

std::string seconds(Duration duration) { return core::to_text(duration); }

std::string unit_table(const scenario::LoadedScenario& loaded) {
  Table table({{"component"}, {"unit"}, {"FMI"}, {"variables", Table::Align::Right}, {"file"}});
  for (std::size_t i = 0; i < loaded.fmus().size(); ++i) {
    const core::UnitDescription& unit = *loaded.fmus()[i]->description();
    table.add({loaded.system().components()[i].name, unit.model_name, unit.fmi_version,
               std::to_string(unit.variables.size()), loaded.fmus()[i]->path().string()});
  }
  return table.text();
}

/// Empty if all units are in this process.
std::string host_table(const scenario::LoadedScenario& loaded) {
  Table table({{"component"},
               {"call limit [s]", Table::Align::Right},
               {"memory limit [MiB]", Table::Align::Right},
               {"sandbox"},
               {"why"}});
  for (std::size_t i = 0; i < loaded.hostings().size(); ++i) {
    const std::optional<scenario::Hosting>& hosting = loaded.hostings()[i];
    if (!hosting) continue;
    const isolation::HostOptions& options = hosting->options;
    table.add({loaded.system().components()[i].name,
               options.call_limit ? seconds(*options.call_limit) : "none",
               options.memory_limit ? std::to_string(*options.memory_limit >> 20) : "none",
               options.is_sandboxed ? "yes" : "no", hosting->reason});
  }
  return table.size() == 0 ? "" : "\nProcesses of their own\n" + table.text();
}

std::string conversion(const core::Conversion& conversion) {
  const auto& [factor, offset] = conversion.linear;
  if (!conversion.map.empty()) {
    std::vector<std::string> entries;
    for (const auto& [source, target] : conversion.map) {
      entries.push_back(fmt::format("{} → {}", source, target));
    }
    return fmt::format("{}", fmt::join(entries, ", "));
  }
  if (conversion.linear.is_identity()) return "";
  if (offset == 0) return fmt::format("× {}", factor);
  return fmt::format("× {} + {}", factor, offset);
}

std::string connection_table(const core::System& system) {
  Table table({{"from"}, {"to"}, {"type"}, {"unit"}, {"conversion"}});
  for (const core::Connection& connection : system.connections()) {
    const core::Variable& target = system.variable(connection.to);
    table.add({system.full_name(connection.from), system.full_name(connection.to),
               core::name(target.type), target.unit, conversion(connection.conversion)});
  }
  return table.text();
}

std::string steps(const core::RunOptions& options) {
  const core::StepOptions& step = options.step;
  std::string steps = step.policy->describe(step);
  if (step.maximum) steps += fmt::format(", of {} s at most", seconds(*step.maximum));
  return fmt::format("{}\ncoupling {}, inputs {}", steps, name(options.coupling),
                     options.extrapolation == core::Extrapolation::Hold
                         ? "held"
                         : fmt::format("extrapolated ({})", name(options.extrapolation)));
}

std::string order_table(const scenario::LoadedScenario& loaded) {
  const core::System& system = loaded.system();
  Table table(
      {{"", Table::Align::Right}, {"stage", Table::Align::Right}, {"component"}, {"why here"}});
  for (const core::StepOrderEntry& entry : core::step_order(
           loaded.system(), *loaded.options().step.policy, loaded.options().coupling)) {
    const std::string number = std::to_string(table.size() + 1);
    table.add({number, std::to_string(entry.stage + 1), system.components()[entry.component].name,
               entry.reason});
  }
  return table.text();
}

/// Empty if the scenario has none.
std::string check_table(std::span<const checks::Definition> checks) {
  Table table({{"check"}, {"demands"}, {"line", Table::Align::Right}});
  for (const checks::Definition& check : checks) {
    table.add({check.name, check.name == check.demand ? "" : check.demand,
               std::to_string(check.where.line)});
  }
  return table.size() == 0 ? "" : "\nChecks\n" + table.text();
}

void check(const scenario::ScenarioRequest& request) {
  const scenario::LoadedScenario loaded(request);
  loaded.instantiate();
  const core::System& system = loaded.system();
  const core::RunOptions& options = loaded.options();
  fmt::print("{}: {} components, {} connections, {} recorded signals\n", system.name(),
             system.components().size(), system.connections().size(), options.recorded.size());
  fmt::print("from {} s to {} s, {}\n", core::to_text(options.start), core::to_text(options.stop),
             steps(options));
  fmt::print("\nUnits\n{}{}\nConnections\n{}", unit_table(loaded), host_table(loaded),
             connection_table(system));
  fmt::print("{}", check_table(loaded.checks()));
  fmt::print("\nStep order\n{}", order_table(loaded));
  fmt::print("\nOrder of the initial values\n{}", initial_order_text(system));
  fmt::print("\nAlgebraic loops\n{}", loops_text(system));
}

}  // namespace

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check",
                                         "Load a scenario and its units, print units, connections, "
                                         "orders and algebraic loops; run nothing");
  const auto request = std::make_shared<scenario::ScenarioRequest>();
  add_scenario_options(*command, *request);
  command->callback([request] { check(*request); });
}

}  // namespace stride::cli
