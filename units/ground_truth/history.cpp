#include "units/ground_truth/history.h"

#include <algorithm>

namespace ground_truth {

void History::note(stride::Time time, double value) {
  auto& pieces = state_.pieces;
  if (pieces.empty()) {
    pieces.push_back({time, value, value});
  } else if (!join(time, value)) {
    pieces.push_back({state_.last, std::min(state_.value, value), std::max(state_.value, value)});
  }
  state_.last = time;
  state_.value = value;
  forget();
}

bool History::join(stride::Time time, double value) {
  Piece& newest = state_.pieces.back();
  const double low = std::min(newest.low, value);
  const double high = std::max(newest.high, value);
  const bool is_short = time > newest.from && time - newest.from <= grain_.time;
  if (high - low > grain_.width && !is_short) return false;
  newest.low = low;
  newest.high = high;
  return true;
}

void History::forget() {
  auto& pieces = state_.pieces;
  while (pieces.size() > 1 && state_.last - pieces[1].from > length_) pieces.pop_front();
}

std::optional<History::Bounds> History::between(stride::Time from, stride::Time to) const {
  const auto& pieces = state_.pieces;
  if (pieces.empty() || to < pieces.front().from) return std::nullopt;
  const auto begins_before = [](const Piece& piece, stride::Time time) {
    return piece.from < time;
  };
  auto piece = std::lower_bound(pieces.begin(), pieces.end(), from, begins_before);
  const bool is_within_one = piece == pieces.end() || piece->from > from;
  if (is_within_one && piece != pieces.begin()) --piece;
  Bounds bounds{piece->low, piece->high, from >= pieces.front().from};
  for (++piece; piece != pieces.end() && piece->from <= to; ++piece) {
    const auto next = piece + 1;
    const bool is_jump = piece->from == (next != pieces.end() ? next->from : state_.last);
    if (piece->from == to && !is_jump) break;
    bounds.low = std::min(bounds.low, piece->low);
    bounds.high = std::max(bounds.high, piece->high);
  }
  return bounds;
}

}  // namespace ground_truth
