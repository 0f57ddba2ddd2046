#include "master/study/compare/signals/rows.h"

#include <string>

#include "master/study/compare/signals/values.h"

namespace stride::compare {

RowPairs pair_rows(std::span<const Time> a, std::span<const Time> b) {
  RowPairs pairs;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() || j < b.size()) {
    if (j == b.size() || (i < a.size() && a[i] < b[j])) {
      pairs.only_a.push_back(i++);
    } else if (i == a.size() || b[j] < a[i]) {
      pairs.only_b.push_back(j++);
    } else {
      pairs.both.emplace_back(i++, j++);
    }
  }
  return pairs;
}

void compare_rows(std::span<const Time> times, const report::Column& a, const report::Column& b,
                  std::span<const std::pair<std::size_t, std::size_t>> rows, Tolerance tolerance,
                  SignalTally& tally) {
  if (are_numbers(a, b)) {
    for (const auto& [i, j] : rows) {
      const double mine = number(a, i);
      const double other = number(b, j);
      if (!tolerance.allows(mine, other)) tally.add(times[i], mine, other);
    }
    return;
  }
  for (const auto& [i, j] : rows) {
    const std::string mine = a.text(i);
    const std::string other = b.text(j);
    if (mine != other) tally.add(times[i], mine, other);
  }
}

}  // namespace stride::compare
