#include "units/channel/superposition.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include <stride/nfc/iso14443a.h>

namespace channel {
namespace {

using nfc::kBitsPerByte;
using stride::Duration;
using stride::Time;

enum class Slot : std::uint8_t { Silent, Zero, One, Collision };

Slot both(Slot first, Slot second) {
  if (first == Slot::Silent) return second;
  if (second == Slot::Silent || first == second) return first;
  return Slot::Collision;
}

// The bits of the earliest frame as a grid, of which each frame takes some.
class Grid {
 public:
  explicit Grid(const nfc::Frame& earliest)
      : start_(earliest.start),
        bit_rate_(earliest.bit_rate),
        bit_(nfc::bit_duration(earliest.bit_rate)) {}

  void add(const nfc::Frame& frame) {
    const auto offset = bits_in_step(frame);
    if (!offset) return add_collision(frame.start, frame.start + nfc::air_time(frame));
    if (*offset > 0) add(static_cast<std::size_t>(*offset) - 1, Slot::Collision, false);
    for (std::size_t i = 0; i < frame.bits.size(); ++i) {
      add(static_cast<std::size_t>(*offset) + i, frame.bits[i] != 0 ? Slot::One : Slot::Zero);
    }
  }

  nfc::Frame frame() const {
    nfc::Frame result{start_, bit_rate_, {}};
    for (const Slot slot : slots_) result.bits.push_back(slot != Slot::Zero ? 1 : 0);
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (slots_[i] == Slot::Collision) spoil_parity(result.bits, i / kBitsPerByte);
    }
    return result;
  }

 private:
  // How many bits later than the first it begins, if that is a whole number.
  std::optional<std::int64_t> bits_in_step(const nfc::Frame& frame) const {
    if (frame.bit_rate != bit_rate_) return std::nullopt;
    const Duration late = frame.start - start_;
    const std::int64_t count = (late + bit_ / 2) / bit_;
    const Duration off = late - count * bit_;
    if (std::max(off, -off) > bit_ / 16) return std::nullopt;
    return count;
  }

  void add_collision(Time from, Time to) {
    const auto index = [this](Time time) { return (time - start_) / bit_ - 1; };
    for (std::int64_t i = std::max<std::int64_t>(0, index(from)); i <= index(to); ++i) {
      add(static_cast<std::size_t>(i), Slot::Collision);
    }
  }

  // A start of communication disturbs what is there, but is not a bit of its own.
  void add(std::size_t index, Slot slot, bool extend = true) {
    if (index >= slots_.size()) {
      if (!extend) return;
      slots_.resize(index + 1, Slot::Silent);
    }
    slots_[index] = both(slots_[index], slot);
  }

  static void spoil_parity(nfc::Bits& bits, std::size_t byte) {
    const std::size_t first = byte * kBitsPerByte;
    if (first + kBitsPerByte > bits.size()) return;  // no whole byte, so no good frame
    std::uint8_t ones = 0;
    for (std::size_t i = first; i + 1 < first + kBitsPerByte; ++i) ones ^= bits[i];
    bits[first + kBitsPerByte - 1] = ones;  // parity is odd in a good frame
  }

  Time start_;
  std::uint32_t bit_rate_;
  Duration bit_;
  std::vector<Slot> slots_;
};

}  // namespace

nfc::Frame superposed(const std::vector<nfc::Frame>& frames) {
  const auto earlier = [](const nfc::Frame& a, const nfc::Frame& b) { return a.start < b.start; };
  Grid grid(*std::min_element(frames.begin(), frames.end(), earlier));
  std::vector<const nfc::Frame*> in_order;
  for (const nfc::Frame& frame : frames) in_order.push_back(&frame);
  std::stable_sort(in_order.begin(), in_order.end(),
                   [&](const auto* a, const auto* b) { return earlier(*a, *b); });
  for (const nfc::Frame* frame : in_order) grid.add(*frame);
  return grid.frame();
}

}  // namespace channel
