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

}  // namespace

std::optional<std::size_t> block_size(std::size_t rows, std::size_t columns, std::size_t limit) {
  if (columns == 0 || rows <= limit / columns) return std::nullopt;
  // a block keeps three rows of each column at most, its first and its last one
  const std::size_t kept = 3 * columns + 2;
  const std::size_t blocks = std::max<std::size_t>(1, limit / columns / kept);
  return (rows + blocks - 1) / blocks;
}

void thin(std::vector<std::int64_t>& times, std::vector<Column>& columns, std::size_t first) {
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

}  // namespace stride::report
