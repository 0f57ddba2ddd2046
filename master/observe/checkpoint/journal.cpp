#include "master/observe/checkpoint/journal.h"

#include <bit>

namespace stride::checkpoint {

// ---- Answers ----

void add(AnswerCheck& check, const core::EventResult& result) {
  check.add((result.discrete_states_need_update ? 1U : 0U) |
            (result.terminate_simulation ? 2U : 0U) | (result.next_event_time ? 4U : 0U));
  if (!result.next_event_time) return;
  const auto [seconds, picoseconds] = split(result.next_event_time->time_since_epoch());
  check.add(static_cast<std::uint64_t>(seconds));
  check.add(static_cast<std::uint64_t>(picoseconds));
}

void add(AnswerCheck& check, const core::ClockInterval& answer) {
  check.add(static_cast<std::uint64_t>(answer.state));
  add(check, answer.interval);
}

void add(AnswerCheck& check, const core::Interval& answer) {
  check.add(std::bit_cast<std::uint64_t>(answer.seconds()));
}

// ---- Parts ----

void Journal::cut(const Mark& mark) {
  log_.cut(mark.position);
  context_ = mark.context;
  begin_part();
}

void Journal::begin_part() {
  lists_.forget_values();
  add(Call::ForgetValues);
}

// ---- Records ----

void Journal::add(Call call) { record(call); }

void Journal::add_initialization(Time start, std::optional<Time> stop) {
  RecordWriter to = record(Call::EnterInitialization);
  to.put_time(start);
  to.put(stop ? 1 : 0);
  if (stop) to.put_time(*stop);
  context_.time = start;
}

void Journal::put_values(RecordWriter& record, std::span<const core::ValueReference> references,
                         const core::ValueBlock& values) {
  const VariableLists::Number number = lists_.number_of(references, values);
  record.put_values(number, lists_[number], values);
}

void Journal::add_set(std::span<const core::ValueReference> references,
                      const core::ValueBlock& values) {
  RecordWriter to = record(Call::Set);
  put_values(to, references, values);
}

void Journal::add_get(std::span<const core::ValueReference> references,
                      const core::ValueBlock& values) {
  record(Call::Get).put_count(lists_.number_of(references, values));
  context_.answers.add(values);
}

void Journal::add_step(const core::StepInterval& interval, const core::StepValues& values) {
  const Duration size = interval.to - interval.from;
  const bool is_from_here = interval.from == context_.time;
  const bool is_as_long = size == context_.step;
  unsigned bits = interval.may_go_back_before ? StepBits::kMayGoBackBefore : 0;
  if (is_from_here) bits |= StepBits::kFromHere;
  if (is_as_long) bits |= StepBits::kAsLong;
  RecordWriter to = record(Call::Step);
  to.put(static_cast<std::uint8_t>(bits));
  if (!is_from_here) to.put_time(interval.from);
  if (!is_as_long) to.put_duration(size);
  to.put_count(values.inputs.size());
  for (const core::BoundValues& input : values.inputs) {
    put_values(to, input.references, *input.block);
  }
  to.put_count(values.outputs.size());
  for (const core::BoundValues& output : values.outputs) {
    to.put_count(lists_.number_of(output.references, *output.block));
  }
  context_.time = interval.from;
  context_.step = size;
  step_end_ = interval.to;
}

void Journal::add_input_request(double seconds_into_step) {
  record(Call::RequestInputs).put_double(seconds_into_step);
}

void Journal::add_step_end(const core::StepResult& result,
                           std::span<const core::BoundValues> outputs) {
  if (!result.rejected) {
    for (const core::BoundValues& output : outputs) context_.answers.add(*output.block);
    context_.time = result.reached;
    ++context_.steps;
  }
  unsigned bits = result.rejected ? EndBits::kRejected : 0;
  if (result.early_return) bits |= EndBits::kEarly;
  if (result.event_handling_needed) bits |= EndBits::kEvent;
  if (result.terminate_simulation) bits |= EndBits::kTerminate;
  if (result.reached == step_end_) bits |= EndBits::kReachedEnd;
  RecordWriter to = record(Call::EndStep);
  to.put(static_cast<std::uint8_t>(bits));
  if (result.reached != step_end_) to.put_time(result.reached);
  to.put(context_.answers.byte());
}

void Journal::add_event(const core::EventResult& result) {
  checkpoint::add(context_.answers, result);
  record(Call::UpdateDiscreteStates).put(context_.answers.byte());
}

void Journal::add_idle_skipping(Duration max_skip) {
  record(Call::EnableIdleSkipping).put_duration(max_skip);
}

void Journal::add_idle_tolerances(std::span<const core::ValueReference> outputs,
                                  std::span<const double> tolerances) {
  RecordWriter to = record(Call::SetIdleTolerances);
  to.put_count(outputs.size());
  for (const core::ValueReference output : outputs) to.put_count(output);
  for (const double tolerance : tolerances) to.put_double(tolerance);
}

void Journal::add_clock_interval(core::ValueReference clock, const core::ClockInterval& answer) {
  record(Call::GetClockInterval).put_count(clock);
  checkpoint::add(context_.answers, answer);
}

void Journal::add_clock_shift(core::ValueReference clock, const core::Interval& answer) {
  record(Call::GetClockShift).put_count(clock);
  checkpoint::add(context_.answers, answer);
}

void Journal::add_input_update(bool is_set) {
  record(Call::SetInputUpdate).put(is_set ? 1 : 0);
  context_.has_input_update = is_set;
}

// ---- Its state ----

void Journal::persist(core::StateArchive& state, Context& context) {
  state.value(context.time);
  state.value(context.step);
  state.value(context.steps);
  state.value(context.has_input_update);
  std::uint64_t hash = context.answers.hash();
  state.value(hash);
  context.answers = AnswerCheck(hash);
}

void Journal::persist(core::StateArchive& state, const core::UnitDescription& description,
                      ByteLog::Position from) {
  state.mark("journal");
  lists_.persist(state, description);
  log_.persist(state, from);
  persist(state, context_);
}

}  // namespace stride::checkpoint
