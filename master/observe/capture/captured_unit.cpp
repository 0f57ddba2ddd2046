#include "master/observe/capture/captured_unit.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "master/engine/port/capabilities/concurrent_steps.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_serialization.h"

namespace stride::capture {
namespace {

/// Whether the bits are the same, as -0 and 0 have not.
bool is_same(const core::ValueBlock& a, const core::ValueBlock& b) {
  return core::visit(a, [&]<class T>(std::span<const T> elements) {
    if constexpr (std::is_arithmetic_v<T>) {
      return std::memcmp(a.bytes(), b.bytes(), elements.size_bytes()) == 0;
    } else {
      return a == b;
    }
  });
}

core::ValueBlock part(const core::ValueBlock& values, std::size_t first, std::size_t size) {
  core::ValueBlock copy(values.type(), size);
  core::visit(copy, [&]<class T>(std::span<T> elements) {
    core::visit(values, [&]<class U>(std::span<const U> all) {
      if constexpr (std::is_same_v<T, U>)
        std::ranges::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first),
                            static_cast<std::ptrdiff_t>(size), elements.begin());
    });
  });
  return copy;
}

}  // namespace

CapturedUnit::CapturedUnit(std::unique_ptr<core::Unit> unit,
                           const core::UnitDescription& description, StimuliFile& file,
                           const SuperDenseIndex& index)
    : ForwardingUnit(std::move(unit)),
      state_(inner().capability<core::StateSaving>()),
      idle_(inner().capability<core::IdlePromises>()),
      description_(description),
      file_(file),
      index_(index) {
  for (const core::Variable& variable : description.variables) {
    if (is_stimulus(variable)) inputs_.push_back({&variable, description.is_message(variable)});
  }
  std::ranges::sort(inputs_, {}, [](const Input& input) { return input.variable->reference; });
}

core::Capability* CapturedUnit::find_capability(core::CapabilityId id) {
  const bool is_left_out = id == core::StateSerialization::kId || id == core::Resetting::kId ||
                           id == core::ConcurrentSteps::kId;
  if (is_left_out) return nullptr;
  return find_decorated<core::StateSaving, core::IdlePromises>(*this, id);
}

CapturedUnit::Input* CapturedUnit::find_input(core::ValueReference reference) {
  const auto found = std::ranges::lower_bound(
      inputs_, reference, {}, [](const Input& input) { return input.variable->reference; });
  return found != inputs_.end() && found->variable->reference == reference ? &*found : nullptr;
}

// ---- What arrives ----

void CapturedUnit::set(std::span<const core::ValueReference> references,
                       const core::ValueBlock& values) {
  ForwardingUnit::set(references, values);
  note(references, values);
}

void CapturedUnit::note(std::span<const core::ValueReference> references,
                        const core::ValueBlock& values) {
  std::size_t first = 0;
  for (const core::ValueReference reference : references) {
    Input* const input = find_input(reference);
    const core::Variable& variable =
        input != nullptr ? *input->variable : description_.variables[*description_.find(reference)];
    if (mode_ == Mode::Start) file_.add_start_value(variable, values, first);
    if (input != nullptr) note(*input, values, first);
    first += variable.size;
  }
}

void CapturedUnit::note(Input& input, const core::ValueBlock& values, std::size_t first) {
  core::ValueBlock now = part(values, first, input.variable->size);
  if (input.variable->type == core::ValueType::Clock) {
    if (now.numbers<bool>()[0]) waiting_.push_back({&input, std::move(now)});
    return;
  }
  if (!input.is_message && input.latest && is_same(*input.latest, now)) return;
  input.latest = now;
  if (mode_ == Mode::Event) {
    waiting_.push_back({&input, std::move(now)});
  } else if (mode_ == Mode::Step) {
    write(input, "", now);
  }
}

void CapturedUnit::write(const Input& input, std::string_view event,
                         const core::ValueBlock& values) {
  if (input.variable->type == core::ValueType::Clock) {
    file_.add_tick(time_, event, *input.variable);
  } else {
    file_.add_value(time_, event, *input.variable, values, 0);
  }
}

void CapturedUnit::write_waiting(std::uint64_t index) {
  const std::string event = std::to_string(index);
  for (const Waiting& waiting : waiting_) write(*waiting.input, event, waiting.values);
  waiting_.clear();
}

// ---- Recorded calls ----

void CapturedUnit::enter_initialization(Time start, std::optional<Time> stop) {
  ForwardingUnit::enter_initialization(start, stop);
  file_.end_head(start);
  time_ = start;
  mode_ = Mode::Initialization;
}

/// What was tried on the way to the initial values is left out.
void CapturedUnit::exit_initialization() {
  ForwardingUnit::exit_initialization();
  for (const Input& input : inputs_) {
    if (input.latest) write(input, "", *input.latest);
  }
  mode_ = description_.has_event_mode ? Mode::Event : Mode::Step;
}

core::StepResult CapturedUnit::step(const core::StepInterval& interval) {
  const core::StepResult result = ForwardingUnit::step(interval);
  note_step(interval, result);
  return result;
}

core::StepResult CapturedUnit::step(const core::StepInterval& interval,
                                    const core::StepValues& values) {
  const core::StepResult result = ForwardingUnit::step(interval, values);
  for (const core::BoundValues& input : values.inputs) note(input.references, *input.block);
  note_step(interval, result);
  return result;
}

void CapturedUnit::note_step(const core::StepInterval& interval, const core::StepResult& result) {
  if (result.rejected) return;
  file_.add_step(interval.from, interval.to);
  time_ = result.reached;
}

void CapturedUnit::enter_event_mode() {
  ForwardingUnit::enter_event_mode();
  mode_ = Mode::Event;
}

core::EventResult CapturedUnit::update_discrete_states() {
  const std::uint64_t index = index_.at(time_);
  write_waiting(index);
  next_index_ = index + 1;
  return ForwardingUnit::update_discrete_states();
}

void CapturedUnit::enter_step_mode() {
  ForwardingUnit::enter_step_mode();
  write_waiting(next_index_);
  mode_ = Mode::Step;
}

// ---- States, idle time, the end ----

void CapturedUnit::persist(core::StateArchive& state) {
  state.value(mode_, Mode::Step);
  state.value(time_);
  state.value(next_index_);
  state.fixed(inputs_, [&](Input& input) {
    bool has_value = input.latest.has_value();
    state.value(has_value);
    if (!has_value) return input.latest.reset();
    if (!input.latest) input.latest.emplace(input.variable->type, input.variable->size);
    core::persist(state, *input.latest);
  });
  file_.persist(state);
}

void CapturedUnit::save_state() {
  state_->save_state();
  saved_ = {file_.mark(), time_, mode_, inputs_};
}

void CapturedUnit::restore_state() {
  state_->restore_state();
  file_.drop(saved_.mark);
  time_ = saved_.time;
  mode_ = saved_.mode;
  inputs_ = saved_.inputs;
}

void CapturedUnit::select_state(std::size_t) {
  throw std::logic_error("this kind of unit keeps one state only");
}

void CapturedUnit::enable_idle_skipping(Duration max_skip) {
  idle_->enable_idle_skipping(max_skip);
  file_.add_skip(max_skip);
}

void CapturedUnit::set_idle_tolerances(std::span<const core::ValueReference> outputs,
                                       std::span<const double> tolerances) {
  idle_->set_idle_tolerances(outputs, tolerances);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    file_.add_tolerance(description_.variables[*description_.find(outputs[i])], tolerances[i]);
  }
}

/// After another unit's failure its last step may be one that the others have not made.
void CapturedUnit::terminate() {
  ForwardingUnit::terminate();
  if (index_.has_reached(time_)) commit();
}

}  // namespace stride::capture
