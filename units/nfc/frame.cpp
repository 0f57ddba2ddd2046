#include <algorithm>
#include <stdexcept>
#include <string>

#include <stride/nfc/frame.h>

namespace nfc {
namespace {

constexpr std::size_t kHeaderSize = 16;
constexpr stride::Picoseconds kWrap = stride::Picoseconds{1} << 64;

template <class Integer>
void put(Bytes& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
}

template <class Integer>
Integer take(const Bytes& bytes, std::size_t offset) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    value |= std::uint64_t{bytes[offset + i]} << (8 * i);
  }
  return static_cast<Integer>(value);
}

int carrier_periods_per_bit(std::uint32_t bit_rate) {
  switch (bit_rate) {
    case 106:
      return 128;
    case 212:
      return 64;
    case 424:
      return 32;
    case 848:
      return 16;
    default:
      throw std::invalid_argument("bit rate " + std::to_string(bit_rate) +
                                  " kbit/s: expected 106, 212, 424 or 848");
  }
}

}  // namespace

stride::Duration bit_duration(std::uint32_t bit_rate) {
  return stride::duration_from_seconds(carrier_periods_per_bit(bit_rate) / kCarrierFrequency);
}

stride::Duration air_time(const Frame& frame) {
  return bit_duration(frame.bit_rate) * static_cast<std::int64_t>(frame.bits.size() + 2);
}

Frame cut_off(Frame frame, stride::Time time) {
  const stride::Picoseconds periods = (time - frame.start) / bit_duration(frame.bit_rate);
  const stride::Picoseconds all = frame.bits.size();
  frame.bits.resize(static_cast<std::size_t>(std::clamp<stride::Picoseconds>(periods - 1, 0, all)));
  return frame;
}

Bytes encode(const Frame& frame) {
  Bytes bytes;
  bytes.reserve(kHeaderSize + (frame.bits.size() + 7) / 8);
  const stride::Picoseconds start = frame.start.time_since_epoch().count();
  const auto narrow = static_cast<std::int64_t>(start);
  put(bytes, narrow);
  put(bytes, static_cast<std::uint16_t>(frame.bit_rate));
  put(bytes, static_cast<std::int16_t>((start - narrow) >> 64));
  put(bytes, static_cast<std::uint32_t>(frame.bits.size()));
  bytes.resize(kHeaderSize + (frame.bits.size() + 7) / 8);
  for (std::size_t i = 0; i < frame.bits.size(); ++i) {
    bytes[kHeaderSize + i / 8] |= static_cast<std::uint8_t>((frame.bits[i] & 1) << (i % 8));
  }
  return bytes;
}

Frame decode(const Bytes& payload) {
  if (payload.size() < kHeaderSize) {
    throw std::invalid_argument("a frame has at least 16 bytes, this one has " +
                                std::to_string(payload.size()));
  }
  Frame frame;
  const stride::Picoseconds beyond = take<std::int16_t>(payload, 10);
  frame.start = stride::Time(stride::Duration(beyond * kWrap + take<std::int64_t>(payload, 0)));
  frame.bit_rate = take<std::uint16_t>(payload, 8);
  carrier_periods_per_bit(frame.bit_rate);
  const std::size_t count = take<std::uint32_t>(payload, 12);
  if (payload.size() != kHeaderSize + (count + 7) / 8) {
    throw std::invalid_argument("a frame of " + std::to_string(count) + " bits has " +
                                std::to_string(kHeaderSize + (count + 7) / 8) +
                                " bytes, this one has " + std::to_string(payload.size()));
  }
  frame.bits.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    frame.bits[i] = (payload[kHeaderSize + i / 8] >> (i % 8)) & 1;
  }
  return frame;
}

}  // namespace nfc
