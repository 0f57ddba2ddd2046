#include "master/engine/model/item_set.h"

#include <limits>

#include <catch2/catch.hpp>

using stride::core::ItemSet;

TEST_CASE("a set has the numbers of the items, and no other") {
  const ItemSet contiguous({{"c", 3}, {"a", 1}, {"b", 2}});
  for (const std::int64_t number : {1, 2, 3}) CHECK(contiguous.contains(number));
  for (const std::int64_t number : {0, 4, -1}) CHECK(!contiguous.contains(number));

  const ItemSet sparse({{"on", 7}, {"off", 1}, {"also on", 7}});
  for (const std::int64_t number : {1, 7}) CHECK(sparse.contains(number));
  for (const std::int64_t number : {0, 2, 6, 8}) CHECK(!sparse.contains(number));
}

TEST_CASE("a set may reach from the least number to the greatest") {
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const ItemSet ends({{"least", kLeast}, {"most", kMost}});
  CHECK((ends.contains(kLeast) && ends.contains(kMost)));
  CHECK(!ends.contains(0));
}
