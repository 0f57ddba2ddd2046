#include "master/system/plan/run_times.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/parse_option.h"
#include "master/base/time_text.h"

namespace stride::scenario {
namespace {

/// Those of different units need not be the same.
Time earliest_start_of_units(const ResolvedSystem& resolved) {
  const auto& components = resolved.scenario.system.components;
  std::vector<std::pair<Time, std::size_t>> starts;
  for (std::size_t i = 0; i < resolved.fmus.size(); ++i) {
    if (const auto& start = resolved.fmus[i]->description()->default_start)
      starts.emplace_back(*start, i);
  }
  if (starts.empty()) return {};
  const auto [first, last] = std::ranges::minmax(starts);
  const core::ComponentDeclaration& earliest = components[first.second];
  if (first.first != last.first) {
    spdlog::warn(
        "the run begins at {} s, the start time of '{}'; that of '{}' is {} s; --start "
        "chooses another one",
        core::to_text(first.first), earliest.name, components[last.second].name,
        core::to_text(last.first));
  }
  return first.first;
}

Time chosen_start(const ResolvedSystem& resolved, const ScenarioRequest& request) {
  if (!request.start.empty())
    return core::parse_option("--start", request.start, &core::parse_time);
  return resolved.scenario.start ? *resolved.scenario.start : earliest_start_of_units(resolved);
}

/// The component whose unit has the latest stop time, if any has one.
std::optional<std::size_t> last_to_stop(const ResolvedSystem& resolved) {
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < resolved.fmus.size(); ++i) {
    const auto& stop = resolved.fmus[i]->description()->default_stop;
    const bool is_later =
        stop && (!last || *stop > *resolved.fmus[*last]->description()->default_stop);
    if (is_later) last = i;
  }
  return last;
}

/// That of the scenario, or else the latest of the units.
std::optional<Time> declared_stop(const ResolvedSystem& resolved) {
  if (resolved.scenario.stop) return resolved.scenario.stop;
  const std::optional<std::size_t> last = last_to_stop(resolved);
  return last ? resolved.fmus[*last]->description()->default_stop : std::nullopt;
}

constexpr const char* kStopHint =
    "use --stop SECONDS; a system has it in <ssd:DefaultExperiment stopTime=\"…\"/>";

/// Where a stop time comes from that a person has not written.
std::string stop_hint(const ResolvedSystem& resolved, const ScenarioRequest& request) {
  const std::optional<std::size_t> last = last_to_stop(resolved);
  if (!request.stop.empty() || resolved.scenario.stop || !last) return "";
  const core::ComponentDeclaration& component = resolved.components()[*last];
  const std::string file = resolved.scenario.sources[*last].filename().string();
  const std::string what =
      component.is_table ? fmt::format("the last row of the table '{}', {}", component.name, file)
                         : fmt::format("the DefaultExperiment of '{}', {}", component.name, file);
  return fmt::format("the run ends with {}, since there is no other stop time; {}", what,
                     kStopHint);
}

Time chosen_stop(const ResolvedSystem& resolved, const ScenarioRequest& request) {
  if (!request.stop.empty()) return core::parse_option("--stop", request.stop, &core::parse_time);
  const std::optional<Time> stop = declared_stop(resolved);
  if (!stop) {
    core::fail_input(resolved.of_file(),
                     "there is no stop time, neither of the system nor of a unit", kStopHint);
  }
  if (*stop == Time::max()) {
    core::fail_input(resolved.of_file(),
                     "the stop time of a unit's DefaultExperiment is beyond 1e15 s, the largest "
                     "time",
                     kStopHint);
  }
  return *stop;
}

}  // namespace

PlannedTimes choose_times(const ResolvedSystem& resolved, const ScenarioRequest& request) {
  PlannedTimes times;
  times.start = chosen_start(resolved, request);
  const std::optional<Time> declared = declared_stop(resolved);
  if (declared && *declared != Time::max()) times.declared_length = *declared - times.start;
  times.has_stop = !request.may_lack_stop || !request.stop.empty() || declared;
  const Time beyond_all(Time::max().time_since_epoch() / 2);  // no difference overflows
  times.stop = times.has_stop ? chosen_stop(resolved, request) : beyond_all;
  times.stop_hint = stop_hint(resolved, request);
  if (times.stop == times.start) {
    spdlog::warn("the run ends where it starts, at {} s, so it has initial values only",
                 core::to_text(times.start));
  }
  if (times.stop >= times.start) return times;
  const Scenario& scenario = resolved.scenario;
  const char* const of_units = " (of the units' DefaultExperiment)";
  core::fail_input(
      resolved.of_file(),
      fmt::format("the stop time {} s{} is before the start time {} s{}", core::to_text(times.stop),
                  request.stop.empty() && !scenario.stop ? of_units : "",
                  core::to_text(times.start),
                  request.start.empty() && !scenario.start ? of_units : ""),
      "give a later stop time by --stop SECONDS or <ssd:DefaultExperiment "
      "stopTime=\"…\"/>, or an earlier start time by --start or startTime");
}

}  // namespace stride::scenario
