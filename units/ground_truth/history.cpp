#include "units/ground_truth/history.h"

#include <algorithm>

namespace ground_truth {

void History::configure(Grain grain, stride::Duration length) {
  // else what is joined would depend on what is forgotten already
  grain_ = {grain.width, std::min(grain.time, length)};
  length_ = length;
}

void History::note(stride::Time time, double value) {
  if (state_.pieces.empty()) {
    state_.pieces.push_back({time, value, value});
  } else if (value != state_.value) {
    jump(time, value);
  }
  state_.last = time;
  state_.value = value;
  forget();
}

void History::jump(stride::Time time, double value) {
  auto& pieces = state_.pieces;
  Piece& newest = pieces.back();
  const double low = std::min(newest.low, value);
  const double high = std::max(newest.high, value);
  if (high - low <= grain_.width) {
    newest.low = low;
    newest.high = high;
    return;
  }
  if (pieces.size() > 1) {
    Piece& before = *(pieces.end() - 2);
    if (time - before.from <= grain_.time) {
      before.low = std::min(before.low, newest.low);
      before.high = std::max(before.high, newest.high);
      pieces.pop_back();
    }
  }
  pieces.push_back({time, value, value});
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
  if (piece != pieces.begin()) --piece;  // which lasts until `from` at least
  Bounds bounds{piece->low, piece->high, from >= pieces.front().from};
  for (++piece; piece != pieces.end() && piece->from <= to; ++piece) {
    bounds.low = std::min(bounds.low, piece->low);
    bounds.high = std::max(bounds.high, piece->high);
  }
  return bounds;
}

}  // namespace ground_truth
