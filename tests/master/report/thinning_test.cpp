#include "master/report/thinning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/at.h"

using namespace stride::report;
using stride::Duration;
using stride::Time;
using stride::core::ValueType;
using stride::tests::at_picosecond;
using stride::tests::at_picoseconds;

namespace {

Column doubles(const std::vector<double>& values) {
  Column column(SignalInfo{"x", "", ValueType::Float64, true});
  for (const double value : values) column.append({fmt::format("{}", value), false});
  return column;
}

std::vector<double> values(const Column& column) {
  return std::get<std::vector<double>>(column.values());
}

}  // namespace

TEST_CASE("few values are not thinned") {
  CHECK(block_size(1000, 20, 20'000) == std::nullopt);
  CHECK(block_size(1'000'000, 0, 10) == std::nullopt);
}

TEST_CASE("blocks are so long that no more than the limit is kept") {
  for (const std::size_t columns : {1u, 7u, 100u, 3000u}) {
    for (const std::size_t rows : {100'000u, 12'345'678u}) {
      const std::size_t limit = 2'000'000;
      const auto size = block_size(rows, columns, limit);
      if (!size) continue;
      const std::size_t blocks = (rows + *size - 1) / *size;
      INFO(columns << " columns, " << rows << " rows, blocks of " << *size);
      CHECK((blocks * (3 * columns + 2) * columns <= limit || blocks == 1));
    }
  }
}

TEST_CASE("in each block the least and the greatest of each column stay where they were") {
  std::mt19937 random(17);
  std::normal_distribution<double> normal;
  const std::size_t count = 1000;
  std::vector<double> a(count), b(count);
  std::vector<Time> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = normal(random);
    b[i] = normal(random) * 1e-9;
    times[i] = at_picosecond(10 * static_cast<std::int64_t>(i));
  }
  b[700] = 3;  // a spike
  const std::size_t block = 100;
  for (std::size_t first = 0; first < count; first += block) {
    std::vector<Time> part(times.begin() + static_cast<std::ptrdiff_t>(first),
                           times.begin() + static_cast<std::ptrdiff_t>(first + block));
    std::vector<Column> parts;
    for (const auto* all : {&a, &b}) {
      parts.push_back(doubles({all->begin() + static_cast<std::ptrdiff_t>(first),
                               all->begin() + static_cast<std::ptrdiff_t>(first + block)}));
    }
    thin(part, parts, 0);
    CHECK(part.size() <= 6);
    CHECK(part.front() == times[first]);
    CHECK(part.back() == times[first + block - 1]);
    for (std::size_t c = 0; c < 2; ++c) {
      const auto& all = c == 0 ? a : b;
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      const auto [least, most] = std::minmax_element(begin, begin + block);
      const std::vector<double> found = values(parts[c]);
      CHECK(*std::min_element(found.begin(), found.end()) == *least);
      CHECK(*std::max_element(found.begin(), found.end()) == *most);
      for (std::size_t i = 0; i < part.size(); ++i) {
        CHECK(found[i] == all[static_cast<std::size_t>(part[i].time_since_epoch() / Duration(10))]);
      }
    }
  }
}

TEST_CASE("NaN and infinities are not lost") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Time> times = at_picoseconds({0, 1, 2, 3, 4, 5, 6, 7});
  std::vector<Column> columns = {doubles({0, 1, nan, 1, infinity, 0, -5, 0})};
  thin(times, columns, 0);
  CHECK(times == at_picoseconds({0, 2, 4, 6, 7}));
  CHECK(std::isnan(values(columns[0])[1]));
  CHECK(values(columns[0])[2] == infinity);
}

TEST_CASE("rows before the block stay") {
  std::vector<Time> times = at_picoseconds({0, 1, 2, 3, 4});
  std::vector<Column> columns = {doubles({5, 6, 0, 0, 0})};
  thin(times, columns, 2);
  CHECK(times == at_picoseconds({0, 1, 2, 4}));
  thin(times, columns, 4);
  CHECK(times.size() == 4);
}

TEST_CASE("what is held while rows are added stays below a bound, and the same rows stay") {
  const std::size_t count = GENERATE(2u, 40u, 100u);  // columns
  const std::size_t rows = 20'000;
  const std::size_t limit = 10'000;
  Thinner thinner(rows, count, limit);
  REQUIRE(thinner.block());
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<Column> columns(count, doubles({})), block(count, doubles({}));
  std::vector<Time> times, block_times, expected;
  std::size_t most_held = 0;
  const auto end_block = [&] {
    thin(block_times, block, 0);
    expected.insert(expected.end(), block_times.begin(), block_times.end());
    block_times.clear();
    for (Column& column : block) column.keep(0, {});
  };
  for (std::size_t row = 0; row < rows; ++row) {
    thinner.make_room(times, columns);
    if (block_times.size() == *thinner.block()) end_block();
    for (std::size_t i = 0; i < count; ++i) {
      const std::string text = fmt::format("{:.3f}", normal(random));
      columns[i].append({text, false});
      block[i].append({text, false});
    }
    times.push_back(at_picosecond(static_cast<std::int64_t>(row)));
    block_times.push_back(times.back());
    most_held = std::max(most_held, times.size() * count);
  }
  thinner.finish(times, columns);
  end_block();
  CHECK(times == expected);
  CHECK(columns.back().size() == times.size());
  CHECK(most_held <= std::max(3 * limit, 2 * (3 * count + 2) * count));
}
