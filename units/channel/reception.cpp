#include "units/channel/reception.h"

#include <algorithm>
#include <utility>

namespace channel {

using stride::Duration;
using stride::Time;

Time Transit::end_of_bits(std::size_t count) const {
  const std::size_t symbols = (count + bits_per_symbol - 1) / bits_per_symbol;
  return begin + header + symbol * static_cast<std::int64_t>(symbols);
}

Transit nominal_transit(const nfc::Frame& frame) {
  Transit transit;
  transit.begin = frame.start;
  transit.header = transit.symbol = transit.trailer = nfc::bit_duration(frame.bit_rate);
  return transit;
}

Reception::Reception(const nfc::Frame& frame, const Transit& transit, std::uint32_t tag,
                     std::uint64_t number)
    : sent(frame),
      transit(transit),
      tag(tag),
      number(number),
      end(transit.end_of_bits(frame.bits.size()) + transit.trailer),
      has_header(transit.header_bits == 0) {
  heard.reserve(frame.bits.size());
}

Time Reception::next_instant() const {
  return transit.end_of_bits(has_header ? heard.size() + 1 : 0);
}

bool Reception::overlaps(const Reception& other) const {
  return transit.begin < other.end && other.transit.begin < end;
}

bool Reception::keeps_busy_at(Time begin) const {
  const bool is_listened_to = transit.header_bits > 0 && has_header && !deaf;
  return is_listened_to && transit.begin < begin && begin < end;
}

void Reception::cut(const nfc::Bits& bits) {
  if (transit.is_stored) {
    deaf = true;
    end = std::min(end, transit.begin);
    return;
  }
  sent.bits = bits;
  if (heard.size() > bits.size()) heard.resize(bits.size());
  end = std::min(end, transit.end_of_bits(bits.size()) + transit.trailer);
}

void Reception::end_with_carrier(Time now) {
  lost = true;
  end = std::min(end, std::max(now, transit.end_of_bits(heard.size()) + transit.trailer));
}

std::optional<nfc::Frame> take_ended(std::vector<Reception>& receptions, Time now,
                                     std::optional<std::uint32_t> tag) {
  for (std::size_t i = 0; i < receptions.size();) {
    Reception& candidate = receptions[i];
    if ((tag && candidate.tag != *tag) || candidate.end > now) {
      ++i;
      continue;
    }
    const Reception reception = std::move(candidate);
    receptions.erase(receptions.begin() + static_cast<std::ptrdiff_t>(i));
    if (reception.is_heard()) return reception.heard_frame();
  }
  return std::nullopt;
}

}  // namespace channel
