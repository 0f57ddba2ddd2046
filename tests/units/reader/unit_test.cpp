// The reader seen by an importer: which communication points it asks for, and what it sends there.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "tests/interfaces/unit/importer.h"
#include "units/nfc/frame.h"
#include "units/nfc/iso14443a.h"

using namespace stride::tests;

namespace {

/// Two commands, of which the second is soon due after the first.
constexpr const char* kTwoCommands = R"(<reader-program version="1">
      <antenna on="1" off="9" power="0.5"/>
      <command at="2" name="read_temperature"/>
      <command at="2.006" name="identify"/>
    </reader-program>)";

class Resources {
 public:
  explicit Resources(const std::string& program = kTwoCommands) {
    std::string name = (std::filesystem::temp_directory_path() / "stride-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
    std::ofstream(path_ / "program.xml") << program;
  }
  ~Resources() { std::filesystem::remove_all(path_); }
  Resources(const Resources&) = delete;
  Resources& operator=(const Resources&) = delete;

  std::string path() const { return path_.string() + "/"; }

 private:
  std::filesystem::path path_;
};

InstanceChoices choices(const Resources& resources) {
  InstanceChoices choices;
  choices.resources = resources.path();
  return choices;
}

void handle_event(UnitInstance& reader) {
  do {
    REQUIRE(reader.update() == fmi3OK);
  } while (reader.iterate);
  REQUIRE(reader.fmi.EnterStepMode(reader.handle) == fmi3OK);
}

/// An answer to the command of second 2, which arrives when its frame has ended.
void receive_late_answer(UnitInstance& reader) {
  const double now = reader.real("time");
  REQUIRE(reader.step(now, 2.005 - now) == fmi3OK);
  REQUIRE(reader.fmi.EnterEventMode(reader.handle) == fmi3OK);
  const nfc::Frame answer{stride::time_from_seconds(2.001), 106,
                          nfc::to_bits(nfc::with_crc({0x00, 0x08, 0x66}))};
  REQUIRE(answer.start + nfc::air_time(answer) < stride::time_from_seconds(2.005));
  REQUIRE(reader.set_clock("receive.clock", true) == fmi3OK);
  REQUIRE(reader.set_binary("receive.frame", nfc::encode(answer)) == fmi3OK);
  handle_event(reader);
}

std::uint64_t sent(UnitInstance& reader) {
  const fmi3ValueReference r = reader.reference("messages.sent");
  std::uint64_t count = 0;
  REQUIRE(reader.fmi.GetUInt64(reader.handle, &r, 1, &count, 1) == fmi3OK);
  return count;
}

}  // namespace

TEST_CASE("A command is sent, although the answer before it arrives when it has ended already") {
  const Resources resources;
  const UnitLibrary library(STRIDE_READER_LIBRARY);
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  REQUIRE(reader.step(0, 2) == fmi3OK);
  REQUIRE(reader.last.event);
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  handle_event(reader);
  REQUIRE(sent(reader) == 1);

  receive_late_answer(reader);
  CHECK(reader.real("measured.temperature") == Approx(21.5));
  CHECK(reader.has_next_event);
  CHECK(reader.next_event == 2.006);

  REQUIRE(reader.step(2.005, 0.005) == fmi3OK);
  REQUIRE(reader.last.event);
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  handle_event(reader);
  CHECK(sent(reader) == 2);
}

TEST_CASE("A command that is due asks for an event until it is sent") {
  const Resources resources;
  const UnitLibrary library(STRIDE_READER_LIBRARY);
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  REQUIRE(reader.step(0, 2) == fmi3OK);
  CHECK(reader.last.event);
  REQUIRE(reader.step(2, 0.001) == fmi3OK);
  CHECK(reader.last.event);
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  handle_event(reader);
  CHECK(sent(reader) == 1);
}

TEST_CASE("When everything is over the time limit of the last answer is announced no more") {
  const Resources resources(R"(<reader-program version="1">
      <antenna on="1" off="2.0001" power="0.5"/>
      <command at="2" name="read_temperature"/>
    </reader-program>)");
  const UnitLibrary library(STRIDE_READER_LIBRARY);
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  REQUIRE(reader.step(0, 2) == fmi3OK);
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  handle_event(reader);
  REQUIRE(reader.step(2, 0.0005) == fmi3OK);  // the antenna goes off
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  handle_event(reader);
  CHECK(reader.has_next_event);
  CHECK(reader.next_event > 2.005);
  receive_late_answer(reader);
  CHECK_FALSE(reader.has_next_event);
}
