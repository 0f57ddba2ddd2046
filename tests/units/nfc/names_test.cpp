#include <set>

#include <catch2/catch.hpp>

#include <stride/nfc/names.h>

using nfc::Command;
using nfc::Status;

TEST_CASE("each command and each status has a name of its own") {
  std::set<std::string> names;
  for (int byte = 0; byte < 256; ++byte) {
    names.insert(nfc::name_of(static_cast<Command>(byte)));
    names.insert(nfc::name_of(static_cast<Status>(byte)));
  }
  CHECK(names.size() == 512);
  CHECK(nfc::name_of(Command::ReadTemperature) == "read_temperature");
  CHECK(nfc::name_of(Command::SetSamplingPeriod) == "set_sampling_period");
  CHECK(nfc::name_of(static_cast<Command>(0x7F)) == "raw 0x7F");
  CHECK(nfc::name_of(Status::BadArgument) == "bad_argument");
  CHECK(nfc::name_of(static_cast<Status>(0xE0)) == "status 0xE0");
}

TEST_CASE("the bytes 0x01 to 0x07 are commands, and each is listed once") {
  std::set<Command> listed;
  for (const nfc::CommandFormat& format : nfc::kCommands) {
    CHECK(listed.insert(format.command).second);
    CHECK(nfc::name_of(format.command) == format.name);
  }
  for (int byte = 0; byte < 256; ++byte) {
    CHECK(listed.count(static_cast<Command>(byte)) == (byte >= 1 && byte <= 7 ? 1 : 0));
  }
}

TEST_CASE("an identifier has eight digits") {
  CHECK(nfc::hexadecimal(0x0A2B3C4D) == "0x0A2B3C4D");
  CHECK(nfc::hexadecimal(0) == "0x00000000");
  CHECK(nfc::hexadecimal(0xFFFFFFFF) == "0xFFFFFFFF");
}
