// Several kept states, states as bytes, and the way back to the beginning.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/fmi/fmi2_unit.h"

namespace stride::fmi {

/// Not every library has these functions.
template <class Function>
void Fmi2Unit::require(const char* name, Function* function) const {
  if (function != nullptr) return;
  fail(fmt::format("its library does not export {}", name),
       "a unit that can serialise its state must have it (canSerializeFMUstate)");
}

void Fmi2Unit::select_state(std::size_t slot) {
  if (slot == state_slot_) return;
  kept_states_.resize(std::max({kept_states_.size(), slot + 1, state_slot_ + 1}));
  kept_states_[state_slot_] = std::exchange(saved_, {});
  saved_ = std::exchange(kept_states_[slot], {});
  state_slot_ = slot;
  is_as_saved_ = false;
}

std::vector<std::uint8_t> Fmi2Unit::serialize_state() {
  if (saved_.state == nullptr) fail("no state of it has been saved that could be serialised");
  require("fmi2SerializedFMUstateSize", fmi_.SerializedFMUstateSize);
  require("fmi2SerializeFMUstate", fmi_.SerializeFMUstate);
  std::size_t size = 0;
  call("fmi2SerializedFMUstateSize", fmi_.SerializedFMUstateSize, saved_.state, &size);
  std::vector<std::uint8_t> bytes(size);
  call("fmi2SerializeFMUstate", fmi_.SerializeFMUstate, saved_.state,
       reinterpret_cast<fmi2Byte*>(bytes.data()), size);
  return bytes;
}

void Fmi2Unit::deserialize_state(std::span<const std::uint8_t> bytes) {
  require("fmi2DeSerializeFMUstate", fmi_.DeSerializeFMUstate);
  free_state(saved_);
  saved_ = {};  // the bytes do not tell the time
  is_as_saved_ = false;
  call("fmi2DeSerializeFMUstate", fmi_.DeSerializeFMUstate,
       reinterpret_cast<const fmi2Byte*>(bytes.data()), bytes.size(), &saved_.state);
}

void Fmi2Unit::reset() {
  if (fmi_.Reset == nullptr) fail("its library does not export fmi2Reset");
  failed_in_ = nullptr;
  call("fmi2Reset", fmi_.Reset);
  time_.reset();
  rejection_reason_.clear();
  is_as_saved_ = false;
  is_instantiated_only_ = true;
  kept_inputs_.clear();
}

}  // namespace stride::fmi
