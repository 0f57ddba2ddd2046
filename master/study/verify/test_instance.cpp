#include "master/study/verify/test_instance.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/study/verify/finding.h"

namespace stride::verify {
namespace {

using core::Causality;
using core::ValueBlock;
using core::ValueReference;
using core::ValueType;
using core::Variable;

constexpr int kMostIterations = 1000;
/// A unit that rejects steps shorter than this rejects all.
constexpr Duration kShortestStep = std::chrono::nanoseconds(1);

bool is_triggered_input(const Variable& variable) {
  return variable.causality == Causality::Input && variable.is_triggered_clock();
}

/// Only the unit knows what bytes and texts mean, so no message is made up.
bool carries_messages(const core::UnitDescription& unit, ValueReference clock) {
  return std::any_of(unit.variables.begin(), unit.variables.end(), [&](const Variable& variable) {
    const bool is_opaque = variable.type == ValueType::Binary || variable.type == ValueType::String;
    return is_opaque && variable.causality == Causality::Input && variable.belongs_to(clock);
  });
}

std::unique_ptr<core::Unit> instantiate(const TestedUnit& tested, importer::CallNote& note,
                                        const TestInstanceOptions& options) {
  note.write("the loading of its library");
  tested.fmu().load_library();
  note.clear();
  return tested.fmu().instantiate(options.name,
                                  {.early_return_allowed = options.early_return_allowed,
                                   .may_go_back = true,
                                   .description = tested.system().components()[0].description,
                                   .call_note = &note});
}

}  // namespace

TestInstance::TestInstance(const TestedUnit& tested, importer::CallNote& note,
                           TestInstanceOptions options)
    : tested_(tested),
      options_(std::move(options)),
      seed_(options_.seed != 0 ? options_.seed : tested.request().seed),
      stimulus_(options_.stimulus ? options_.stimulus
                                  : std::make_shared<const Stimulus>(tested, seed_)),
      units_([&] {
        std::vector<std::unique_ptr<core::Unit>> units;
        units.push_back(instantiate(tested, note, options_));
        return units;
      }()) {
  clocks_.emplace(tested_.system(), units_);
  for (const TestedUnit::Group& group : tested.observed()) {
    blocks_.emplace_back(group.type, group.size);
  }
}

// ---- Beginning and end ----

void TestInstance::start() {
  set_start_values();
  enter_initialization();
  exit_initialization();
}

void TestInstance::set_start_values() {
  const core::System& system = tested_.system();
  const auto set_all = [&](std::span<const core::StartValue> values) {
    for (const core::StartValue& start : values) {
      const core::Variable& variable = system.variable(start.id);
      set(variable, start.kept.empty() ? start.value : start.over(get(variable)));
    }
  };
  if (!system.structural_values().empty()) {
    auto& configuration = capability<core::ConfigurationMode>();
    configuration.enter_configuration_mode();
    set_all(system.structural_values());
    configuration.exit_configuration_mode();
  }
  set_all(system.start_values());
}

void TestInstance::enter_initialization() {
  position_ = {tested_.start(), 0, {}};
  recording_ = {};
  records_ = true;
  unit().enter_initialization(position_.now, std::nullopt);
}

void TestInstance::exit_initialization() {
  clocks_.emplace(tested_.system(), units_);
  clocks_->begin(position_.now);
  unit().exit_initialization();
  if (tested_.description().has_event_mode) finish_events();
}

void TestInstance::reset() {
  capability<core::Resetting>().reset();
  position_ = {};
}

// ---- Values ----

ValueBlock TestInstance::get(const Variable& variable) {
  ValueBlock block(variable.type, variable.size);
  unit().get({&variable.reference, 1}, block);
  return block;
}

void TestInstance::set(const Variable& variable, const ValueBlock& value) {
  unit().set({&variable.reference, 1}, value);
}

std::vector<std::string> TestInstance::observe() {
  std::vector<std::string> texts;
  texts.reserve(tested_.observed_count());
  for (std::size_t g = 0; g < blocks_.size(); ++g) {
    const TestedUnit::Group& group = tested_.observed()[g];
    unit().get(group.references, blocks_[g]);
    std::size_t first = 0;
    for (const std::size_t i : group.places) {
      const std::size_t size = tested_.description().variables[i].size;
      texts.push_back(core::elements_text(blocks_[g], first, size));
      first += size;
    }
  }
  return texts;
}

void TestInstance::set_inputs(std::size_t k, bool continuous_only) {
  for (const Stimulus::Input& input : stimulus_->inputs()) {
    if (input.is_clocked || (continuous_only && !input.is_continuous)) continue;
    unit().set({&input.reference, 1}, stimulus_->value(input, k));
  }
}

void TestInstance::set_clocked_inputs(std::size_t k) {
  for (const Stimulus::Input& input : stimulus_->inputs()) {
    const Variable& variable = tested_.description().variables[input.variable];
    const bool is_due = std::any_of(variable.clocks.begin(), variable.clocks.end(),
                                    [&](ValueReference clock) { return ticks(clock); });
    if (is_due) unit().set({&input.reference, 1}, stimulus_->value(input, k));
  }
}

// ---- Steps ----

std::vector<Time> TestInstance::targets(std::size_t k) const {
  const Time end = tested_.point(k + 1);
  const Time begin = tested_.point(k);
  const Duration size = end - begin;
  const bool stays_whole = options_.split == Split::Random && uniform(seed_, k) < 0.5;
  if (stays_whole) return {end};
  switch (options_.split) {
    case Split::None:
      break;
    case Split::Halves:
      return {begin + size / 2, end};
    case Split::Uneven:
    case Split::Random: {
      const auto thirds = static_cast<std::int64_t>(k % 3);
      return {begin + size / (7 - 2 * thirds), begin + size / 2, end};
    }
  }
  return {end};
}

void TestInstance::run_to(std::size_t k, bool records) {
  records_ = records;
  while (position_.point < k && !recording_.has_ended) {
    hand_over_inputs();
    step_to_next_point();
    if (records) record_point();
  }
}

void TestInstance::record_point() {
  if (recording_.has_ended) return;
  recording_.rows.push_back({position_.now, observe(), false});
}

void TestInstance::hand_over_inputs() {
  const std::size_t k = position_.point;
  const bool has_event_mode = tested_.description().has_event_mode;
  if (has_event_mode && (is_event_due() || stimulus_->changes_at(k) || stimulus_->ticks_at(k))) {
    handle_events(k);
  } else {
    set_inputs(k, has_event_mode);
  }
}

void TestInstance::step_to_next_point() {
  for (const Time target : targets(position_.point)) advance(target);
  if (!recording_.has_ended) ++position_.point;
}

bool TestInstance::leap_to(std::size_t k) {
  position_.point = k;
  return try_step(tested_.point(k));
}

void TestInstance::advance(Time to) {
  while (position_.now < to && !recording_.has_ended) {
    if (is_event_due()) handle_events();
    Time end = to;
    if (position_.next_event) end = std::min(end, *position_.next_event);
    if (const auto tick = clocks_->next()) end = std::min(end, *tick);
    if (!try_step(end)) shorten(end);
  }
}

/// A step that was rejected is tried again at half its length.
void TestInstance::shorten(Time to) {
  const Time begin = position_.now;
  Duration size = to - begin;
  do {
    size /= 2;
    if (size < kShortestStep) {
      const std::string reason = capability<core::UnitDiagnostics>().rejection_reason();
      throw Failure(fmt::format("at {} s it rejects every step, down to one of {} s{}",
                                core::to_text(begin), core::to_text(2 * size),
                                reason.empty() ? "" : ": " + reason));
    }
  } while (!try_step(begin + size));
}

bool TestInstance::try_step(Time to) {
  const core::StepResult result = unit().step({position_.now, to});
  if (records_) record_step(result);
  if (result.rejected) {
    ++recording_.rejections;
    return false;
  }
  if (result.early_return && ++recording_.early_returns == 1) {
    recording_.first_early_return = result.reached;
  }
  const bool stands_still = result.reached == position_.now && !result.event_handling_needed;
  if (stands_still) {
    throw Failure(fmt::format("at {} s a step returns early where it began, and requests no event",
                              core::to_text(position_.now)));
  }
  position_.now = result.reached;
  recording_.has_ended = recording_.has_ended || result.terminate_simulation;
  if (result.event_handling_needed && !recording_.has_ended) handle_events();
  return true;
}

void TestInstance::record_step(const core::StepResult& result) {
  const Time end = result.rejected ? position_.now : result.reached;
  recording_.steps.push_back({position_.now, end, result.rejected, result.event_handling_needed,
                              result.terminate_simulation});
}

void TestInstance::clear_recorded() {
  recording_.rows.clear();
  recording_.steps.clear();
}

// ---- Events ----

bool TestInstance::is_event_due() {
  if (!tested_.description().has_event_mode) return false;
  const bool is_announced = position_.next_event && *position_.next_event <= position_.now;
  return is_announced || !clocks_->due(position_.now).empty();
}

bool TestInstance::ticks(ValueReference clock) const {
  return std::find(ticking_.begin(), ticking_.end(), clock) != ticking_.end();
}

void TestInstance::handle_events(std::optional<std::size_t> k) {
  unit().enter_event_mode();
  if (k) {
    set_inputs(*k, false);
    tick_triggered(*k);
  }
  finish_events();
}

void TestInstance::tick_triggered(std::size_t k) {
  if (!stimulus_->ticks_at(k)) return;
  for (const Variable& variable : tested_.description().variables) {
    const bool can_tick = is_triggered_input(variable) &&
                          !carries_messages(tested_.description(), variable.reference);
    if (!can_tick) continue;
    ValueBlock tick(ValueType::Clock, variable.size);
    std::ranges::fill(tick.numbers<bool>(), true);
    set(variable, tick);
    ticking_.push_back(variable.reference);
  }
}

/// The iterations of Event Mode, and back to Step Mode.
void TestInstance::finish_events() {
  for (int iteration = 0;; ++iteration) {
    if (iteration == kMostIterations) {
      throw Failure(fmt::format("at {} s its events do not come to an end: {} iterations",
                                core::to_text(position_.now), iteration));
    }
    if (!clocks_->due(position_.now).empty()) {
      clocks_->tick(position_.now);
      const auto ticked = clocks_->ticking(0);
      ticking_.insert(ticking_.end(), ticked.begin(), ticked.end());
    }
    set_clocked_inputs(position_.point);
    record_ticks();
    const core::EventResult result = unit().update_discrete_states();
    ticking_.clear();
    clocks_->update(0, position_.now);
    position_.next_event = result.next_event_time;
    recording_.has_ended = recording_.has_ended || result.terminate_simulation;
    if (result.next_event_time && *result.next_event_time < position_.now) {
      throw Failure(fmt::format("at {} s it announces its next event for {} s, which is over",
                                core::to_text(position_.now),
                                core::to_text(*result.next_event_time)));
    }
    const bool is_over = !result.discrete_states_need_update && clocks_->due(position_.now).empty();
    if (is_over || recording_.has_ended) break;
  }
  ++recording_.events;
  unit().enter_step_mode();
}

/// The output clocks that tick, and what has the time of a clock that ticks.
void TestInstance::record_ticks() {
  const core::UnitDescription& description = tested_.description();
  std::vector<ValueReference> active = ticking_;
  Row row{position_.now, {}, true};
  for (const Variable& variable : description.variables) {
    if (variable.type != ValueType::Clock || variable.causality != Causality::Output) continue;
    if (!get(variable).numbers<bool>()[0]) continue;
    active.push_back(variable.reference);
    row.values.push_back(variable.name);
  }
  if (!records_ || active.empty()) return;
  for (const Variable& variable : description.variables) {
    const bool is_read = variable.is_clocked() && variable.causality == Causality::Output &&
                         variable.type != ValueType::Clock &&
                         std::any_of(active.begin(), active.end(), [&](ValueReference clock) {
                           return variable.belongs_to(clock);
                         });
    if (!is_read) continue;
    const ValueBlock value = get(variable);
    row.values.push_back(variable.name + "=" + core::elements_text(value));
  }
  if (!row.values.empty()) recording_.rows.push_back(std::move(row));
}

// ---- States ----

void TestInstance::save(std::size_t slot) {
  auto& state = capability<core::StateSaving>();
  state.select_state(slot);
  state.save_state();
  if (saved_.size() <= slot) saved_.resize(slot + 1);
  saved_[slot].position = position_;
  saved_[slot].clocks.emplace(*clocks_);
}

void TestInstance::restore(std::size_t slot) {
  auto& state = capability<core::StateSaving>();
  state.select_state(slot);
  state.restore_state();
  set_position(saved_[slot].position, &*saved_[slot].clocks);
}

void TestInstance::set_position(const Position& position, const core::Clocks* clocks) {
  position_ = position;
  if (clocks != nullptr) clocks_->resume(*clocks);
  recording_.has_ended = false;
}

}  // namespace stride::verify
