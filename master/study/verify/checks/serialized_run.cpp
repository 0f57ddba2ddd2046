#include "master/study/verify/checks/serialized_run.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "master/base/text/hex.h"
#include "master/base/time_text.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"

namespace stride::verify {
namespace {

using Json = nlohmann::json;

/// What happened on the way from a point to the next one.
struct Happening {
  std::size_t point;
  bool has_event;  ///< where its inputs were handed over
  bool has_tick;
};

std::optional<std::size_t> first_point(const std::vector<Happening>& all, bool Happening::*what) {
  const auto found = std::ranges::find_if(all, [&](const Happening& one) { return one.*what; });
  return found == all.end() ? std::nullopt : std::optional(found->point);
}

std::vector<Happening> observe_happenings(const Trial& trial, std::size_t from, std::size_t to) {
  std::vector<Happening> all;
  TestInstance instance = trial.make_instance();
  instance.start();
  instance.run_to(from);
  while (instance.at() < to && !instance.recording().has_ended) {
    const Recording& recording = instance.recording();
    Happening happening{instance.at(), false, false};
    const std::size_t events = recording.events;
    const std::size_t rows = recording.rows.size();
    instance.hand_over_inputs();
    happening.has_event = recording.events > events;
    instance.step_to_next_point();
    happening.has_tick = recording.rows.size() > rows;
    all.push_back(happening);
  }
  return all;
}

bool has_schedule(const core::UnitDescription& unit) {
  return std::ranges::any_of(unit.variables, &core::Variable::is_time_based_clock);
}

SerializedState serialize(TestInstance& instance, const Cut& cut) {
  instance.capability<core::StateSaving>().save_state();
  return {cut, instance.capability<core::StateSerialization>().serialize_state(),
          instance.position(), instance.recording().rows.size()};
}

}  // namespace

std::vector<Row> SerializedRun::rows_after(const SerializedState& state) const {
  return {rows.begin() + static_cast<std::ptrdiff_t>(state.rows), rows.end()};
}

std::vector<Cut> choose_cuts(const Trial& trial) {
  const std::size_t from = trial.point_at(0.3);
  const std::size_t to = trial.point_at(0.8);
  std::vector<Cut> cuts{{from, false, ""}};
  const auto add = [&](const Cut& cut) {
    const bool is_known = std::ranges::find(cuts, cut.order(), &Cut::order) != cuts.end();
    if (!is_known && cut.point < to) cuts.push_back(cut);
  };
  const auto happenings = observe_happenings(trial, from, to);
  if (const auto point = first_point(happenings, &Happening::has_event)) {
    add({*point, false, "before an event"});
    add({*point, true, "right after an event"});
  }
  if (const auto point = first_point(happenings, &Happening::has_tick)) {
    add({*point, false, "before a clock ticks"});
    add({*point, true, "where a clock ticks"});
    add({*point + 1, false, "after a clock has ticked"});
  }
  std::ranges::sort(cuts, {}, &Cut::order);
  return cuts;
}

SerializedRun run_with_cuts(const Trial& trial, const std::vector<Cut>& cuts) {
  SerializedRun run;
  run.to = trial.point_at(0.8);
  TestInstance instance = trial.make_instance();
  instance.start();
  for (const Cut& cut : cuts) {
    instance.run_to(cut.point);
    if (instance.recording().has_ended) break;
    if (cut.is_after_inputs) instance.hand_over_inputs();
    run.states.push_back(serialize(instance, cut));
    if (!cut.is_after_inputs) continue;
    instance.step_to_next_point();
    instance.record_point();
  }
  instance.run_to(run.to);
  run.rows = instance.recording().rows;
  return run;
}

TestInstance instance_at(const Trial& trial, const Cut& cut) {
  TestInstance instance = trial.make_instance({.name = "guide"});
  instance.start();
  instance.run_to(cut.point);  // what is read in Event Mode may be computed only then
  if (cut.is_after_inputs) instance.hand_over_inputs();
  instance.clear_recorded();
  return instance;
}

void restore(const Trial& trial, TestInstance& instance, const SerializedState& state) {
  std::optional<core::Clocks> clocks;
  if (has_schedule(trial.tested.description())) {
    clocks.emplace(instance_at(trial, state.cut).clocks());
  }
  instance.clear_recorded();
  instance.capability<core::StateSerialization>().deserialize_state(state.bytes);
  instance.capability<core::StateSaving>().restore_state();
  instance.set_position(state.position, clocks ? &*clocks : nullptr);
}

void finish_from(TestInstance& instance, const SerializedState& state, std::size_t to) {
  if (state.cut.is_after_inputs) {
    instance.record_from_here();
    instance.step_to_next_point();
    instance.record_point();
  }
  instance.run_to(to);
}

std::string to_text(const SerializedRun& run) {
  Json states = Json::array();
  for (const SerializedState& state : run.states) {
    const auto& [now, point, next] = state.position;
    states.push_back({{"bytes", core::to_hex(state.bytes)},
                      {"cut", {state.cut.point, state.cut.is_after_inputs, state.cut.place}},
                      {"now", core::to_text(now)},
                      {"point", point},
                      {"next", next ? Json(core::to_text(*next)) : Json()},
                      {"rows", state.rows}});
  }
  return Json{{"states", states}, {"to", run.to}, {"recording", to_text(Recording{run.rows})}}
      .dump();
}

SerializedRun serialized_run_from_text(const std::string& text) {
  const Json json = Json::parse(text);
  SerializedRun run{{}, recording_from_text(json["recording"]).rows, json["to"]};
  for (const Json& from : json["states"]) {
    const auto time = [&](const char* key) {
      return from[key].is_null() ? std::nullopt
                                 : std::optional(core::parse_time(from[key].get<std::string>()));
    };
    const Json& cut = from["cut"];
    SerializedState state{{cut[0], cut[1], cut[2]},
                          core::from_hex(from["bytes"].get<std::string>()).value(),
                          {*time("now"), from["point"], time("next")},
                          from["rows"]};
    run.states.push_back(std::move(state));
  }
  return run;
}

}  // namespace stride::verify
