#include <cstdint>

#include <stride/nfc/frame.h>
#include <stride/nfc/frame_delay.h>

namespace nfc {
namespace {

constexpr std::int64_t kSlot = 128;  // all in carrier periods
constexpr std::int64_t kPause = 32;
constexpr std::int64_t kLeastSlots = 9;

stride::Duration carrier_periods(std::int64_t count) {
  return stride::duration_from_seconds(static_cast<double>(count) / kCarrierFrequency);
}

/// From the beginning of the end of communication.
std::int64_t end_of_last_pause(bool after_one) { return after_one ? -kSlot / 2 + kPause : kPause; }

}  // namespace

stride::Time first_answer_start(const Frame& request) {
  const stride::Time end_of_bits = request.start + air_time(request) - bit_duration(106);
  const bool after_one = !request.bits.empty() && request.bits.back() == 1;
  const std::int64_t delay = kLeastSlots * kSlot + (after_one ? 84 : 20);
  return end_of_bits + carrier_periods(end_of_last_pause(after_one) + delay);
}

stride::Time answer_start(stride::Time first, stride::Time earliest) {
  if (earliest <= first) return first;
  const double waited = stride::to_seconds(earliest - first) * kCarrierFrequency;
  auto slots = static_cast<std::int64_t>(waited / static_cast<double>(kSlot));
  while (first + carrier_periods(slots * kSlot) < earliest) ++slots;
  return first + carrier_periods(slots * kSlot);
}

}  // namespace nfc
