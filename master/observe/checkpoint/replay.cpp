#include "master/observe/checkpoint/replay.h"

#include <bit>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"

namespace stride::checkpoint {
namespace {

/// The unit answers something else.
class Difference : public core::Error {
 public:
  using Error::Error;
};

[[noreturn]] void fail_order() {
  throw core::BadState("the journal has a call in a place where it cannot be");
}

}  // namespace

Replay::Replay(core::Unit& unit, const core::UnitDescription& description, Journal& journal,
               const Options& options)
    : unit_(unit),
      description_(description),
      journal_(journal),
      options_(options),
      records_(journal.log_, journal.log_.begin()) {}

void Replay::run(const Context& from) {
  context_ = from;
  journal_.lists_.forget_values();
  if (context_.has_input_update) answer_input_requests(true);
  try {
    while (!records_.is_at_end()) repeat_next();
  } catch (const Difference&) {
    throw;
  } catch (const core::Error& error) {
    throw core::Error(
        error.kind(), error.context(),
        "what it did before was repeated, to resume it, and failed: " + error.message(),
        error.hint());
  }
  compare_check();
}

void Replay::compare_check() {
  const Context& end = journal_.context_;
  if (context_.answers.hash() != end.answers.hash()) fail_other("");
  if (context_.time != end.time || context_.steps != end.steps) {
    throw core::BadState("the journal ends at another time than it says");
  }
}

void Replay::fail_other(const std::string& what) const {
  core::Context context = options_.context;
  context.time = context_.time;
  throw Difference(
      core::Error::Kind::Run, context,
      fmt::format("it cannot be resumed: its calls were repeated, and up to here it answered "
                  "something else than before{}",
                  what),
      "a unit that does not serialise its state must do the same again where it is given the same; "
      "let it serialise its state (canSerializeFMUState), or look for what it takes from outside: "
      "random numbers without a seed, the time of day, files, the path of its resources");
}

template <core::CapabilityInterface C>
C& Replay::capability() {
  C* const found = unit_.capability<C>();
  if (found == nullptr) throw core::BadState("the journal has a call that the unit does not know");
  return *found;
}

// ---- Calls ----

void Replay::repeat_next() {
  const Call call = records_.take_call();
  switch (call) {
    case Call::ForgetValues:
      return journal_.lists_.forget_values();
    case Call::Set:
      return set();
    case Call::Get:
      return get();
    default:
      if (is_in_step_) fail_order();
      return repeat(call);
  }
}

void Replay::repeat(Call call) {
  switch (call) {
    case Call::EnterConfigurationMode:
      return capability<core::ConfigurationMode>().enter_configuration_mode();
    case Call::ExitConfigurationMode:
      return capability<core::ConfigurationMode>().exit_configuration_mode();
    case Call::EnterInitialization:
      return initialize();
    case Call::ExitInitialization:
      return unit_.exit_initialization();
    case Call::EnterEventMode:
      return unit_.enter_event_mode();
    case Call::UpdateDiscreteStates:
      return update_discrete_states();
    case Call::EnterStepMode:
      return unit_.enter_step_mode();
    case Call::Step:
      return step();
    case Call::EnableIdleSkipping:
      return capability<core::IdlePromises>().enable_idle_skipping(records_.take_duration());
    case Call::SetIdleTolerances:
      return set_idle_tolerances();
    case Call::GetClockInterval:
      return add(context_.answers, capability<core::ClockIntervals>().clock_interval(take_clock()));
    case Call::GetClockShift:
      return add(context_.answers, capability<core::ClockIntervals>().clock_shift(take_clock()));
    case Call::SetInputUpdate:
      return answer_input_requests(records_.take() != 0);
    default:
      fail_order();
  }
}

void Replay::initialize() {
  const Time start = records_.take_time();
  std::optional<Time> stop;
  if (records_.take() != 0) stop = records_.take_time();
  if (options_.stop) stop = options_.stop;
  context_.time = start;
  unit_.enter_initialization(start, stop);
}

void Replay::set() {
  VariableList& list = records_.take_values(journal_.lists_);
  unit_.set(list.references, list.set_block());
}

void Replay::get() {
  VariableList& list = journal_.lists_[records_.take_number(journal_.lists_)];
  unit_.get(list.references, list.read_block());
  context_.answers.add(list.read_block());
}

void Replay::update_discrete_states() {
  add(context_.answers, unit_.update_discrete_states());
  if (records_.take() != context_.answers.byte()) fail_other("");
}

void Replay::set_idle_tolerances() {
  std::vector<core::ValueReference> outputs;
  for (std::uint64_t count = records_.take_count(); count > 0; --count) {
    outputs.push_back(static_cast<core::ValueReference>(records_.take_count()));
  }
  std::vector<double> tolerances;
  for (std::size_t i = 0; i < outputs.size(); ++i) tolerances.push_back(records_.take_double());
  capability<core::IdlePromises>().set_idle_tolerances(outputs, tolerances);
}

const core::Variable& Replay::take_clock() {
  const auto found = description_.find(static_cast<core::ValueReference>(records_.take_count()));
  if (!found || !description_.variables[*found].clock) {
    throw core::BadState("the journal has a clock that the unit does not have");
  }
  return description_.variables[*found];
}

// ---- Steps ----

void Replay::step() {
  const core::StepInterval interval = take_interval();
  const core::StepValues values = take_step_values();
  context_.time = interval.from;
  context_.step = interval.to - interval.from;
  is_in_step_ = true;
  const core::StepResult result = unit_.step(interval, values);
  is_in_step_ = false;
  compare_end(interval, result, values);
}

core::StepInterval Replay::take_interval() {
  const unsigned bits = records_.take();
  const Time from = (bits & StepBits::kFromHere) != 0 ? context_.time : records_.take_time();
  const Duration size = (bits & StepBits::kAsLong) != 0 ? context_.step : records_.take_duration();
  if (size < Duration{} || from > Time::max() - size) {
    throw core::BadState("the journal has a step that does not lead on");
  }
  core::StepInterval interval(from, from + size);
  interval.may_go_back_before = (bits & StepBits::kMayGoBackBefore) != 0;
  return interval;
}

core::StepValues Replay::take_step_values() {
  inputs_.clear();
  for (std::uint64_t count = records_.take_count(); count > 0; --count) {
    VariableList& list = records_.take_values(journal_.lists_);
    inputs_.emplace_back(list.references, list.set_block());
  }
  outputs_.clear();
  for (std::uint64_t count = records_.take_count(); count > 0; --count) {
    VariableList& list = journal_.lists_[records_.take_number(journal_.lists_)];
    outputs_.emplace_back(list.references, list.read_block());
  }
  return {inputs_, outputs_};
}

void Replay::compare_end(const core::StepInterval& interval, const core::StepResult& result,
                         const core::StepValues& values) {
  if (!result.rejected) {
    for (const core::BoundValues& output : values.outputs) context_.answers.add(*output.block);
    context_.time = result.reached;
    ++context_.steps;
  }
  if (records_.take_call() != Call::EndStep) {
    fail_other(": it asked for its inputs within the step less often");
  }
  const unsigned bits = records_.take();
  const bool reached_end = (bits & EndBits::kReachedEnd) != 0;
  const Time reached = reached_end ? interval.to : records_.take_time();
  const bool is_same = result.rejected == ((bits & EndBits::kRejected) != 0) &&
                       result.early_return == ((bits & EndBits::kEarly) != 0) &&
                       result.event_handling_needed == ((bits & EndBits::kEvent) != 0) &&
                       result.terminate_simulation == ((bits & EndBits::kTerminate) != 0) &&
                       result.reached == reached;
  if (!is_same) fail_other(": its step ended otherwise");
  if (records_.take() != context_.answers.byte()) fail_other("");
}

// ---- Inputs within a step ----

void Replay::answer_input_requests(bool answers) {
  core::InputUpdate update;
  if (answers) update = [this](double seconds) { answer_inputs(seconds); };
  capability<core::InputsWithinStep>().set_input_update(std::move(update));
}

/// What was set and read when the unit asked for this instant.
void Replay::answer_inputs(double seconds_into_step) {
  const bool is_request = records_.next_call() == Call::RequestInputs;
  if (is_request) records_.take_call();
  const bool is_same = is_request && std::bit_cast<std::uint64_t>(records_.take_double()) ==
                                         std::bit_cast<std::uint64_t>(seconds_into_step);
  if (!is_same) fail_other(": it asked for its inputs at another instant within the step");
  for (Call next = records_.next_call(); next == Call::Set || next == Call::Get;
       next = records_.next_call()) {
    repeat_next();
  }
}

}  // namespace stride::checkpoint
