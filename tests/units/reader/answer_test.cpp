#include "units/reader/answer.h"

#include <catch2/catch.hpp>

#include <stride/nfc/iso14443a.h>

using nfc::Command;
using nfc::Status;
using reader::parse_answer;

namespace {

nfc::Bits answer(const nfc::Bytes& content) { return nfc::to_bits(nfc::with_crc(content)); }

}  // namespace

TEST_CASE("A request is command, arguments and CRC, with parity") {
  const auto identify = nfc::to_bytes(reader::request_bits(Command::Identify, {}));
  REQUIRE(identify.has_value());
  CHECK(nfc::without_crc(*identify) == nfc::Bytes{0x01});
  const auto led = nfc::to_bytes(reader::request_bits(Command::SetLed, {1}));
  REQUIRE(led.has_value());
  CHECK(nfc::without_crc(*led) == nfc::Bytes{0x03, 0x01});
}

TEST_CASE("Answers carry their data, most significant byte first") {
  CHECK(parse_answer(Command::Identify, answer({0, 0xDE, 0xAD, 0xBE, 0xEF}))->identifier ==
        0xDEADBEEF);
  CHECK(parse_answer(Command::ReadTemperature, answer({0, 0x08, 0x66}))->temperature ==
        Approx(21.5));
  CHECK(parse_answer(Command::SetLed, answer({0})).has_value());
}

TEST_CASE("A log has up to eight samples, the oldest first") {
  const auto log =
      parse_answer(Command::ReadLog, answer({0, 0x01, 0x02, 0x08, 0x66, 0x00, 0x05, 0xFF, 0x9C}));
  REQUIRE(log.has_value());
  REQUIRE(log->sample_count == 2);
  CHECK(log->samples[0].age == 258);
  CHECK(log->samples[0].temperature == 21.5);
  CHECK(log->samples[1].age == 5);
  CHECK(log->samples[1].temperature == -1.0);
  CHECK(parse_answer(Command::ReadLog, answer({0}))->sample_count == 0);
  nfc::Bytes full(33);
  CHECK(parse_answer(Command::ReadLog, answer(full))->sample_count == 8);
  full.resize(37);
  CHECK_FALSE(parse_answer(Command::ReadLog, answer(full)).has_value());
  CHECK_FALSE(parse_answer(Command::ReadLog, answer({0, 1, 2, 3})).has_value());
}

TEST_CASE("What an unknown command is answered is taken as it comes") {
  const auto unknown = static_cast<Command>(0x7F);
  CHECK(parse_answer(unknown, answer({1}))->status == Status::UnknownCommand);
  CHECK(parse_answer(unknown, answer({0, 1, 2, 3, 4, 5})).has_value());
  CHECK_FALSE(parse_answer(unknown, answer({1, 2})).has_value());
}

TEST_CASE("No answer that is accepted lasts longer than the longest") {
  for (int byte = 0; byte < 10; ++byte) {
    const auto command = static_cast<Command>(byte);
    const auto longest = reader::longest_answer(command);
    for (std::size_t size = 1; size < 50; ++size) {
      const nfc::Frame frame{{}, 106, answer(nfc::Bytes(size))};
      if (parse_answer(command, frame.bits)) CHECK(nfc::air_time(frame) <= longest);
    }
  }
}

TEST_CASE("Temperatures may be negative") {
  const auto cold = parse_answer(Command::ReadTemperature, answer({0, 0xFF, 0x9C}));
  CHECK(cold->temperature == Approx(-1.0));
}

TEST_CASE("A refusal is an answer with a status and no data") {
  const auto refused = parse_answer(Command::ReadTemperature, answer({2}));
  REQUIRE(refused.has_value());
  CHECK(refused->status == Status::BadArgument);
  CHECK(parse_answer(Command::Identify, answer({1}))->status == Status::UnknownCommand);
}

TEST_CASE("An answer with any wrong bit is none") {
  nfc::Bits bits = answer({0, 0x08, 0x66});
  for (auto& bit : bits) {
    bit ^= 1;
    CHECK_FALSE(parse_answer(Command::ReadTemperature, bits).has_value());
    bit ^= 1;
  }
  CHECK(parse_answer(Command::ReadTemperature, bits).has_value());
}

TEST_CASE("An answer with right parity and wrong CRC is none") {
  nfc::Bytes bytes = nfc::with_crc({0, 0x08, 0x66});
  bytes[1] = 0x09;
  CHECK_FALSE(parse_answer(Command::ReadTemperature, nfc::to_bits(bytes)).has_value());
}

TEST_CASE("An answer that does not fit the command is none") {
  CHECK_FALSE(parse_answer(Command::ReadTemperature, answer({0})).has_value());
  CHECK_FALSE(parse_answer(Command::ReadTemperature, answer({0, 1, 2, 3})).has_value());
  CHECK_FALSE(parse_answer(Command::Identify, answer({0, 1, 2})).has_value());
  CHECK_FALSE(parse_answer(Command::SetLed, answer({0, 1})).has_value());
  CHECK_FALSE(parse_answer(Command::SetLed, answer({2, 1})).has_value());
  CHECK_FALSE(parse_answer(Command::SetLed, answer({99})).has_value());
  CHECK_FALSE(parse_answer(Command::SetLed, answer({})).has_value());
  CHECK_FALSE(parse_answer(Command::SetLed, {}).has_value());
}
