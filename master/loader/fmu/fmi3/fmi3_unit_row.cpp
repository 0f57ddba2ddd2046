#include "master/loader/fmu/fmi3/fmi3_unit_row.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace stride::importer {
namespace {

constexpr const char* kSet = "fmi3SetFloat64";
constexpr const char* kStep = "fmi3DoStep";
constexpr const char* kGet = "fmi3GetFloat64";

/// Of two blocks at most, how many there are.
std::uint64_t count_of(const core::StepValues& values) {
  return values.inputs.size() + values.outputs.size();
}

}  // namespace

// ---- Which units are in it ----

std::vector<PresentCall*> Fmi3Unit::Row::present_calls(std::span<const Member> members) {
  std::vector<PresentCall*> calls;
  for (const Member& member : members) {
    calls.push_back(&static_cast<Fmi3Unit*>(member.unit)->present_);
  }
  return calls;
}

Fmi3Unit::Row::Row(std::span<const Member> members)
    : InstanceRow(present_calls(members)),
      mode_(static_cast<Fmi3Unit*>(members.front().unit)->mode_) {
  std::size_t references = 0;
  for (const auto& [unit, values] : members) {
    for (const auto& blocks : {values.inputs, values.outputs}) {
      if (!blocks.empty()) references += blocks.front().references.size();
    }
  }
  references_.reserve(references);
  for (const auto& [unit, values] : members) {
    auto& in_row = static_cast<Fmi3Unit&>(*unit);
    const Block input = block(values.inputs), output = block(values.outputs);
    members_.push_back({in_row.instance_,
                        &in_row.fmi_,
                        &in_row,
                        &in_row.present_.left(),
                        input,
                        output,
                        {},
                        in_row.options_.may_go_back});
    values_.push_back(values);
    in_row.set_row(this, 1 + count_of(values));
  }
}

Fmi3Unit::Row::~Row() {
  settle();
  for (const InRow& member : members_) member.unit->set_row(nullptr, 0);
}

/// The references are copied, so that those of all units are close together.
Fmi3Unit::Row::Block Fmi3Unit::Row::block(std::span<const core::BoundValues> blocks) {
  if (blocks.empty()) return {};
  const auto& [references, values, unused] = blocks.front();
  const std::size_t first = references_.size();
  references_.insert(references_.end(), references.begin(), references.end());
  return {references_.data() + first, values.data(), static_cast<std::uint32_t>(references.size()),
          static_cast<std::uint32_t>(values.size())};
}

// ---- Steps ----

bool Fmi3Unit::Row::step(const core::StepInterval& interval, Progress& progress) {
  if (!is_quick(interval)) [[unlikely]]
    return step_singly(interval, progress);
  const double tolerance = time_tolerance(interval);
  InRow* member = members_.data();
  InRow* const end = member + members_.size();
  from_now_ = interval.from;
  to_now_ = interval.to;
  is_close_ = false;
  noted_ = calls_ = 0;
  core::ForkMark::set();
  present_.begin(member->unit->present_, *member->left, interval.from);
  try {
    while (member != end && step_quickly(*member, interval, tolerance, progress.result)) ++member;
  } catch (...) {
    conclude(member, progress);
    throw;
  }
  if (member == end && !is_close_ && has_usual_signals(members_.back())) [[likely]] {
    present_.end();
    add_step(interval.from, interval.to);
    return true;
  }
  conclude(member, progress);
  return member == end;
}

bool Fmi3Unit::Row::step_singly(const core::StepInterval& interval, Progress& progress) {
  is_watched_ = false;
  stop_seconds_ = std::numeric_limits<double>::infinity();
  for (const InRow& member : members_) {
    is_watched_ |= member.unit->calls() < kCloselyWatched;
    stop_seconds_ = std::min(stop_seconds_, member.unit->stop_seconds_);
  }
  for (; progress.plain < members_.size(); ++progress.plain) {
    progress.result = members_[progress.plain].unit->step(interval, values_[progress.plain]);
    if (!progress.result.reached_without_request(interval.to)) return false;
  }
  return true;
}

/// Returns whether the unit has just reached the end. If not, `result` is how its step has ended.
[[gnu::always_inline]] inline bool Fmi3Unit::Row::step_quickly(InRow& member,
                                                               const core::StepInterval& interval,
                                                               double tolerance,
                                                               core::StepResult& result) {
  present_.begin_member(member.unit->present_, *member.left, interval.from);
  const ModeCheck check{*this, member};
  StepAnswer step{.last_successful = interval.end_seconds};
  if (member.input.count != 0) {
    const Status status = set(member);
    if (status != Status::Ok || !are_all_quiet()) [[unlikely]]
      return go_on(member, interval, {Stage::Set, status, step}, result);
  }
  const Status status = do_step(member, interval, step);
  const bool is_plain = status == Status::Ok && are_all_quiet() &&
                        !(step.needs_event | step.terminate | step.early) &&
                        is_usual_end(member, interval, step.last_successful, tolerance);
  if (!is_plain) [[unlikely]]
    return go_on(member, interval, {Stage::Step, status, step}, result);
  if (member.output.count == 0) return true;
  present_.set_time(interval.to);
  const Status read = get(member);
  if (read != Status::Ok || !are_all_quiet()) [[unlikely]]
    return go_on(member, interval, {Stage::Get, read, step}, result);
  return true;
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline Status Fmi3Unit::Row::call(const InRow& member, Stage stage,
                                                         Function* function,
                                                         Arguments... arguments) {
  const char* const name = stage == Stage::Set ? kSet : stage == Stage::Step ? kStep : kGet;
  present_.begin_next(name);
  try {
    return static_cast<Status>(function(member.instance, arguments...));
  } catch (...) {
    look_closely(member, stage);
    member.unit->fail_thrown(name);
  }
}

[[gnu::always_inline]] inline Status Fmi3Unit::Row::set(const InRow& member) {
  const Block& input = member.input;
  return call(member, Stage::Set, member.functions->SetFloat64, input.references, input.count,
              input.values, input.size);
}

[[gnu::always_inline]] inline Status Fmi3Unit::Row::do_step(const InRow& member,
                                                            const core::StepInterval& interval,
                                                            StepAnswer& answer) {
  // noSetFMUStatePriorToCurrentPoint
  const fmi3Boolean never_goes_back = !(member.may_go_back | interval.may_go_back_before);
  return call(member, Stage::Step, member.functions->DoStep, interval.begin_seconds,
              interval.size_seconds, never_goes_back, &answer.needs_event, &answer.terminate,
              &answer.early, &answer.last_successful);
}

[[gnu::always_inline]] inline Status Fmi3Unit::Row::get(const InRow& member) {
  const Block& output = member.output;
  return call(member, Stage::Get, member.functions->GetFloat64, output.references, output.count,
              output.values, output.size);
}

// ---- A call that leaves more than a status ----

/// The rest of a unit step behind a call that has, or may have, answered something else than usual;
/// as step_quickly().
[[gnu::noinline]] bool Fmi3Unit::Row::go_on(InRow& member, const core::StepInterval& interval,
                                            Answer answer, core::StepResult& result) {
  if (answer.stage == Stage::Set) {
    look_closely(member, Stage::Set);
    member.unit->check_left_by_whole_call(kSet, answer.status);
    answer.status = do_step(member, interval, answer.step);
    answer.stage = Stage::Step;
  }
  result = {.reached = interval.to};
  if (answer.stage == Stage::Step) {
    result = end_step(member, interval, answer);
    if (!result.rejected && member.output.count != 0) {
      present_.set_time(result.reached);
      answer = {Stage::Get, get(member), answer.step};
    }
  }
  if (answer.stage == Stage::Get) {
    look_closely(member, Stage::Get);
    member.unit->was_restored_ = false;
    member.unit->check_left_by_whole_call(kGet, answer.status);
  }
  ++noted_;
  calls_ = 0;
  return result.reached_without_request(interval.to);
}

core::StepResult Fmi3Unit::Row::end_step(InRow& member, const core::StepInterval& interval,
                                         const Answer& answer) {
  look_closely(member, Stage::Step);
  Fmi3Unit& unit = *member.unit;
  const Status status = unit.check_left(kStep, answer.status);
  core::StepResult result{.reached = interval.to};
  if (!unit.is_plain_end(interval, status, answer.step, time_tolerance(interval))) {
    result = unit.evaluate(interval, status, answer.step);
    if (result.rejected) return result;
    member.drifts = unit.has_time_warning_;
  }
  unit.was_restored_ = false;
  unit.time_ = result.reached;
  return result;
}

/// Notes of each unit what it has done up to this call of this one.
void Fmi3Unit::Row::look_closely(const InRow& member, Stage stage) {
  settle();
  const auto index = static_cast<std::size_t>(&member - members_.data());
  note_steps(noted_, index, 1, from_now_, to_now_);
  if (noted_ < index) calls_ = 0;
  noted_ = index;
  is_close_ = true;
  Fmi3Unit& unit = *member.unit;
  const std::uint64_t before = stage == Stage::Set || member.input.count == 0 ? 0 : 1;
  const std::uint64_t calls = before + (stage == Stage::Get ? 2 : 1);
  unit.calls_ += calls - std::exchange(calls_, calls);
  unit.time_ = present_.time();
  unit.present_step_ = {from_now_, to_now_};
}

void Fmi3Unit::Row::settle() noexcept {
  note_steps(0, members_.size(), steps(), from(), to());
  forget_steps();
}

/// So many of each of these units, the last of which was this one.
void Fmi3Unit::Row::note_steps(std::size_t first, std::size_t last, std::uint64_t steps, Time from,
                               Time to) {
  if (steps == 0) return;
  for (std::size_t i = first; i < last; ++i) {
    Fmi3Unit& unit = *members_[i].unit;
    unit.calls_ += steps * unit.calls_in_row_;
    unit.time_ = to;
    unit.present_step_ = {from, to};
    unit.was_restored_ = false;
  }
}

/// `last`: the unit at which the row ends.
void Fmi3Unit::Row::conclude(const InRow* last, Progress& progress) {
  progress.plain = static_cast<std::size_t>(last - members_.data());
  const std::size_t stepped = std::min(progress.plain + 1, members_.size());
  if (!has_usual_signals(members_[stepped - 1])) restore_signals(stepped);
  if (!is_close_) {
    add_step(from_now_, to_now_);
  } else if (progress.plain == members_.size()) {
    note_steps(noted_, members_.size(), 1, from_now_, to_now_);
  }
  present_.end();
}

/// A unit that has changed them is named. Those behind it have had them, too.
void Fmi3Unit::Row::restore_signals(std::size_t stepped) {
  const core::ProcessorMode left = core::ProcessorMode::present();
  mode_.set();
  core::ProcessorMode::Signals before = mode_.signals();
  for (const InRow& member : std::span(members_).first(stepped)) {
    if (member.signals != before && member.signals != mode_.signals()) {
      member.unit->warn_of_mode(kStep, left);
    }
    before = member.signals;
  }
}

}  // namespace stride::importer
