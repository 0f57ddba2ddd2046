// States of the small importer's instances.
#ifndef STRIDE_TESTS_INTERFACES_UNIT_SAVED_STATE_H
#define STRIDE_TESTS_INTERFACES_UNIT_SAVED_STATE_H

#include <vector>

#include <catch2/catch.hpp>

#include "tests/interfaces/unit/importer.h"

namespace stride::tests {

inline std::vector<fmi3Byte> serialize(UnitInstance& unit, fmi3FMUState state) {
  std::size_t size = 0;
  REQUIRE(unit.fmi.SerializedFMUStateSize(unit.handle, state, &size) == fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  REQUIRE(unit.fmi.SerializeFMUState(unit.handle, state, bytes.data(), size) == fmi3OK);
  return bytes;
}

struct SavedState {
  explicit SavedState(UnitInstance& of) : unit(of) {
    REQUIRE(unit.fmi.GetFMUState(unit.handle, &state) == fmi3OK);
  }
  ~SavedState() { unit.fmi.FreeFMUState(unit.handle, &state); }
  SavedState(const SavedState&) = delete;
  SavedState& operator=(const SavedState&) = delete;
  UnitInstance& unit;
  fmi3FMUState state = nullptr;
};

inline std::vector<fmi3Byte> serialized(UnitInstance& unit) {
  const SavedState saved(unit);
  return serialize(unit, saved.state);
}

/// Restores what was serialised; the state is what the library has made of the bytes.
inline fmi3Status restore(UnitInstance& unit, const std::vector<fmi3Byte>& bytes) {
  fmi3FMUState state = nullptr;
  fmi3Status status = unit.fmi.DeserializeFMUState(unit.handle, bytes.data(), bytes.size(), &state);
  if (status == fmi3OK) status = unit.fmi.SetFMUState(unit.handle, state);
  unit.fmi.FreeFMUState(unit.handle, &state);
  return status;
}

}  // namespace stride::tests

#endif
