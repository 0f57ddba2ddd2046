#include "units/reader/model.h"

#include <algorithm>

namespace reader {

double Reader::axis(std::size_t index, stride::Time time) const {
  return position(program_.waypoints, index, time);
}

double Reader::carrier_power(stride::Time time) const {
  return reader::carrier_power(program_, time);
}

void Reader::advance(stride::Time now) {
  if (state_.receiving && state_.reception.end <= now) finish_reception();
  if (waiting() && !state_.receiving && state_.deadline <= now) give_up(Outcome::kUnanswered);
}

std::optional<nfc::Frame> Reader::transmit(stride::Time now) {
  if (!is_due(now)) return std::nullopt;
  const ProgramCommand& command = program_.commands[state_.records.size()];
  const nfc::Frame frame{now, command.bit_rate, request_bits(command.command, command.arguments)};
  Record record;
  record.sent_at = now;
  state_.records.push_back(record);
  state_.request_end = now + nfc::air_time(frame);
  state_.deadline = state_.request_end + command.timeout;
  ++state_.counts.sent;
  return frame;
}

void Reader::receive(const nfc::Frame& frame) {
  if (!waiting() || frame.start < state_.request_end) return;
  if (frame.start > state_.deadline && !state_.receiving) return;
  Reception reception;
  reception.end = frame.start + nfc::air_time(frame);
  if (state_.receiving) {
    reception.end = std::max(reception.end, state_.reception.end);
  } else {
    const auto& command = program_.commands[state_.records.size() - 1];
    const auto answer = parse_answer(command.command, frame.bits);
    reception.intact = answer.has_value();
    reception.answer = answer.value_or(Answer{});
  }
  state_.receiving = true;
  state_.reception = reception;
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
  if (state_.receiving) {
    consider(state_.reception.end);
  } else if (waiting()) {
    consider(state_.deadline);
  } else if (state_.records.size() < program_.commands.size()) {
    consider(program_.commands[state_.records.size()].at);
  }
  return next;
}

bool Reader::waiting() const {
  return !state_.records.empty() && state_.records.back().outcome == Outcome::kWaiting;
}

bool Reader::is_due(stride::Time now) const {
  const std::size_t next = state_.records.size();
  return !waiting() && next < program_.commands.size() && program_.commands[next].at <= now;
}

void Reader::finish_reception() {
  const Reception& reception = state_.reception;
  state_.receiving = false;
  if (!reception.intact) return give_up(Outcome::kDamaged);

  Record& record = state_.records.back();
  const Answer& answer = reception.answer;
  record.answered_at = reception.end;
  record.status = answer.status;
  record.outcome = answer.status == nfc::Status::kOk ? Outcome::kAnswered : Outcome::kRefused;
  ++state_.counts.answered;
  if (record.outcome == Outcome::kRefused) ++state_.counts.refused;
  if (record.outcome == Outcome::kRefused) return;
  const auto command = program_.commands[state_.records.size() - 1].command;
  if (command == nfc::Command::kIdentify) state_.identifier = answer.identifier;
  if (command == nfc::Command::kReadTemperature) state_.temperature = answer.temperature;
}

void Reader::give_up(Outcome outcome) {
  state_.records.back().outcome = outcome;
  ++state_.counts.unanswered;
}

}  // namespace reader
