// Kept states, states as bytes, and the way back to the beginning.
#include "master/loader/fmu/fmi2/fmi2_unit.h"

namespace stride::importer {
namespace {

constexpr const char* kFmi2Saving = "canGetAndSetFMUstate";
constexpr const char* kFmi2Serializing = "canSerializeFMUstate";

}  // namespace

void Fmi2Unit::save_state() { is_as_saved_ = save(states_.chosen()); }

void Fmi2Unit::restore_state() {
  restore(states_.chosen());
  is_as_saved_ = true;
}

bool Fmi2Unit::save(SavedState& saved) {
  saved.is_present = save_by("fmi2GetFMUstate", fmi_.GetFMUstate, saved.state);
  saved.time = time_;
  saved.is_instantiated_only = is_instantiated_only_;
  saves_each_step_ = saves_each_step_ && saved.is_present;
  return saved.is_present;
}

void Fmi2Unit::restore(const SavedState& saved) {
  if (!saved.is_present) fail_without_state();
  require("fmi2SetFMUstate", fmi_.SetFMUstate, kFmi2Saving);
  check_state("fmi2GetFMUstate", saved.state);
  call("fmi2SetFMUstate", fmi_.SetFMUstate, saved.state);
  was_restored_ = true;
  time_ = saved.time;
  is_instantiated_only_ = saved.is_instantiated_only;
}

void Fmi2Unit::free_state(SavedState& saved) {
  if (free_by("fmi2FreeFMUstate", fmi_.FreeFMUstate, saved.state)) saved = {};
}

void Fmi2Unit::select_state(std::size_t slot) {
  states_.choose(slot);
  is_as_saved_ = false;
}

std::vector<std::uint8_t> Fmi2Unit::serialize_state() {
  const Serialization<fmi2Status, fmi2Byte> functions{.size_name = "fmi2SerializedFMUstateSize",
                                                      .size_of = fmi_.SerializedFMUstateSize,
                                                      .write_name = "fmi2SerializeFMUstate",
                                                      .write = fmi_.SerializeFMUstate,
                                                      .capability = kFmi2Serializing};
  if (!states_.chosen().is_present) fail_without_state();
  return serialized(states_.chosen().state, functions);
}

/// The bytes do not contain the time.
void Fmi2Unit::deserialize_state(std::span<const std::uint8_t> bytes) {
  require("fmi2DeSerializeFMUstate", fmi_.DeSerializeFMUstate, kFmi2Serializing);
  SavedState& saved = states_.chosen();
  free_state(saved);
  is_as_saved_ = false;
  void* state = nullptr;  // what a failed call leaves there is undefined
  call_for_state("fmi2DeSerializeFMUstate", fmi_.DeSerializeFMUstate,
                 reinterpret_cast<const fmi2Byte*>(bytes.data()), bytes.size(), &state);
  check_state("fmi2DeSerializeFMUstate", state);
  saved.state = state;
  saved.is_present = true;
}

void Fmi2Unit::reset() {
  reset_by("fmi2Reset", fmi_.Reset);
  is_as_saved_ = has_discard_warning_ = has_slow_step_warning_ = false;
  is_instantiated_only_ = true;
  saves_each_step_ = parts_.description->can_save_state;
  kept_parameters_.clear();
  kept_inputs_.clear();
}

}  // namespace stride::importer
