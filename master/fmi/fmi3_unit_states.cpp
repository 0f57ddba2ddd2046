// Several kept states, states as bytes, and the way back to the beginning.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/fmi/fmi3_unit.h"

namespace stride::fmi {

/// Not every library has these functions.
template <class Function>
void Fmi3Unit::require(const char* name, Function* function) const {
  if (function != nullptr) return;
  fail(fmt::format("its library does not export {}", name),
       "a unit that can serialise its state must have it (canSerializeFMUState)");
}

void Fmi3Unit::free_state(fmi3FMUState& state) {
  if (state == nullptr || is_condemned_ || fmi_.FreeFMUState == nullptr) return;
  if (fmi_.FreeFMUState(instance_, &state) == fmi3Fatal) condemn();
  state = nullptr;
}

void Fmi3Unit::select_state(std::size_t slot) {
  if (slot == state_slot_) return;
  kept_states_.resize(std::max({kept_states_.size(), slot + 1, state_slot_ + 1}));
  kept_states_[state_slot_] = {std::exchange(state_, nullptr), state_time_};
  state_ = std::exchange(kept_states_[slot].state, nullptr);
  state_time_ = kept_states_[slot].time;
  state_slot_ = slot;
}

std::vector<std::uint8_t> Fmi3Unit::serialize_state() {
  if (state_ == nullptr) fail("no state of it has been saved that could be serialised");
  require("fmi3SerializedFMUStateSize", fmi_.SerializedFMUStateSize);
  require("fmi3SerializeFMUState", fmi_.SerializeFMUState);
  std::size_t size = 0;
  call("fmi3SerializedFMUStateSize", fmi_.SerializedFMUStateSize, state_, &size);
  std::vector<std::uint8_t> bytes(size);
  call("fmi3SerializeFMUState", fmi_.SerializeFMUState, state_, bytes.data(), size);
  return bytes;
}

void Fmi3Unit::deserialize_state(std::span<const std::uint8_t> bytes) {
  require("fmi3DeserializeFMUState", fmi_.DeserializeFMUState);
  free_state(state_);
  state_time_.reset();  // the bytes do not tell
  call("fmi3DeserializeFMUState", fmi_.DeserializeFMUState, bytes.data(), bytes.size(), &state_);
}

void Fmi3Unit::reset() {
  if (fmi_.Reset == nullptr) fail("its library does not export fmi3Reset");
  failed_in_ = nullptr;
  call("fmi3Reset", fmi_.Reset);
  time_.reset();
  rejection_reason_.clear();
  has_time_warning_ = false;
  may_skip_ = false;
}

}  // namespace stride::fmi
