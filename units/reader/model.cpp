#include "units/reader/model.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <stride/nfc/names.h>

#include "units/xml/text.h"

namespace reader {
namespace {

constexpr stride::Duration kSecond = std::chrono::seconds(1);

/// Added to the latest end of an answer, so that one that ends just then is heard before the reader
/// gives up at that instant.
stride::Duration grace() { return nfc::bit_duration(106); }

std::string got_text(const Record& record, nfc::Command command) {
  switch (record.outcome) {
    case Outcome::Answered:
    case Outcome::Refused:
      return text_of(command, record.answer);
    case Outcome::Unanswered:
      return "no answer";
    case Outcome::Damaged:
      return "a damaged answer";
    case Outcome::Cut:
      return "no answer because the antenna went off";
    case Outcome::NotSent:
      return "no chance because the antenna was off";
    case Outcome::Waiting:
      break;
  }
  return "nothing yet";
}

}  // namespace

Reader::Reader(Program program) : program_(std::move(program)), tremor_(program_.variation) {
  if (program_.waypoints.empty()) return;
  const auto offsets = start_offsets(program_.variation);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    program_.waypoints.front().positions[i] += offsets[i];
  }
}

double Reader::axis(std::size_t index, stride::Time time) const {
  return position(program_.waypoints, index, time) + tremor_.at(index, time);
}

double Reader::carrier_power(stride::Time time) const {
  return reader::carrier_power(program_, time);
}

void Reader::advance(stride::Time now) {
  auto& s = state_;
  if (cut_is_due(now)) return;  // transmit() settles it
  if (s.phase == Phase::Receiving && s.reception.end <= now) finish_reception();
  if (s.phase == Phase::Waiting && s.give_up_at <= now) {
    fail_try(s.give_up_at, Outcome::Unanswered);
  }
  skip_without_antenna(now);
}

// what has to be sent now and cannot be, because the antenna is off
void Reader::skip_without_antenna(stride::Time now) {
  if (carrier_end(program_, now)) return;
  if (state_.phase == Phase::Pausing && state_.retry_at <= now) settle(now, state_.last_try);
  while (command_is_due(now)) {
    Record record;
    record.sent_at = now;
    state_.records.push_back(record);
    settle(now, Outcome::NotSent);
  }
}

bool Reader::command_is_due(stride::Time now) const {
  const std::size_t next = state_.records.size();
  return state_.phase == Phase::Idle && next < program_.commands.size() &&
         program_.commands[next].at <= now;
}

bool Reader::cut_is_due(stride::Time now) const {
  if (state_.phase != Phase::Waiting) return false;
  const auto end = carrier_end(program_, state_.request_start);
  return end && *end < state_.request_end && *end <= now;
}

bool Reader::is_due(stride::Time now) const {
  if (cut_is_due(now)) return true;
  const bool again = state_.phase == Phase::Pausing && state_.retry_at <= now;
  return (again || command_is_due(now)) && carrier_end(program_, now).has_value();
}

std::optional<nfc::Frame> Reader::transmit(stride::Time now) {
  if (cut_is_due(now)) return cut();
  if (!is_due(now)) return std::nullopt;
  if (state_.phase == Phase::Pausing) {
    ++state_.counts.retries;
  } else {
    Record record;
    record.sent_at = now;
    state_.records.push_back(record);
    ++state_.counts.sent;
  }
  begin_try(now);
  return request(now);
}

nfc::Frame Reader::request(stride::Time start) const {
  return {start, current().bit_rate, request_bits(current().command, current().arguments)};
}

void Reader::begin_try(stride::Time now) {
  ++state_.records.back().tries;
  state_.phase = Phase::Waiting;
  state_.request_start = now;
  state_.request_end = now + nfc::air_time(request(now));
  state_.deadline = state_.request_end + current().timeout;
  state_.give_up_at = state_.deadline + longest_answer(current().command) + grace();
}

nfc::Frame Reader::cut() {
  const stride::Time end = *carrier_end(program_, state_.request_start);
  nfc::Frame frame = nfc::cut_off(request(state_.request_start), end);
  settle(end, Outcome::Cut);
  return frame;
}

void Reader::receive(const nfc::Frame& frame) {
  auto& s = state_;
  const bool receiving = s.phase == Phase::Receiving;
  if (!receiving && s.phase != Phase::Waiting) return;
  if (frame.start < s.request_end || (frame.start > s.deadline && !receiving)) return;
  Reception reception;
  reception.end = frame.start + nfc::air_time(frame);
  if (receiving) {
    reception.end = std::max(reception.end, s.reception.end);
  } else {
    const auto answer = parse_answer(current().command, frame.bits);
    reception.intact = answer.has_value();
    reception.answer = answer.value_or(Answer{});
  }
  s.phase = Phase::Receiving;
  s.reception = reception;
}

void Reader::finish_reception() {
  const Reception reception = state_.reception;
  if (!reception.intact) return fail_try(reception.end, Outcome::Damaged);
  const Answer& answer = reception.answer;
  const bool is_ok = answer.status == nfc::Status::Ok;
  state_.records.back().answer = answer;
  if (is_ok) keep_what_is_new(answer);
  settle(reception.end, is_ok ? Outcome::Answered : Outcome::Refused);
}

void Reader::keep_what_is_new(const Answer& answer) {
  if (current().command == nfc::Command::Identify) state_.identifier = answer.identifier;
  if (current().command == nfc::Command::ReadTemperature) state_.temperature = answer.temperature;
  if (current().command == nfc::Command::ReadLog) state_.logged = answer.sample_count;
  keep_temperatures(answer);
}

void Reader::keep_temperatures(const Answer& answer) {
  const stride::Time received = state_.reception.end;
  if (current().command == nfc::Command::ReadTemperature) {
    state_.measurements.push_back({received, answer.temperature, {}, {}});
  }
  for (std::uint32_t i = 0; i < answer.sample_count; ++i) {
    const Sample& sample = answer.samples[i];
    const bool is_known = sample.age < nfc::kOldestLogAge;
    state_.measurements.push_back(
        {received, sample.temperature, sample.age * kSecond,
         is_known ? kSecond : stride::duration_from_seconds(stride::kMaxSeconds)});
  }
}

Measurement Reader::take_measurement() {
  const Measurement measurement = state_.measurements.front();
  state_.measurements.pop_front();
  return measurement;
}

void Reader::fail_try(stride::Time at, Outcome outcome) {
  if (state_.records.back().tries > current().retries) return settle(at, outcome);
  state_.phase = Phase::Pausing;
  state_.retry_at = at + current().pause;
  state_.last_try = outcome;
}

void Reader::settle(stride::Time at, Outcome outcome) {
  Record& record = state_.records.back();
  const bool answered = outcome == Outcome::Answered || outcome == Outcome::Refused;
  const auto answer = answered ? std::optional<Answer>(record.answer) : std::nullopt;
  record.settled_at = at;
  record.outcome = outcome;
  record.as_expected =
      outcome != Outcome::NotSent && is_met(current().expectation, current().command, answer);
  state_.phase = Phase::Idle;

  Counts& counts = state_.counts;
  if (answered) ++counts.answered;
  if (outcome == Outcome::Refused) ++counts.refused;
  if (!answered && outcome != Outcome::NotSent) ++counts.unanswered;
  if (outcome == Outcome::Damaged) ++counts.damaged;
  ++(record.as_expected ? counts.as_expected : counts.unexpected);
}

std::optional<stride::Time> Reader::next_event_time(stride::Time now) const {
  std::optional<stride::Time> next;
  const auto consider = [&](stride::Time time) {
    if (time > now && (!next || time < *next)) next = time;
  };
  for (const auto& interval : program_.antenna) {
    consider(interval.on);
    consider(interval.off);
  }
  switch (state_.phase) {
    case Phase::Idle:
      if (state_.records.size() < program_.commands.size()) {
        consider(program_.commands[state_.records.size()].at);
      }
      break;
    case Phase::Waiting:
      consider(state_.give_up_at);
      break;
    case Phase::Receiving:
      consider(state_.reception.end);
      break;
    case Phase::Pausing:
      consider(state_.retry_at);
      break;
  }
  return next;
}

std::string Reader::report(std::size_t index) const {
  const Record& record = state_.records[index];
  const ProgramCommand& command = program_.commands[index];
  std::string text = "at " + xml::shortest(stride::to_seconds(record.sent_at)) + " s " +
                     name_of(command.command) + ": expected " + text_of(command.expectation) +
                     "; got " + got_text(record, command.command);
  if (record.tries > 0) {
    text += " after " + std::to_string(record.tries) + (record.tries == 1 ? " try" : " tries");
  }
  return record.as_expected ? text : text + "; not as expected";
}

}  // namespace reader
