#include "units/reader/expectation.h"

#include <catch2/catch.hpp>

using nfc::Command;
using nfc::Status;
using reader::Answer;
using reader::Expectation;
using reader::is_met;
using reader::text_of;

namespace {

Answer warm(double temperature) {
  Answer answer;
  answer.temperature = temperature;
  return answer;
}

Answer log_of(std::initializer_list<double> temperatures) {
  Answer answer;
  for (const double temperature : temperatures) {
    answer.samples[answer.sample_count++] = {0, temperature};
  }
  return answer;
}

Answer refused(Status status) {
  Answer answer;
  answer.status = status;
  return answer;
}

}  // namespace

TEST_CASE("Without further words an intact answer with status ok is expected") {
  const Expectation any;
  CHECK(is_met(any, Command::SetLed, Answer{}));
  CHECK_FALSE(is_met(any, Command::SetLed, refused(Status::BadArgument)));
  CHECK_FALSE(is_met(any, Command::SetLed, std::nullopt));
  CHECK(text_of(any) == "ok");
}

TEST_CASE("A refusal may be expected, and so may silence") {
  Expectation refusal;
  refusal.status = Status::UnknownCommand;
  CHECK(is_met(refusal, Command::SetLed, refused(Status::UnknownCommand)));
  CHECK_FALSE(is_met(refusal, Command::SetLed, refused(Status::BadArgument)));
  CHECK_FALSE(is_met(refusal, Command::SetLed, Answer{}));
  CHECK(text_of(refusal) == "unknown_command");

  Expectation silence;
  silence.answer = false;
  CHECK(is_met(silence, Command::SetLed, std::nullopt));
  CHECK_FALSE(is_met(silence, Command::SetLed, Answer{}));
  CHECK(text_of(silence) == "no answer");
}

TEST_CASE("A temperature has to be in its range, the ends included") {
  Expectation range;
  range.lowest = 20.0;
  range.highest = 22.5;
  for (const double good : {20.0, 21.0, 22.5}) {
    CHECK(is_met(range, Command::ReadTemperature, warm(good)));
  }
  for (const double bad : {19.99, 22.51}) {
    CHECK_FALSE(is_met(range, Command::ReadTemperature, warm(bad)));
  }
  CHECK(text_of(range) == "ok 20 to 22.5 degC");
  range.lowest.reset();
  CHECK(is_met(range, Command::ReadTemperature, warm(-40)));
  CHECK(text_of(range) == "ok 22.5 degC or less");
  range = {};
  range.lowest = -3;
  CHECK(text_of(range) == "ok -3 degC or more");
}

TEST_CASE("An identifier has to be the one") {
  Expectation expectation;
  expectation.identifier = 0x0A2B3C4D;
  Answer answer;
  answer.identifier = 0x0A2B3C4D;
  CHECK(is_met(expectation, Command::Identify, answer));
  ++answer.identifier;
  CHECK_FALSE(is_met(expectation, Command::Identify, answer));
  CHECK(text_of(expectation) == "ok identifier 0x0A2B3C4D");
  CHECK(text_of(Command::Identify, answer) == "ok identifier 0x0A2B3C4E");
}

TEST_CASE("A log needs its samples, and each in its range") {
  Expectation expectation;
  expectation.samples = 2;
  expectation.highest = 25.0;
  CHECK(is_met(expectation, Command::ReadLog, log_of({21, 25})));
  CHECK(is_met(expectation, Command::ReadLog, log_of({21, 22, 23})));
  CHECK_FALSE(is_met(expectation, Command::ReadLog, log_of({21})));
  CHECK_FALSE(is_met(expectation, Command::ReadLog, log_of({21, 25.5, 22})));
  CHECK(text_of(expectation) == "ok 2 samples or more of 25 degC or less");
}

TEST_CASE("Answers are described by what their command means") {
  CHECK(text_of(Command::ReadTemperature, warm(21.49)) == "ok 21.49 degC");
  CHECK(text_of(Command::ReadLog, log_of({22, 21.5, 23})) == "ok 3 samples of 21.5 to 23 degC");
  CHECK(text_of(Command::ReadLog, log_of({22})) == "ok 1 sample of 22 to 22 degC");
  CHECK(text_of(Command::ReadLog, log_of({})) == "ok 0 samples");
  CHECK(text_of(Command::Sleep, Answer{}) == "ok");
  CHECK(text_of(Command::ReadLog, refused(Status::BadArgument)) == "bad_argument");
}
