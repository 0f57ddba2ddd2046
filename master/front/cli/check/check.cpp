// stride check: everything up to the first step.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/engine/model/array_element.h"
#include "master/engine/run/loops/evaluation_order.h"
#include "master/engine/run/stepping/step_order.h"
#include "master/front/cli/check/remote_check.h"
#include "master/front/cli/coverage/coverage_table.h"
#include "master/front/cli/inspect/variants.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/terminal/table.h"
#include "master/system/plan/instances.h"
#include "master/system/plan/run_plan.h"
#include "master/system/settings/scenario_options.h"

namespace stride::cli {
namespace {

constexpr std::size_t kMostNames = 4;

std::string seconds(Duration duration) { return core::to_text(duration); }

std::string unit_table(const scenario::RunPlan& loaded) {
  Table table({{"component"}, {"unit"}, {"FMI"}, {"variables", Table::Align::Right}, {"file"}});
  for (std::size_t i = 0; i < loaded.fmus().size(); ++i) {
    const core::UnitDescription& unit = *loaded.fmus()[i]->description();
    table.add({loaded.system().components()[i].name, unit.model_name, unit.fmi_version,
               std::to_string(unit.variables.size()), loaded.fmus()[i]->path().string()});
  }
  return table.text();
}

/// Empty if all units are in this process.
std::string host_table(const scenario::RunPlan& loaded) {
  Table table({{"component"},
               {"call limit [s]", Table::Align::Right},
               {"memory limit [MiB]", Table::Align::Right},
               {"sandbox"},
               {"why"},
               {"snapshots"}});
  for (std::size_t i = 0; i < loaded.hostings().size(); ++i) {
    const std::optional<scenario::Hosting>& hosting = loaded.hostings()[i];
    if (!hosting) continue;
    const isolation::HostOptions& options = hosting->options;
    table.add({loaded.system().components()[i].name,
               options.call_limit ? seconds(*options.call_limit) : "none",
               options.memory_limit ? std::to_string(*options.memory_limit >> 20) : "none",
               options.is_sandboxed ? "yes" : "no", hosting->reason, hosting->snapshots});
  }
  return table.size() == 0 ? "" : "\nProcesses of their own\n" + table.text();
}

std::string entries(const core::NumberMap& map) {
  std::vector<std::string> entries;
  for (const auto& [source, target] : map)
    entries.push_back(fmt::format("{} → {}", source, target));
  return fmt::format("{}", fmt::join(entries, ", "));
}

/// What is done to a value, one after the other.
std::string conversion(const core::Connection& connection) {
  const core::Conversion& conversion = connection.conversion;
  const auto& [factor, offset] = conversion.linear;
  std::vector<std::string> parts;
  if (!conversion.map.empty()) parts.push_back(entries(conversion.map));
  if (!conversion.truth.empty()) parts.push_back("Boolean " + entries(conversion.truth));
  if (!conversion.linear.is_identity()) {
    // a quotient such as 3.5999999999999996 is 3.6 in the digits of its units' definitions
    parts.push_back(offset == 0 ? fmt::format("× {:.15g}", factor)
                                : fmt::format("× {:.15g} + {:.15g}", factor, offset));
  }
  if (connection.keeps_number) parts.push_back("unit of measure not converted");
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string connection_table(const core::System& system) {
  Table table({{"from"}, {"to"}, {"type"}, {"unit"}, {"conversion"}});
  for (const core::Connection& connection : system.connections()) {
    const core::Variable& target = system.variable(connection.to);
    table.add({system.range_name(connection.source()), system.range_name(connection.target()),
               core::name(target.type), target.unit, conversion(connection)});
  }
  return table.text();
}

/// Empty if there are none.
std::string unconnected_elements_text(const core::System& system) {
  std::string text;
  for (const core::VariableId input : system.partly_connected_inputs()) {
    std::vector<std::string> names;
    for (const core::ElementRange& free : system.unconnected_elements(input)) {
      for (std::size_t i = 0; i < free.size; ++i) {
        names.push_back(core::element_name(system.variable(input), free.first + i));
      }
    }
    text += fmt::format("  {}: {}\n", system.full_name(input), core::abridged(names, kMostNames));
  }
  return text.empty() ? ""
                      : "\nElements without connection, which keep their start values\n" + text;
}

/// Those of components that have their own; empty if there are none.
std::string own_steps(const core::System& system) {
  std::string text;
  for (const core::Component& component : system.components()) {
    if (!component.own_step) continue;
    text += fmt::format("\n{}: steps of {} s{}", component.name, core::to_text(*component.own_step),
                        component.keeps_own_step() ? "" : " at most, since it may return early");
  }
  return text;
}

std::string steps(const core::System& system, const core::RunOptions& options) {
  const core::StepOptions& step = options.step;
  std::string steps = step.policy->describe(step);
  if (step.maximum) steps += fmt::format(", of {} s at most", core::to_text(*step.maximum));
  return fmt::format("{}{}\ncoupling {}, inputs {}", steps, own_steps(system),
                     name(options.coupling),
                     options.extrapolation == core::Extrapolation::Hold
                         ? "held"
                         : fmt::format("extrapolated ({})", name(options.extrapolation)));
}

std::string stop_text(const scenario::RunPlan& loaded) {
  if (!loaded.has_stop()) return "on, without a stop time (a run needs --stop SECONDS)";
  return fmt::format("to {} s", core::to_text(loaded.options().stop));
}

std::string order_table(const scenario::RunPlan& loaded) {
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

/// With its title; empty if there are none.
std::string intervention_table(const core::System& system,
                               std::span<const core::Intervention> interventions) {
  if (interventions.empty()) return "";
  Table table({{"from [s]", Table::Align::Right},
               {"until [s]", Table::Align::Right},
               {"variable"},
               {"intervention"},
               {"value"}});
  for (const core::Intervention& intervention : interventions) {
    table.add({core::to_text(intervention.from),
               intervention.until ? core::to_text(*intervention.until) : "",
               system.full_name(intervention.id), core::name(intervention.kind),
               core::amount_text(intervention)});
  }
  return "\nInterventions\n" + table.text();
}

/// Empty if the scenario has none.
std::string check_table(const scenario::RunPlan& loaded) {
  Table table({{"check"}, {"demands"}, {"line", Table::Align::Right}});
  const auto add = [&](const auto& check) {
    table.add({check.name, check.name == check.demand ? "" : check.demand,
               std::to_string(check.where.line)});
  };
  for (const checks::Definition& check : loaded.checks()) add(check);
  for (const coverage::Demand& demand : loaded.demands()) add(demand);
  return table.size() == 0 ? "" : "\nChecks\n" + table.text();
}

std::string solved_for(const core::System& system, const core::EvaluationBlock& loop) {
  std::vector<std::string> names;
  for (const core::TearingVariable& variable : loop.tearing_variables) {
    for (const core::ElementRange& input : variable.inputs) {
      names.push_back(system.range_name(input));
    }
  }
  return core::abridged(names, kMostNames);
}

std::string loop_text(const core::System& system, const core::EvaluationBlock& loop,
                      const std::string& when) {
  std::string text;
  for (const std::string& path : loop.paths) text += fmt::format("  {}\n", path);
  if (loop.unnamed_paths > 0) text += fmt::format("  and {} more paths\n", loop.unnamed_paths);
  text += fmt::format("    {}, solved for {}\n", when, solved_for(system, loop));
  const std::string undeclared = core::undeclared_text(system, loop);
  if (!undeclared.empty()) {
    text += fmt::format("    {}, so all inputs are taken for them\n", undeclared);
  }
  return text;
}

/// The order in which initial values are evaluated, as a table.
std::string initial_order_text(const core::System& system) {
  Table table({{"", Table::Align::Right}, {"component"}, {"outputs"}, {"how"}});
  const auto order = core::evaluation_order(system, core::Phase::Initialization);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const core::EvaluationBlock& block = order[i];
    for (const core::OutputGroup& group : block.groups) {
      std::vector<std::string> outputs;
      for (const core::VariableId id : group.outputs) outputs.push_back(system.variable(id).name);
      table.add({std::to_string(i + 1), system.components()[group.component].name,
                 core::abridged(outputs, kMostNames),
                 block.is_loop() ? "loop, solved for " + solved_for(system, block) : "once"});
    }
  }
  return order.empty() ? "  no output is connected\n" : table.text();
}

/// The algebraic loops at the start and at events: their paths, their unknowns, and whether they
/// follow only from dependencies that units do not declare.
std::string loops_text(const core::System& system) {
  const auto loops = [&](core::Phase phase) {
    auto order = core::evaluation_order(system, phase);
    order.erase(std::remove_if(order.begin(), order.end(),
                               [](const auto& block) { return !block.is_loop(); }),
                order.end());
    return order;
  };
  const auto initial = loops(core::Phase::Initialization);
  const auto later = loops(core::Phase::Events);
  const auto is_among = [](const core::EvaluationBlock& loop,
                           const std::vector<core::EvaluationBlock>& others) {
    return std::any_of(others.begin(), others.end(),
                       [&](const auto& other) { return other.paths == loop.paths; });
  };
  std::string text;
  for (const core::EvaluationBlock& loop : initial) {
    text += loop_text(system, loop,
                      is_among(loop, later) ? "at the start and at events" : "at the start");
  }
  for (const core::EvaluationBlock& loop : later) {
    if (!is_among(loop, initial)) text += loop_text(system, loop, "at events");
  }
  return text.empty() ? "  none\n" : text;
}

void check(const scenario::ScenarioRequest& request) {
  const CrashGuard guard;
  const scenario::RunPlan loaded(request);
  const LimitedEnd end;
  const auto units = scenario::instantiate(loaded);
  loaded.warn_of_other_steps();
  const core::System& system = loaded.system();
  const core::RunOptions& options = loaded.options();
  const std::string order = order_table(loaded);  // which may be refused, before all output
  print_text("{}: {}, {}, {}\n", system.name(),
             core::counted(system.components().size(), "component"),
             core::counted(system.connections().size(), "connection"),
             core::counted(options.recorded.size(), "recorded signal"));
  print_text("from {} s {}, {}\n", core::to_text(options.start), stop_text(loaded),
             steps(system, options));
  print_text("{}", variant_table(*loaded.scenario().files, loaded.scenario().path));
  print_text("\nUnits\n{}{}{}\nConnections\n{}", unit_table(loaded), host_table(loaded),
             remote_table(loaded), connection_table(system));
  print_text("{}", unconnected_elements_text(system));
  print_text("{}{}", check_table(loaded), coverage_table(loaded.coverage()));
  print_text("{}", intervention_table(system, options.interventions));
  print_text("\nStep order\n{}", order);
  print_text("\nOrder of the initial values\n{}", initial_order_text(system));
  print_text("\nAlgebraic loops\n{}", loops_text(system));
  for (const auto& unit : units) unit->free();
}

}  // namespace

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand("check",
                                         "Load a scenario and its units, print units, connections, "
                                         "orders and algebraic loops; run nothing");
  const auto request = std::make_shared<scenario::ScenarioRequest>();
  request->may_lack_stop = true;
  settings::add_scenario_options(*command, *request);
  command->callback([request] { check(*request); });
}

}  // namespace stride::cli
