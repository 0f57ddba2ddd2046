#ifndef STRIDE_TESTS_UNITS_CHANNEL_UNIT_BENCH_H
#define STRIDE_TESTS_UNITS_CHANNEL_UNIT_BENCH_H

#include <optional>
#include <string>

#include <catch2/catch.hpp>

#include <stride/nfc/frame.h>
#include <stride/nfc/iso14443a.h>

#include "tests/interfaces/unit/importer.h"
#include "tests/units/resource_folder.h"

namespace stride::tests {

/// A channel's resources with the text of its tag list, or without one if it is empty.
struct TagList : ResourceFolder {
  explicit TagList(const std::string& text) : ResourceFolder("channel.xml", text) {}

  InstanceChoices choices() const {
    InstanceChoices choices;
    choices.resources = path();
    return choices;
  }
};

/// A request that begins at `start` [s].
inline nfc::Frame request(double start) {
  return {stride::time_from_seconds(start), 106, nfc::to_bits(nfc::with_crc({0x02}))};
}

/// The frame whose clock ticks.
inline std::optional<nfc::Frame> frame_at(UnitInstance& unit, const std::string& port) {
  if (!unit.clock(port + ".clock")) return std::nullopt;
  const fmi3ValueReference r = unit.reference(port + ".frame");
  std::size_t size = 0;
  fmi3Binary bytes = nullptr;
  REQUIRE(unit.fmi.GetBinary(unit.handle, &r, 1, &size, &bytes, 1) == fmi3OK);
  return nfc::decode({bytes, bytes + size});
}

inline void send(UnitInstance& unit, const std::string& port, const nfc::Frame& frame) {
  REQUIRE(unit.set_clock(port + ".clock", true) == fmi3OK);
  REQUIRE(unit.set_binary(port + ".frame", nfc::encode(frame)) == fmi3OK);
}

/// Takes in the frames that were sent; there are no more afterwards.
inline void take_in(UnitInstance& unit) {
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.iterate);
  REQUIRE(unit.update() == fmi3OK);
}

/// An instance of the library with this value does not start, and the message has the name's first
/// part.
inline void check_is_refused(const UnitLibrary& library, const std::string& name, double value) {
  InstanceChoices logging;
  logging.logging = true;
  UnitInstance unit(library, logging);
  REQUIRE(unit.set_real(name, value) == fmi3OK);
  CHECK(unit.initialize() == fmi3Error);
  CHECK_THAT(unit.last_message(), Catch::Contains(name.substr(0, name.find('.'))));
}

}  // namespace stride::tests

#endif
