// Kept states, states as bytes, and the way back to the beginning.
#include "master/loader/fmu/fmi3/fmi3_unit.h"

namespace stride::importer {
namespace {

constexpr const char* kFmi3Saving = "canGetAndSetFMUState";
constexpr const char* kFmi3Serializing = "canSerializeFMUState";

}  // namespace

void Fmi3Unit::save_state() {
  SavedState& saved = states_.chosen();
  saved.is_present = save_by("fmi3GetFMUState", fmi_.GetFMUState, saved.state);
  saved.time = time_;
}

void Fmi3Unit::restore_state() {
  const SavedState& saved = states_.chosen();
  if (!saved.is_present) fail_without_state();
  require("fmi3SetFMUState", fmi_.SetFMUState, kFmi3Saving);
  check_state("fmi3GetFMUState", saved.state);
  call("fmi3SetFMUState", fmi_.SetFMUState, saved.state);
  was_restored_ = true;
  time_ = saved.time;
}

void Fmi3Unit::free_state(SavedState& saved) {
  if (free_by("fmi3FreeFMUState", fmi_.FreeFMUState, saved.state)) saved = {};
}

void Fmi3Unit::select_state(std::size_t slot) { states_.choose(slot); }

std::vector<std::uint8_t> Fmi3Unit::serialize_state() {
  const Serialization<fmi3Status, fmi3Byte> functions{.size_name = "fmi3SerializedFMUStateSize",
                                                      .size_of = fmi_.SerializedFMUStateSize,
                                                      .write_name = "fmi3SerializeFMUState",
                                                      .write = fmi_.SerializeFMUState,
                                                      .capability = kFmi3Serializing};
  if (!states_.chosen().is_present) fail_without_state();
  return serialized(states_.chosen().state, functions);
}

/// The bytes do not contain the time.
void Fmi3Unit::deserialize_state(std::span<const std::uint8_t> bytes) {
  require("fmi3DeserializeFMUState", fmi_.DeserializeFMUState, kFmi3Serializing);
  SavedState& saved = states_.chosen();
  free_state(saved);
  void* state = nullptr;  // what a failed call leaves there is undefined
  call_for_state("fmi3DeserializeFMUState", fmi_.DeserializeFMUState, bytes.data(), bytes.size(),
                 &state);
  check_state("fmi3DeserializeFMUState", state);
  saved.state = state;
  saved.is_present = true;
}

void Fmi3Unit::reset() {
  reset_by("fmi3Reset", fmi_.Reset);
  has_time_warning_ = false;
  may_skip_ = false;
}

}  // namespace stride::importer
