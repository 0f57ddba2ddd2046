#include "interfaces/unit/serialized_state.h"

#include <algorithm>
#include <cstring>

#include "interfaces/unit/hash.h"
#include "interfaces/unit/misuse.h"

namespace stride::kit {
namespace {

constexpr char kMagic[8] = {'s', 't', 'r', 'i', 'd', 'e', 's', 't'};

// Where the numbers before the names are.
constexpr std::size_t kFormatAt = 8, kEventModeAt = 12, kSizeAt = 16, kChecksumAt = 24,
                      kLayoutAt = 32;

template <class Number>
Number number_at(const std::uint8_t* bytes, std::size_t place) {
  Number number;
  std::memcpy(&number, bytes + place, sizeof number);
  return number;
}

template <class Number>
void put(std::uint8_t* bytes, std::size_t place, Number number) {
  std::memcpy(bytes + place, &number, sizeof number);
}

/// Of all but itself.
std::uint64_t checksum(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::size_t kBehind = kChecksumAt + sizeof(std::uint64_t);
  return hash(bytes + kBehind, size - kBehind, hash(bytes, kChecksumAt));
}

[[noreturn]] void refuse_bytes(const std::string& why) {
  throw Misuse("these bytes are not a saved state of this unit: " + why);
}

std::string bytes_text(std::uint64_t count) { return std::to_string(count) + " bytes"; }

}  // namespace

std::uint64_t layout_of_state(const Unit& unit) {
  std::uint64_t layout = kHashOfNothing;
  for (const StateItem& item : unit.state_items()) {
    layout = hash(&item.layout, sizeof item.layout, layout);
  }
  return layout;
}

SerializedState::SerializedState(StateIdentity identity) : identity_(std::move(identity)) {
  StateWriter writer(names_);
  writer.write(identity_.unit);
  writer.write(identity_.token);
}

void SerializedState::write(const std::vector<std::uint8_t>& state, std::uint8_t* bytes) const {
  std::memcpy(bytes, kMagic, sizeof kMagic);
  put(bytes, kFormatAt, kFormat);
  put(bytes, kEventModeAt, static_cast<std::uint32_t>(identity_.uses_event_mode));
  put(bytes, kSizeAt, static_cast<std::uint64_t>(size(state)));
  put(bytes, kLayoutAt, identity_.layout);
  std::copy(state.begin(), state.end(),
            std::copy(names_.begin(), names_.end(), bytes + kFixedSize));
  put(bytes, kChecksumAt, checksum(bytes, size(state)));
}

std::size_t SerializedState::check(const std::uint8_t* bytes, std::size_t size) const {
  check_whole(bytes, size);
  check_identity(bytes, size);
  return kFixedSize + names_.size();
}

void SerializedState::check_whole(const std::uint8_t* bytes, std::size_t size) const {
  if (size < kFixedSize) {
    refuse_bytes("there are " + bytes_text(size) + ", expected " + std::to_string(kFixedSize) +
                 " at least");
  }
  if (!std::equal(std::begin(kMagic), std::end(kMagic), bytes)) {
    refuse_bytes("they do not begin with '" + std::string(kMagic, sizeof kMagic) + "'");
  }
  const auto format = number_at<std::uint32_t>(bytes, kFormatAt);
  if (format != kFormat) {
    refuse_bytes("they are of format " + std::to_string(format) + ", expected " +
                 std::to_string(kFormat));
  }
  const auto whole = number_at<std::uint64_t>(bytes, kSizeAt);
  if (whole != size) {
    refuse_bytes("there are " + bytes_text(size) + ", expected the " + std::to_string(whole) +
                 " that were written");
  }
  if (number_at<std::uint64_t>(bytes, kChecksumAt) != checksum(bytes, size)) {
    refuse_bytes("their checksum is another than the one that was written, so they are damaged");
  }
}

void SerializedState::check_identity(const std::uint8_t* bytes, std::size_t size) const {
  std::string unit, token;
  StateReader reader(bytes + kFixedSize, size - kFixedSize);
  reader.read(unit);
  reader.read(token);
  if (unit != identity_.unit) {
    refuse_bytes("they are of the unit '" + unit + "', expected '" + identity_.unit + "'");
  }
  if (token != identity_.token) {
    refuse_bytes("they are of another version of '" + unit + "', with the instantiation token '" +
                 token + "', expected '" + identity_.token + "'");
  }
  if (number_at<std::uint64_t>(bytes, kLayoutAt) != identity_.layout) {
    refuse_bytes("they are of a build of '" + unit + "' whose state() lists other members");
  }
  const bool uses_event_mode = number_at<std::uint32_t>(bytes, kEventModeAt) != 0;
  if (uses_event_mode != identity_.uses_event_mode) {
    refuse_bytes("they are of an instance " + std::string(uses_event_mode ? "with" : "without") +
                 " Event Mode (eventModeUsed), expected one " +
                 (uses_event_mode ? "without" : "with"));
  }
}

}  // namespace stride::kit
