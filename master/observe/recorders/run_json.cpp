#include "master/observe/recorders/run_json.h"

#include <cmath>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/files/input_file.h"
#include "master/base/files/replacement.h"
#include "master/base/text/hex.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::recorders {
namespace {

using Json = nlohmann::ordered_json;

double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

Json unit_entry(const core::Component& component) {
  return {{"name", component.name},
          {"model", component.description->model_name},
          {"fmi_version", component.description->fmi_version}};
}

Json host_entry(const core::HostStatistics& host) {
  Json entry = {{"memory", host.most_memory}};
  if (host.snapshots > 0) {
    entry["snapshots"] = {{"made", host.snapshots},
                          {"restored", host.restores},
                          {"most_kept", host.most_snapshots},
                          {"memory", host.most_snapshot_memory}};
  }
  if (host.link) {
    entry["machine"] = host.link->machine;
    entry["link"] = {{"round_trips", host.link->round_trips},
                     {"sent", host.link->sent},
                     {"received", host.link->received},
                     {"lost_time", seconds(host.link->lost)}};
  }
  entry["protections"] = host.protections;
  entry["missing_protections"] = host.missing_protections;
  return entry;
}

void add(Json& entry, const core::UnitStatistics& unit) {
  entry["calls"] = unit.calls;
  entry["steps"] = unit.steps;
  entry["early_returns"] = unit.early_returns;
  entry["rejections"] = unit.rejections;
  entry["rollbacks"] = unit.rollbacks;
  entry["saves"] = unit.saves;
  entry["repeated_steps"] = unit.repeated_steps;
  entry["events"] = unit.events;
  entry["messages_sent"] = unit.messages_sent;
  entry["messages_received"] = unit.messages_received;
  if (unit.suspensions > 0) {
    entry["idle"] = {{"rests", unit.suspensions},
                     {"skipped", to_seconds(unit.suspended_time)},
                     {"longest", to_seconds(unit.longest_suspension)}};
  }
  entry["wall_time"] = {{"initialization", seconds(unit.initialization_time)},
                        {"steps", seconds(unit.step_time)},
                        {"events", seconds(unit.event_time)},
                        {"steps_uncertainty", seconds(unit.step_time_uncertainty)},
                        {"events_uncertainty", seconds(unit.event_time_uncertainty)}};
  if (unit.host) entry["host"] = host_entry(*unit.host);
}

/// Of the components that have one of their own.
Json component_steps(const core::System& system) {
  Json steps = Json::object();
  for (const core::Component& component : system.components()) {
    if (component.own_step) steps[component.name] = component.own_step->seconds();
  }
  return steps;
}

Json step_entry(const core::System& system, const core::RunOptions& options) {
  Json entry = {{"policy", name(options.step.policy)},
                {"size", options.step.size.seconds()},
                {"minimum", options.step.minimum.seconds()}};
  if (options.step.maximum) entry["maximum"] = options.step.maximum->seconds();
  if (options.step.policy->controls_error) {
    entry["relative_tolerance"] = options.step.relative_tolerance;
    entry["absolute_tolerance"] = options.step.absolute_tolerance;
  }
  entry["coupling"] = name(options.coupling);
  entry["extrapolation"] = name(options.extrapolation);
  if (Json steps = component_steps(system); !steps.empty()) entry["components"] = std::move(steps);
  return entry;
}

/// Those that were written.
Json file_entries(const ResultFiles& files) {
  Json entries = Json::object();
  for (const auto& [what, member] : kResultFiles) {
    if (!(files.*member).empty()) entries[what] = files.*member;
  }
  return entries;
}

/// Of the columns of signals.csv, but for the time.
Json signal_entries(const core::System& system, std::span<const core::VariableId> recorded) {
  Json entries = Json::array();
  for (const core::VariableId id : recorded) {
    const core::Variable& variable = system.variable(id);
    for (std::size_t i = 0; i < variable.size; ++i) {
      entries.push_back({{"name", column_name(system, id, i)},
                         {"unit", variable.unit},
                         {"type", core::name(variable.type)},
                         {"variability", name(variable.variability)}});
    }
  }
  return entries;
}

/// What goes along it.
const char* kind(const core::System& system, const core::Connection& connection) {
  if (system.variable(connection.from).type == core::ValueType::Clock) return "clock";
  return system.is_message(connection.from) ? "message" : "value";
}

Json connection_entries(const core::System& system) {
  Json entries = Json::array();
  for (const core::Connection& connection : system.connections()) {
    entries.push_back({{"from", system.range_name(connection.source())},
                       {"to", system.range_name(connection.target())},
                       {"kind", kind(system, connection)}});
  }
  return entries;
}

Json intervention_entries(const core::System& system,
                          std::span<const core::Intervention> interventions) {
  Json entries = Json::array();
  for (const core::Intervention& intervention : interventions) {
    Json entry = {{"kind", name(intervention.kind)},
                  {"variable", system.full_name(intervention.id)},
                  {"from", to_seconds(intervention.from)}};
    if (intervention.until) entry["until"] = to_seconds(*intervention.until);
    if (intervention.value) entry["value"] = core::elements_text(*intervention.value);
    if (intervention.delay > Duration{}) entry["delay"] = to_seconds(intervention.delay);
    if (intervention.bits > 0) {
      entry["bits"] = intervention.bits;
      entry["header"] = intervention.header;
      entry["seed"] = intervention.seed;
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

Json plot_entries(std::span<const Plot> plots) {
  Json entries = Json::array();
  for (const Plot& plot : plots) {
    entries.push_back({{"title", plot.title}, {"signals", plot.signals}});
  }
  return entries;
}

Json unit_entries(const core::System& system, const core::RunStatistics& statistics) {
  Json entries = Json::array();
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    Json& entry = entries.emplace_back(unit_entry(system.components()[i]));
    // there is none where a run failed before it began
    if (i < statistics.units.size()) add(entry, statistics.units[i]);
  }
  return entries;
}

Json phase_entry(const core::PhaseTimes& phases) {
  return {{"initialization", seconds(phases.initialization)},
          {"steps", seconds(phases.steps)},
          {"instants", seconds(phases.instants)},
          {"observers", seconds(phases.observers)}};
}

Json value_entry(const core::ValueBlock& value) {
  return core::visit(value, [&](auto values) -> Json {
    using T = typename decltype(values)::value_type;
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(values[0])) return core::element_text(value, 0);
    }
    if constexpr (std::is_same_v<T, core::Binary>) {
      return core::to_hex(values[0]);
    } else {
      return values[0];
    }
  });
}

/// JSON has no infinities: they are texts, as those of signals are.
Json number_entry(double number) {
  return std::isfinite(number) ? Json(number) : Json(fmt::format("{}", number));
}

Json time_entry(std::optional<Time> time) { return time ? Json(to_seconds(*time)) : Json(); }

Json margin_entry(const std::optional<core::Margin>& margin) {
  if (!margin) return {};
  return {{"value", number_entry(margin->value)},
          {"unit", margin->unit},
          {"at", to_seconds(margin->at)}};
}

Json limits_entry(const core::SignalLimits& limits) {
  Json entry = {
      {"signal", limits.signal}, {"from", time_entry(limits.from)}, {"to", time_entry(limits.to)}};
  for (const auto& [name, value] : limits.limits) entry[name] = value_entry(value);
  return entry;
}

Json passed_entry(std::optional<bool> passed) { return passed ? Json(*passed) : Json(); }

Json check_entry(const core::Verdict& check) {
  Json entry = {{"name", check.name},
                {"kind", check.kind},
                {"passed", passed_entry(check.passed)},
                {"text", check.text},
                {"time", time_entry(check.time)},
                {"margin", margin_entry(check.margin)},
                {"line", check.where.line},
                {"values", Json::array()}};
  for (const core::SignalValue& value : check.values) {
    entry["values"].push_back(
        {{"signal", value.signal}, {"value", value_entry(value.value)}, {"unit", value.unit}});
  }
  if (check.limits) entry["limits"] = limits_entry(*check.limits);
  return entry;
}

void add_verdicts(Json& run, std::span<const core::Verdict> verdicts) {
  run["verdicts"] = Json::array();
  run["checks"] = Json::array();
  for (const core::Verdict& verdict : verdicts) {
    if (!verdict.kind.empty()) {
      run["checks"].push_back(check_entry(verdict));
      continue;
    }
    run["verdicts"].push_back({{"component", verdict.name},
                               {"passed", passed_entry(verdict.passed)},
                               {"text", verdict.text}});
  }
}

Json coverage_entries(std::span<const CoverageSummary> coverage) {
  Json entries = Json::array();
  for (const CoverageSummary& group : coverage) {
    Json& entry = entries.emplace_back(Json{{"component", group.component}});
    entry["percentage"] = group.percentage ? Json(*group.percentage) : Json();
    entry["goal"] = group.goal ? Json(*group.goal) : Json();
  }
  return entries;
}

constexpr const char* kRunning = "running";

const char* outcome(const RunRecord& record) {
  if (record.error) return "failed";
  return record.is_over ? name(record.statistics.end) : kRunning;
}

void add(Json& run, const core::RunStatistics& statistics) {
  run["reached"] = to_seconds(statistics.reached);
  run["communication_steps"] = statistics.communication_steps;
  run["undone_steps"] = statistics.undone_steps;
  run["event_iterations"] = statistics.event_iterations;
  run["parallel_steps"] = statistics.parallel_steps;
  run["wall_time"] = seconds(statistics.wall_time);
  run["measured_steps"] = statistics.measured_steps;
  run["phases"] = phase_entry(statistics.phases);
  run["phase_uncertainties"] = phase_entry(statistics.phase_uncertainties);
}

Json read(const std::filesystem::path& file) {
  constexpr bool kThrows = false;
  Json run = Json::parse(core::read_input(file), nullptr, kThrows);
  if (run.is_object()) return run;
  core::fail_run({.where = {file.string(), 0}},
                 "other code has written to this file, so it does not contain how the run ended",
                 "leave the results alone until the run has ended");
}

void write(const std::filesystem::path& file, const Json& run) {
  core::Replacement output(file);
  output.file().write(run.dump(2, ' ', false, Json::error_handler_t::replace));
  output.file().write('\n');
  output.commit();
}

}  // namespace

void write_run_json(const std::filesystem::path& file, const RunRecord& record) {
  const auto& [scenario, system, options, provenance, statistics, verdicts, error, is_over, files,
               plots, coverage] = record;
  Json run = {{"scenario", scenario.string()},       {"system", system.name()},
              {"start", to_seconds(options.start)},  {"stop", to_seconds(options.stop)},
              {"step", step_entry(system, options)}, {"outcome", outcome(record)}};
  if (error) run["error"] = *error;
  add_verdicts(run, verdicts);
  if (!coverage.empty()) run["coverage"] = coverage_entries(coverage);
  run["threads"] = options.threads.count;
  run["recorded_signals"] = options.recorded.size();
  if (is_over) add(run, statistics);
  run["units"] = unit_entries(system, statistics);
  run["connections"] = connection_entries(system);
  run["interventions"] = intervention_entries(system, options.interventions);
  run["files"] = file_entries(files);
  run["signals"] = signal_entries(system, options.recorded);
  run["plots"] = plot_entries(plots);
  run["provenance"] = to_json(provenance);
  write(file, run);
}

bool is_running(const std::filesystem::path& file) { return read(file)["outcome"] == kRunning; }

std::optional<std::string> error_in(const std::filesystem::path& file) {
  const Json run = read(file);
  if (!run.contains("error") || !run["error"].is_string()) return std::nullopt;
  return run["error"].get<std::string>();
}

bool add_error(const std::filesystem::path& file, const std::string& error,
               std::optional<Time> reached) {
  Json run = read(file);
  if (run.contains("error")) return false;
  if (reached && run["outcome"] == kRunning) run["reached"] = to_seconds(*reached);
  run["outcome"] = "failed";
  run["error"] = error;
  write(file, run);
  return true;
}

}  // namespace stride::recorders
