#include <algorithm>
#include <cstdint>

#include <stride/nfc/frame.h>
#include <stride/nfc/frame_delay.h>

namespace nfc {
namespace {

constexpr std::int64_t kMinimumSlots = 9;

stride::Duration frame_delay(std::int64_t n) {
  return stride::duration_from_seconds(static_cast<double>(n * 128 + 84) / kCarrierFrequency);
}

}  // namespace

stride::Time answer_start(stride::Time request_end, stride::Time earliest) {
  const double waited = stride::to_seconds(earliest - request_end) * kCarrierFrequency;
  std::int64_t n = std::max(kMinimumSlots, static_cast<std::int64_t>((waited - 84) / 128) - 1);
  while (request_end + frame_delay(n) < earliest) ++n;
  return request_end + frame_delay(n);
}

}  // namespace nfc
