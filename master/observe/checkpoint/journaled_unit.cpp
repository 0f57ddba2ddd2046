#include "master/observe/checkpoint/journaled_unit.h"

#include <stdexcept>
#include <utility>

#include "master/engine/port/capabilities/resetting.h"

namespace stride::checkpoint {

JournaledUnit::JournaledUnit(std::unique_ptr<core::Unit> unit,
                             const core::UnitDescription& description, Options options)
    : ForwardingUnit(std::move(unit)),
      configuration_(inner().capability<core::ConfigurationMode>()),
      state_(inner().capability<core::StateSaving>()),
      serialization_(inner().capability<core::StateSerialization>()),
      idle_(inner().capability<core::IdlePromises>()),
      clocks_(inner().capability<core::ClockIntervals>()),
      inputs_within_step_(inner().capability<core::InputsWithinStep>()),
      concurrent_(inner().capability<core::ConcurrentSteps>()),
      diagnostics_(inner().capability<core::UnitDiagnostics>()),
      description_(description),
      options_(std::move(options)) {}

core::Capability* JournaledUnit::find_capability(core::CapabilityId id) {
  if (id == core::StateSerialization::kId || id == core::Resetting::kId) return nullptr;
  return find_decorated<core::ConfigurationMode, core::StateSaving, core::IdlePromises,
                        core::ClockIntervals, core::InputsWithinStep, core::ConcurrentSteps>(*this,
                                                                                             id);
}

/// Of the unit, now.
core::Context JournaledUnit::context() const {
  core::Context context = options_.context;
  context.time = journal_.context().time;
  return context;
}

// ---- Initialization ----

void JournaledUnit::enter_configuration_mode() {
  configuration_->enter_configuration_mode();
  journal_.add(Call::EnterConfigurationMode);
}

void JournaledUnit::exit_configuration_mode() {
  configuration_->exit_configuration_mode();
  journal_.add(Call::ExitConfigurationMode);
}

void JournaledUnit::enable_idle_skipping(Duration max_skip) {
  idle_->enable_idle_skipping(max_skip);
  journal_.add_idle_skipping(max_skip);
}

void JournaledUnit::set_idle_tolerances(std::span<const core::ValueReference> outputs,
                                        std::span<const double> tolerances) {
  idle_->set_idle_tolerances(outputs, tolerances);
  journal_.add_idle_tolerances(outputs, tolerances);
}

void JournaledUnit::enter_initialization(Time start, std::optional<Time> stop) {
  inner().enter_initialization(start, stop);
  journal_.add_initialization(start, stop);
  start_ = start;
}

void JournaledUnit::exit_initialization() {
  inner().exit_initialization();
  journal_.add(Call::ExitInitialization);
  if (!description_.has_event_mode) end_initialization();
}

void JournaledUnit::end_initialization() {
  if (std::exchange(is_initialized_, true)) return;
  if (serialization_ != nullptr && state_ != nullptr && !saved_) try_serialization();
}

// ---- Values ----

void JournaledUnit::get(std::span<const core::ValueReference> references,
                        core::ValueBlock& values) {
  inner().get(references, values);
  journal_.add_get(references, values);
}

void JournaledUnit::set(std::span<const core::ValueReference> references,
                        const core::ValueBlock& values) {
  inner().set(references, values);
  journal_.add_set(references, values);
}

// ---- Steps ----

core::StepResult JournaledUnit::step(const core::StepInterval& interval) {
  journal_.add_step(interval, {});
  is_in_step_ = true;
  const core::StepResult result = inner().step(interval);
  note_end_of_step(result, {});
  return result;
}

core::StepResult JournaledUnit::step(const core::StepInterval& interval,
                                     const core::StepValues& values) {
  journal_.add_step(interval, values);
  is_in_step_ = true;
  const core::StepResult result = inner().step(interval, values);
  note_end_of_step(result, values.outputs);
  return result;
}

/// Where the state is saved the inputs are a part of it.
void JournaledUnit::begin_step(const core::StepInterval& interval, const core::StepValues& values,
                               const Extras& extras) {
  core::StepValues noted = values;
  if (extras.saves_state) {
    for (const core::BoundValues& input : values.inputs) {
      journal_.add_set(input.references, *input.block);
    }
    noted.inputs = {};
    saved_ = journal_.mark();
    drop_needless_states();
  }
  journal_.add_step(interval, noted);
  is_in_step_ = true;
  outputs_ = values.outputs;
  concurrent_->begin_step(interval, values, extras);
}

core::StepResult JournaledUnit::finish_step() {
  const core::StepResult result = concurrent_->finish_step();
  note_end_of_step(result, outputs_);
  return result;
}

void JournaledUnit::note_end_of_step(const core::StepResult& result,
                                     std::span<const core::BoundValues> outputs) {
  journal_.add_step_end(result, outputs);
  is_in_step_ = false;
}

void JournaledUnit::set_input_update(core::InputUpdate update) {
  input_update_ = std::move(update);
  connect_input_update();
  journal_.add_input_update(static_cast<bool>(input_update_));
}

void JournaledUnit::connect_input_update() {
  core::InputUpdate noted;
  if (input_update_) noted = [this](double seconds) { update_inputs(seconds); };
  inputs_within_step_->set_input_update(std::move(noted));
}

void JournaledUnit::update_inputs(double seconds_into_step) {
  journal_.add_input_request(seconds_into_step);
  input_update_(seconds_into_step);
}

// ---- Events ----

void JournaledUnit::enter_event_mode() {
  inner().enter_event_mode();
  journal_.add(Call::EnterEventMode);
}

core::EventResult JournaledUnit::update_discrete_states() {
  const core::EventResult result = inner().update_discrete_states();
  journal_.add_event(result);
  return result;
}

void JournaledUnit::enter_step_mode() {
  inner().enter_step_mode();
  journal_.add(Call::EnterStepMode);
  end_initialization();
}

core::ClockInterval JournaledUnit::clock_interval(const core::Variable& clock) {
  const core::ClockInterval answer = clocks_->clock_interval(clock);
  journal_.add_clock_interval(clock.reference, answer);
  return answer;
}

core::Interval JournaledUnit::clock_shift(const core::Variable& clock) {
  const core::Interval answer = clocks_->clock_shift(clock);
  journal_.add_clock_shift(clock.reference, answer);
  return answer;
}

// ---- The state that is saved for the caller ----

void JournaledUnit::save_state() {
  state_->save_state();
  saved_ = journal_.mark();
  drop_needless_states();
}

void JournaledUnit::restore_state() {
  state_->restore_state();
  if (!saved_) return;
  journal_.cut(*saved_);
  while (states_.size() > 1 && states_.back().mark.position > saved_->position) states_.pop_back();
}

void JournaledUnit::select_state(std::size_t) {
  throw std::logic_error("this kind of unit keeps one state only");
}

}  // namespace stride::checkpoint
