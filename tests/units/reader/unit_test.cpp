// The reader seen by an importer: which communication points it asks for, and what it sends there.
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/nfc/frame.h>
#include <stride/nfc/iso14443a.h>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"
#include "tests/units/resource_folder.h"
#include "units/reader/variation.h"

using namespace stride::tests;

namespace {

/// Two commands, of which the second is soon due after the first.
constexpr const char* kTwoCommands = R"(<reader-program version="1">
      <antenna on="1" off="9" power="0.5"/>
      <command at="2" name="read_temperature"/>
      <command at="2.006" name="identify"/>
    </reader-program>)";

struct Resources : ResourceFolder {
  explicit Resources(const std::string& text = kTwoCommands)
      : ResourceFolder("program.xml", text) {}
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

std::uint64_t count(UnitInstance& reader, const std::string& name) {
  const fmi3ValueReference r = reader.reference("messages." + name);
  std::uint64_t count = 0;
  REQUIRE(reader.fmi.GetUInt64(reader.handle, &r, 1, &count, 1) == fmi3OK);
  return count;
}

std::uint64_t sent(UnitInstance& reader) { return count(reader, "sent"); }

/// Steps to an instant, event included, and goes on; what it reported there, in order.
std::vector<std::string> reports_at(UnitInstance& reader, double time) {
  const double now = reader.real("time");
  REQUIRE(reader.step(now, time - now) == fmi3OK);
  std::vector<std::string> texts;
  REQUIRE(reader.fmi.EnterEventMode(reader.handle) == fmi3OK);
  do {
    REQUIRE(reader.update() == fmi3OK);
    if (!reader.clock("report.clock")) continue;
    const fmi3ValueReference r = reader.reference("report.text");
    fmi3String text = nullptr;
    REQUIRE(reader.fmi.GetString(reader.handle, &r, 1, &text, 1) == fmi3OK);
    texts.emplace_back(text);
  } while (reader.iterate);
  REQUIRE(reader.fmi.EnterStepMode(reader.handle) == fmi3OK);
  return texts;
}

constexpr const char* kTrembling = R"(<reader-program version="1">
      <axes><axis name="a" tremor="0.002" start_offset="0.1"/><axis name="b" tremor="0.001"/></axes>
      <poses><pose name="p" a="1" b="2"/></poses>
      <motion><waypoint at="0" pose="p"/></motion>
      <variation seed="7"/></reader-program>)";

void set_seed(UnitInstance& reader, std::uint64_t seed) {
  const fmi3ValueReference r = reader.reference("seed");
  REQUIRE(reader.fmi.SetUInt64(reader.handle, &r, 1, &seed, 1) == fmi3OK);
}

}  // namespace

TEST_CASE("A command is sent, although the answer before it arrives when it has ended already") {
  const Resources resources;
  const UnitLibrary library(unit_library("reader"));
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

TEST_CASE("A command that is due requests an event until it is sent") {
  const Resources resources;
  const UnitLibrary library(unit_library("reader"));
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
      <antenna on="1" off="2.0005" power="0.5"/>
      <command at="2" name="read_temperature"/>
    </reader-program>)");
  const UnitLibrary library(unit_library("reader"));
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

TEST_CASE("What became of a command is reported when it is settled") {
  const Resources resources;
  const UnitLibrary library(unit_library("reader"));
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  CHECK(reports_at(reader, 2).empty());
  REQUIRE(reader.has_next_event);
  const double given_up = reader.next_event;
  CHECK(given_up > 2.05);
  CHECK(reports_at(reader, given_up) ==
        std::vector<std::string>{"at 2 s read_temperature: expected ok; got no answer after 1 try; "
                                 "not as expected"});
  CHECK(count(reader, "unanswered") == 1);
  CHECK(count(reader, "unexpected") == 1);
  CHECK(count(reader, "as_expected") == 0);
}

TEST_CASE("Reports of one instant come one after the other") {
  const Resources resources(R"(<reader-program version="1">
      <antenna on="1" off="2.001" power="0.5"/>
      <command at="2" name="read_temperature"/><command at="2" name="identify"/>
      <command at="2.0001" name="sleep"/>
    </reader-program>)");
  const UnitLibrary library(unit_library("reader"));
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  CHECK(reports_at(reader, 2).empty());
  const auto reports = reports_at(reader, 2.1);
  REQUIRE(reports.size() == 3);
  CHECK_THAT(reports[0], Catch::Contains("read_temperature"));
  CHECK_THAT(reports[1], Catch::Contains("identify") && Catch::Contains("antenna was off"));
  CHECK_THAT(reports[2], Catch::Contains("sleep"));
  CHECK(count(reader, "unexpected") == 3);
}

TEST_CASE("Measurements are output one after the other, and are older where they are output late") {
  const Resources resources(R"(<reader-program version="1">
      <antenna on="1" off="9" power="0.5"/><command at="2" name="read_log"/>
    </reader-program>)");
  const UnitLibrary library(unit_library("reader"));
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  CHECK(reports_at(reader, 2).empty());
  const nfc::Frame answer{stride::time_from_seconds(2.001), 106,
                          nfc::to_bits(nfc::with_crc({0x00, 0, 7, 0x08, 0x66, 0, 5, 0x08, 0x67}))};
  const double end = stride::to_seconds(answer.start + nfc::air_time(answer));
  REQUIRE(reader.step(2, 0.01) == fmi3OK);
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  REQUIRE(reader.set_clock("receive.clock", true) == fmi3OK);
  REQUIRE(reader.set_binary("receive.frame", nfc::encode(answer)) == fmi3OK);
  std::vector<double> temperatures;
  std::vector<double> ages;
  do {
    REQUIRE(reader.update() == fmi3OK);
    if (!reader.clock("measurement.clock")) continue;
    temperatures.push_back(reader.real("measurement.temperature"));
    ages.push_back(reader.real("measurement.age"));
    CHECK(reader.real("measurement.age_resolution") == 1);
  } while (reader.iterate);
  CHECK(temperatures == std::vector<double>{21.5, 21.51});
  REQUIRE(ages.size() == 2);
  CHECK(ages[0] == Approx(7 + 2.01 - end).epsilon(1e-12));
  CHECK(ages[1] == Approx(5 + 2.01 - end).epsilon(1e-12));
}

TEST_CASE("A request is sent again, cut, at the instant at which the antenna goes off") {
  const Resources resources(R"(<reader-program version="1">
      <antenna on="1" off="2.0001" power="0.5"/><command at="2" name="read_temperature"/>
    </reader-program>)");
  const UnitLibrary library(unit_library("reader"));
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  CHECK(reports_at(reader, 2).empty());
  CHECK(reader.next_event == 2.0001);
  REQUIRE(reader.step(2, 2.0001 - 2) == fmi3OK);
  REQUIRE(library.EnterEventMode(reader.handle) == fmi3OK);
  REQUIRE(reader.update() == fmi3OK);
  REQUIRE(reader.clock("transmit.clock"));
  const fmi3ValueReference r = reader.reference("transmit.frame");
  std::size_t size = 0;
  fmi3Binary bytes = nullptr;
  REQUIRE(library.GetBinary(reader.handle, &r, 1, &size, &bytes, 1) == fmi3OK);
  const nfc::Frame cut = nfc::decode(nfc::Bytes(bytes, bytes + size));
  CHECK(cut.start == stride::time_from_seconds(2));
  CHECK(cut.bits.size() == 9);
}

TEST_CASE("Parameters replace what varies in the program") {
  const Resources resources(kTrembling);
  const UnitLibrary library(unit_library("reader"));
  reader::Variation expected;
  expected.seed = 7;
  expected.tremor = {0.002, 0.001};
  expected.start_offset = {0.1, 0.0};
  UnitInstance reader(library, choices(resources));

  SECTION("not, where they are left alone") {}
  SECTION("the seed") {
    set_seed(reader, 8);
    expected.seed = 8;
  }
  SECTION("the amplitude, in the program's proportion") {
    REQUIRE(reader.set_real("tremor.amplitude", 0.01) == fmi3OK);
    expected.tremor = {0.01, 0.005};
  }
  SECTION("the tremor is off") {
    REQUIRE(reader.set_real("tremor.amplitude", 0) == fmi3OK);
    expected.tremor = {0, 0};
  }
  SECTION("the start offset") {
    REQUIRE(reader.set_real("start_offset", 0.5) == fmi3OK);
    expected.start_offset = {0.5, 0};
  }
  double shift = 0;
  SECTION("where an axis is in all waypoints") {
    REQUIRE(reader.set_real("waypoint_offset.b", -0.25) == fmi3OK);
    shift = -0.25;
  }
  REQUIRE(reader.start_steps() == fmi3OK);
  REQUIRE(reader.step(0, 0.3) == fmi3OK);
  const reader::Tremor tremor(expected);
  const auto offsets = reader::start_offsets(expected);
  const auto at = stride::time_from_seconds(0.3);
  CHECK(reader.real("axis.a") == Approx(1 + offsets[0] + tremor.at(0, at)).epsilon(1e-14));
  CHECK(reader.real("axis.b") == Approx(2 + shift + tremor.at(1, at)).epsilon(1e-14));
}

TEST_CASE("A parameter out of its range is refused") {
  const Resources resources(kTrembling);
  const UnitLibrary library(unit_library("reader"));
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.set_real("tremor.amplitude", 0.6) == fmi3OK);
  CHECK(reader.initialize() == fmi3Error);
}

TEST_CASE(
    "The way does not depend on the steps, and a state goes to an instance with another seed") {
  const Resources resources(kTrembling);
  const UnitLibrary library(unit_library("reader"));
  UnitInstance one(library, choices(resources));
  UnitInstance other(library, choices(resources));
  set_seed(other, 99);
  REQUIRE(one.start_steps() == fmi3OK);
  REQUIRE(other.start_steps() == fmi3OK);
  REQUIRE(one.step(0, 0.25) == fmi3OK);
  fmi3FMUState state = nullptr;
  REQUIRE(library.GetFMUState(one.handle, &state) == fmi3OK);
  REQUIRE(one.step(0.25, 0.5) == fmi3OK);
  REQUIRE(other.step(0, 0.75) == fmi3OK);
  const double there = one.real("axis.a");
  CHECK(other.real("axis.a") != there);

  REQUIRE(library.SetFMUState(other.handle, state) == fmi3OK);
  CHECK(other.real("time") == 0.25);
  for (const double time : {0.25, 0.5, 0.625}) {
    REQUIRE(other.step(time, time < 0.6 ? (time < 0.5 ? 0.25 : 0.125) : 0.125) == fmi3OK);
  }
  CHECK(other.real("axis.a") == there);
  REQUIRE(library.FreeFMUState(one.handle, &state) == fmi3OK);
}

TEST_CASE("A state that is saved before a retry repeats it") {
  const Resources resources(R"(<reader-program version="1">
      <antenna on="1" off="9" power="0.5"/>
      <command at="2" name="read_temperature" timeout="0.05" retries="1" pause="0.1"/>
    </reader-program>)");
  const UnitLibrary library(unit_library("reader"));
  UnitInstance reader(library, choices(resources));
  REQUIRE(reader.start_steps() == fmi3OK);
  CHECK(reports_at(reader, 2).empty());
  CHECK(reports_at(reader, reader.next_event).empty());
  const double retry = reader.next_event;
  CHECK(retry > 2.15);
  fmi3FMUState state = nullptr;
  REQUIRE(library.GetFMUState(reader.handle, &state) == fmi3OK);
  for (int run = 0; run < 2; ++run) {
    INFO("run " << run);
    CHECK(reports_at(reader, retry).empty());
    CHECK(count(reader, "retries") == 1);
    CHECK(reports_at(reader, reader.next_event).size() == 1);
    REQUIRE(library.SetFMUState(reader.handle, state) == fmi3OK);
    CHECK(count(reader, "retries") == 0);
  }
  REQUIRE(library.FreeFMUState(reader.handle, &state) == fmi3OK);
}
