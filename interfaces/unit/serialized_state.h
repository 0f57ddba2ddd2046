// States as bytes (fmi3SerializeFMUState): what is around them, so that they are known again.
#ifndef STRIDE_INTERFACES_UNIT_SERIALIZED_STATE_H
#define STRIDE_INTERFACES_UNIT_SERIALIZED_STATE_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <stride/unit.h>

namespace stride::kit {

/// Whose state it is. States of equal identities are interchangeable.
struct StateIdentity {
  std::string unit;
  std::string token;            ///< the instantiation token: variables, version, idle manifest
  std::uint64_t layout = 0;     ///< of the members listed in state()
  bool uses_event_mode = true;  ///< how the importer has instantiated it
};

/// Of the members that the unit lists.
std::uint64_t layout_of_state(const Unit& unit);

/// The bytes are, all numbers as they are in memory:
///
///   "stridest", format version (4), uses_event_mode (4), size of all of them (8), checksum of all
///   others (8), layout (8), size (8) and text of the unit's name, likewise the token, the state.
class SerializedState {
 public:
  static constexpr std::uint32_t kFormat = 1;

  explicit SerializedState(StateIdentity identity);

  std::size_t size(const std::vector<std::uint8_t>& state) const {
    return kFixedSize + names_.size() + state.size();
  }
  /// Into size() bytes.
  void write(const std::vector<std::uint8_t>& state, std::uint8_t* bytes) const;
  /// The size of what is before the state in bytes that write() of this identity wrote. Throws
  /// Misuse, with what was expected and what was found, if they are others.
  std::size_t check(const std::uint8_t* bytes, std::size_t size) const;

 private:
  static constexpr std::size_t kFixedSize = 40;

  void check_whole(const std::uint8_t* bytes, std::size_t size) const;
  void check_identity(const std::uint8_t* bytes, std::size_t size) const;

  StateIdentity identity_;
  std::vector<std::uint8_t> names_;  ///< of the unit and its token, as they are written
};

}  // namespace stride::kit

#endif
