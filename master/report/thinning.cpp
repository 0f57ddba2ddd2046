#include "master/report/thinning.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace stride::report {
namespace {

template <class Element>
bool is_nan(Element value) {
  if constexpr (std::is_floating_point_v<Element>) return std::isnan(value);
  return false;
}

/// Adds the rows of the least and the greatest value, and of the first NaN.
template <class Element>
void add_extremes(const std::vector<Element>& values, std::size_t first,
                  std::vector<std::size_t>& rows) {
  std::optional<std::size_t> least, most, nan;
  for (std::size_t row = first; row < values.size(); ++row) {
    if (is_nan(values[row])) {
      if (!nan) nan = row;
      continue;
    }
    if (!least || values[row] < values[*least]) least = row;
    if (!most || values[row] > values[*most]) most = row;
  }
  for (const auto& row : {least, most, nan}) {
    if (row) rows.push_back(*row);
  }
}

/// A block keeps three rows of each column at most, its first and its last one.
std::size_t most_kept(std::size_t columns) { return 3 * columns + 2; }

}  // namespace

std::optional<std::size_t> block_size(std::size_t rows, std::size_t columns, std::size_t limit) {
  if (columns == 0 || rows <= limit / columns) return std::nullopt;
  const std::size_t blocks = std::max<std::size_t>(1, limit / columns / most_kept(columns));
  return (rows + blocks - 1) / blocks;
}

void thin(std::vector<Time>& times, std::vector<Column>& columns, std::size_t first) {
  if (first == times.size()) return;
  std::vector<std::size_t> rows = {first, times.size() - 1};
  for (const Column& column : columns) {
    std::visit(
        [&](const auto& values) {
          if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, Texts>) {
            add_extremes(values.indices(), first, rows);
          } else {
            add_extremes(values, first, rows);
          }
        },
        column.values());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (Column& column : columns) column.keep(first, rows);
  std::size_t to = first;
  for (const std::size_t row : rows) times[to++] = times[row];
  times.resize(to);
}

Thinner::Thinner(std::size_t rows, std::size_t columns, std::size_t limit)
    : block_(block_size(rows, columns, limit)) {
  if (block_) most_held_ = std::max(limit / columns, 2 * most_kept(columns));
}

void Thinner::make_room(std::vector<Time>& times, std::vector<Column>& columns) {
  if (!block_) return;
  const bool is_full = count_ == *block_;
  if (is_full || times.size() - first_ >= most_held_) thin(times, columns, first_);
  if (is_full) {
    first_ = times.size();
    count_ = 0;
  }
  ++count_;
}

void Thinner::finish(std::vector<Time>& times, std::vector<Column>& columns) {
  if (!block_) return;
  thin(times, columns, first_);
  for (Column& column : columns) column.drop_unused_texts();
}

}  // namespace stride::report
