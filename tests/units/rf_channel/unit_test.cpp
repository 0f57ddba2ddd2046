// The channel seen by an importer: its parameters, its packets at the instants it announces, its
// state, its tags.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/units/channel/unit_bench.h"

using namespace stride::tests;

namespace {

// 192 us of header, four octets of 32 us
double packet_end(const nfc::Frame& frame) {
  return stride::to_seconds(frame.start + nfc::air_time(frame)) + 192e-6 + 4 * 32e-6;
}

/// Both antennas 0.3 m high, 1 m apart, the reader's radio on, and a frame under way.
void send_at_one_second(UnitInstance& unit, const nfc::Frame& frame) {
  REQUIRE(unit.set_real("reader_coil.position.z", 0.3) == fmi3OK);
  REQUIRE(unit.set_real("tag_coil.position.z", 0.3) == fmi3OK);
  REQUIRE(unit.set_real("tag_coil.position.x", 1.0) == fmi3OK);
  REQUIRE(unit.set_real("carrier_power", 1e-3) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  send(unit, "from_reader", frame);
  take_in(unit);
  CHECK_FALSE(unit.clock("to_tag.clock"));
  REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);
}

void expect_at_its_end(UnitInstance& unit, double now, const nfc::Frame& frame) {
  REQUIRE(unit.step(now, packet_end(frame) + 1e-6 - now) == fmi3OK);
  CHECK(unit.last.event);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  const nfc::Frame heard = frame_at(unit, "to_tag").value();
  CHECK(heard.bits == frame.bits);
  CHECK(stride::to_seconds(heard.start + nfc::air_time(heard)) ==
        Approx(packet_end(frame)).margin(4e-9));  // 1 m of way
}

}  // namespace

TEST_CASE("A frame is handed over at the event that is announced for the end of its packet") {
  const UnitLibrary library(unit_library("rf_channel"));
  UnitInstance unit(library);
  const nfc::Frame frame = request(1.0);
  send_at_one_second(unit, frame);
  REQUIRE(unit.has_next_event);
  CHECK(unit.next_event == Approx(packet_end(frame)).margin(4e-9));
  expect_at_its_end(unit, 1.0, frame);
}

TEST_CASE("A packet on the air goes on in another instance, whether it was begun or not") {
  const UnitLibrary library(unit_library("rf_channel"));
  UnitInstance unit(library);
  const nfc::Frame frame = request(1.0);
  send_at_one_second(unit, frame);
  // on its wire, in its header, in its bits
  const double passed = GENERATE(1e-4, 4e-4, 5.2e-4);
  REQUIRE(unit.step(1.0, passed) == fmi3OK);
  fmi3FMUState state = nullptr;
  std::size_t size = 0;
  REQUIRE(library.GetFMUState(unit.handle, &state) == fmi3OK);
  REQUIRE(library.SerializedFMUStateSize(unit.handle, state, &size) == fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  REQUIRE(library.SerializeFMUState(unit.handle, state, bytes.data(), size) == fmi3OK);
  REQUIRE(library.FreeFMUState(unit.handle, &state) == fmi3OK);

  UnitInstance other(library);
  REQUIRE(other.start_steps() == fmi3OK);
  REQUIRE(library.DeserializeFMUState(other.handle, bytes.data(), size, &state) == fmi3OK);
  REQUIRE(library.SetFMUState(other.handle, state) == fmi3OK);
  REQUIRE(library.FreeFMUState(other.handle, &state) == fmi3OK);
  expect_at_its_end(other, 1.0 + passed, frame);
  expect_at_its_end(unit, 1.0 + passed, frame);
}

TEST_CASE("Two dipoles in a row hear the ground's echo only") {
  const UnitLibrary library(unit_library("rf_channel"));
  for (const char* antenna : {"upright", "in a row"}) {
    UnitInstance unit(library);
    const fmi3ValueReference r = unit.reference("antenna");
    const fmi3Int64 dipole = 2;
    REQUIRE(unit.fmi.SetInt64(unit.handle, &r, 1, &dipole, 1) == fmi3OK);
    const bool row = antenna == std::string("in a row");
    for (const std::string coil : {"reader_coil", "tag_coil"}) {
      REQUIRE(unit.set_real(coil + ".axis.x", row ? 1 : 0) == fmi3OK);
      REQUIRE(unit.set_real(coil + ".axis.z", row ? 0 : 1) == fmi3OK);
      REQUIRE(unit.set_real(coil + ".position.z", 0.3) == fmi3OK);
    }
    REQUIRE(unit.set_real("tag_coil.position.x", 3.0) == fmi3OK);
    REQUIRE(unit.set_real("carrier_power", 1e-3) == fmi3OK);
    REQUIRE(unit.start_steps() == fmi3OK);
    INFO(antenna);
    CHECK(unit.real("distance") == 3.0);
    CHECK(unit.real("tag_power") == 0.0);
    const double loss = -20.0 * std::log10(unit.real("coupling"));
    // 50 dB of way; in a row sin(11 degrees) twice, and a reflection near Brewster's angle
    CHECK(loss > (row ? 90.0 : 45.0));
    CHECK(loss < (row ? 100.0 : 60.0));
  }
}

TEST_CASE("Tags that channel.xml lists have variables of their own") {
  const TagList resources(
      R"(<rf-channel version="1"><tag name="door"/><tag name="window"/></rf-channel>)");
  const UnitLibrary library(unit_library("rf_channel"));
  UnitInstance unit(library, resources.choices());
  REQUIRE(unit.set_real("reader_coil.position.z", 1.0) == fmi3OK);
  for (const std::string tag : {"door", "window"}) {
    REQUIRE(unit.set_real(tag + ".coil.position.x", 2.0) == fmi3OK);
    REQUIRE(unit.set_real(tag + ".coil.position.z", 1.0) == fmi3OK);
  }
  REQUIRE(unit.set_real("window.transmit_power", 1e-4) == fmi3OK);
  REQUIRE(unit.set_real("door.noise_figure", 20.0) == fmi3OK);
  REQUIRE(unit.set_real("carrier_power", 1e-3) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.real("door.snr.up") == Approx(unit.real("window.snr.up") + 10.0));
  CHECK(unit.real("door.snr.down") == Approx(unit.real("window.snr.down") - 10.0));
}

TEST_CASE("A list of another technology's tags is refused") {
  const TagList resources("<nfc-channel version=\"1\"><tag name=\"door\"/></nfc-channel>");
  const UnitLibrary library(unit_library("rf_channel"));
  CHECK_THROWS_WITH(library.describe(resources.path()),
                    Catch::Contains("channel.xml:1") && Catch::Contains("expected <rf-channel>"));
}

TEST_CASE("What makes no sense is an error that names it") {
  const UnitLibrary library(unit_library("rf_channel"));
  const auto [name, value] = GENERATE(table<std::string, double>({
      {"frequency", 2.45},
      {"reader.noise_figure", -1.0},
      {"tag.transmit_power", -1e-3},
      {"ground.permittivity", 0.0},
      {"tag_coil.position.x", std::numeric_limits<double>::quiet_NaN()},
      {"reader_coil.axis.z", 0.0},
  }));
  check_is_refused(library, name, value);
}
