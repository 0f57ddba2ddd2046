// The channel seen by an importer: the variables of its tags, when it wants events, what it hands
// over.
#include <algorithm>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/units/channel/unit_bench.h"

using namespace stride::tests;

namespace {

constexpr const char* kTwoTags =
    R"(<nfc-channel version="1"><tag name="door"/><tag name="window"/></nfc-channel>)";

double end_of(const nfc::Frame& frame) {
  return stride::to_seconds(frame.start + nfc::air_time(frame));
}

/// One tag, two centimetres away, in a field.
void start_near(UnitInstance& unit) {
  REQUIRE(unit.set_real("tag_coil.position.z", 0.02) == fmi3OK);
  REQUIRE(unit.set_real("carrier_power", 0.5) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
}

/// The frame is under way, and the unit is in Step Mode at its start.
void send_near(UnitInstance& unit, const nfc::Frame& frame) {
  start_near(unit);
  REQUIRE(unit.step(0, stride::to_seconds(frame.start)) == fmi3OK);
  CHECK_FALSE(unit.last.event);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  send(unit, "from_reader", frame);
  take_in(unit);
  CHECK_FALSE(unit.clock("to_tag.clock"));
  REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);
}

}  // namespace

TEST_CASE("A frame is handed over at the event that the channel announces for its end") {
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library);
  const nfc::Frame frame = request(1.0);
  send_near(unit, frame);
  REQUIRE(unit.has_next_event);
  CHECK(unit.next_event == end_of(frame));

  REQUIRE(unit.step(1.0, 0.0001) == fmi3OK);
  CHECK_FALSE(unit.last.event);
  REQUIRE(unit.step(1.0001, end_of(frame) - 1.0001) == fmi3OK);
  CHECK(unit.last.event);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(frame_at(unit, "to_tag") == frame);
  CHECK(unit.iterate);
  CHECK_FALSE(unit.has_next_event);
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.iterate);
  CHECK_FALSE(unit.clock("to_tag.clock"));
}

TEST_CASE("An importer that steps beyond the end gets the frame at the end of its step") {
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library);
  const nfc::Frame frame = request(1.0);
  send_near(unit, frame);
  REQUIRE(unit.step(1.0, 1.0) == fmi3OK);
  CHECK(unit.last.event);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(frame_at(unit, "to_tag") == frame);
}

TEST_CASE("A carrier that goes off while a frame is on the air is an event that cuts it short") {
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library);
  const nfc::Frame frame = request(1.0);
  send_near(unit, frame);
  REQUIRE(unit.step(1.0, 0.0001) == fmi3OK);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.set_real("carrier_power", 0.0) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.next_event > 1.0001);
  CHECK(unit.next_event < end_of(frame));
  const double end = unit.next_event;
  REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);
  REQUIRE(unit.step(1.0001, end - 1.0001) == fmi3OK);
  CHECK(unit.last.event);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  const auto heard = frame_at(unit, "to_tag");
  REQUIRE(heard.has_value());
  CHECK(heard->bits.size() == 9);
  CHECK(std::equal(heard->bits.begin(), heard->bits.end(), frame.bits.begin()));
}

TEST_CASE("A tag that may not end its step early hands over what it has sent meanwhile") {
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library);
  start_near(unit);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  REQUIRE(unit.step(1, 0.001) == fmi3OK);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  const nfc::Frame first{stride::time_from_seconds(1.0001), 106, nfc::to_bits({0x02})};
  send(unit, "from_tag", first);
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.clock("to_reader.clock"));

  nfc::Frame second = request(1.0004);
  send(unit, "from_tag", second);  // and was cut off after a few bits
  REQUIRE(unit.update() == fmi3OK);
  second.bits.resize(5);
  send(unit, "from_tag", second);
  take_in(unit);
  CHECK(frame_at(unit, "to_reader") == first);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(frame_at(unit, "to_reader") == second);
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.clock("to_reader.clock"));
  CHECK_FALSE(unit.iterate);
  CHECK_FALSE(unit.has_next_event);
}

TEST_CASE("A state with a frame on the air is serialised, and another instance hands it over") {
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library);
  const nfc::Frame frame = request(1.0);
  send_near(unit, frame);
  REQUIRE(unit.step(1.0, 0.0001) == fmi3OK);
  fmi3FMUState state = nullptr;
  std::size_t size = 0;
  REQUIRE(library.GetFMUState(unit.handle, &state) == fmi3OK);
  REQUIRE(library.SerializedFMUStateSize(unit.handle, state, &size) == fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  REQUIRE(library.SerializeFMUState(unit.handle, state, bytes.data(), size) == fmi3OK);
  REQUIRE(library.FreeFMUState(unit.handle, &state) == fmi3OK);

  UnitInstance other(library);
  start_near(other);
  REQUIRE(library.DeserializeFMUState(other.handle, bytes.data(), size, &state) == fmi3OK);
  REQUIRE(library.SetFMUState(other.handle, state) == fmi3OK);
  REQUIRE(library.FreeFMUState(other.handle, &state) == fmi3OK);
  REQUIRE(other.step(1.0001, 0.01) == fmi3OK);
  CHECK(other.last.event);
  REQUIRE(library.EnterEventMode(other.handle) == fmi3OK);
  REQUIRE(other.update() == fmi3OK);
  CHECK(frame_at(other, "to_tag") == frame);
}

TEST_CASE("With a frame on the air nothing is promised, without one everything stays") {
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library);
  constexpr double kEver = std::numeric_limits<double>::infinity();
  REQUIRE(unit.fmi.EnableIdleSkipping(unit.handle, kEver) == fmi3OK);
  const nfc::Frame frame = request(1.0);
  send_near(unit, frame);
  CHECK(unit.idle_until() == 1.0);

  REQUIRE(unit.step(1.0, end_of(frame) - 1.0) == fmi3OK);
  CHECK(unit.idle_until() == end_of(frame));
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(frame_at(unit, "to_tag"));
  REQUIRE(unit.update() == fmi3OK);
  REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);
  CHECK(unit.idle_until() == kEver);

  // an input that was set shows after the step
  REQUIRE(unit.set_real("tag_coil.position.z", 0.03) == fmi3OK);
  CHECK(unit.idle_until() == end_of(frame));
  REQUIRE(unit.step(end_of(frame), 0.001) == fmi3OK);
  CHECK(unit.idle_until() == kEver);
}

TEST_CASE("Tags that channel.xml lists have variables of their own") {
  const TagList resources(kTwoTags);
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library, resources.choices());
  REQUIRE(unit.set_real("door.coil.position.z", 0.02) == fmi3OK);
  REQUIRE(unit.set_real("window.coil.position.z", 0.03) == fmi3OK);
  REQUIRE(unit.set_real("window.coil.quality_factor", 20) == fmi3OK);
  REQUIRE(unit.set_real("carrier_power", 0.5) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.real("door.distance") == Approx(0.02));
  CHECK(unit.real("window.distance") == Approx(0.03));
  CHECK(unit.real("door.power") > unit.real("window.power"));
  CHECK(unit.real("door.voltage") > unit.real("window.voltage"));
  CHECK(unit.real("window.bit_error_rate.down") < 1e-9);

  REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
  const nfc::Frame frame = request(0.0);
  send(unit, "from_reader", frame);
  take_in(unit);
  REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  REQUIRE(unit.step(0, end_of(frame)) == fmi3OK);
  REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(frame_at(unit, "door.to") == frame);
  CHECK(frame_at(unit, "window.to") == frame);

  const nfc::Frame answer = request(end_of(frame));
  send(unit, "window.from", answer);
  take_in(unit);
  REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  REQUIRE(unit.step(end_of(frame), end_of(answer) - end_of(frame)) == fmi3OK);
  REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(frame_at(unit, "to_reader") == answer);
}

TEST_CASE("Resources without a channel.xml leave the one tag") {
  const TagList resources("");
  const UnitLibrary library(unit_library("nfc_channel"));
  UnitInstance unit(library, resources.choices());
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.real("distance") == 0.0);
}

TEST_CASE("A bad channel.xml is an error with its line") {
  const TagList resources("<nfc-channel version=\"1\">\n<tag/></nfc-channel>");
  const UnitLibrary library(unit_library("nfc_channel"));
  CHECK_THROWS_WITH(library.describe(resources.path()),
                    Catch::Contains("channel.xml:2") && Catch::Contains("'name'"));
}

TEST_CASE("What makes no sense is an error that names it") {
  const UnitLibrary library(unit_library("nfc_channel"));
  const auto [name, value] = GENERATE(table<std::string, double>({
      {"tag_coil.radius", 0.0},
      {"tag_coil.wire_radius", 0.005},
      {"tag.capacitance", -1e-12},
      {"tag_coil.position.x", std::numeric_limits<double>::quiet_NaN()},
      {"reader_coil.axis.z", 0.0},
  }));
  check_is_refused(library, name, value);
}

TEST_CASE("Bytes that are not a frame are an error") {
  const UnitLibrary library(unit_library("nfc_channel"));
  InstanceChoices logging;
  logging.logging = true;
  UnitInstance unit(library, logging);
  start_near(unit);
  REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.set_clock("from_tag.clock", true) == fmi3OK);
  REQUIRE(unit.set_binary("from_tag.frame", {1, 2, 3}) == fmi3OK);
  CHECK(unit.update() == fmi3Error);
  CHECK_THAT(unit.last_message(), Catch::Contains("a frame has at least 16 bytes"));
}
