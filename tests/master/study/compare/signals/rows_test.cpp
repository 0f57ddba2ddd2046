#include "master/study/compare/signals/rows.h"

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;

namespace {

using Places = std::vector<std::size_t>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

RowPairs pairs_of(std::vector<std::int64_t> a, std::vector<std::int64_t> b) {
  return pair_rows(at_picoseconds(a), at_picoseconds(b));
}

std::optional<Difference> difference_of(const report::Column& a, const report::Column& b,
                                        Tolerance tolerance = {}) {
  std::vector<Time> times;
  Pairs rows;
  for (std::size_t i = 0; i < a.size(); ++i) {
    times.push_back(Time(static_cast<std::int64_t>(i) * kSecond));
    rows.emplace_back(i, i);
  }
  SignalTally tally("a.x");
  compare_rows(times, a, b, rows, tolerance, tally);
  return tally.difference();
}

}  // namespace

TEST_CASE("rows at the same instants belong together") {
  const RowPairs pairs = pairs_of({0, 1, 3}, {0, 2, 3});
  CHECK(pairs.both == Pairs{{0, 0}, {2, 2}});
  CHECK(pairs.only_a == Places{1});
  CHECK(pairs.only_b == Places{1});
}

TEST_CASE("of several at one instant the nth belongs to the nth") {
  const RowPairs pairs = pairs_of({0, 1, 1, 1}, {0, 1, 1, 2});
  CHECK(pairs.both == Pairs{{0, 0}, {1, 1}, {2, 2}});
  CHECK(pairs.only_a == Places{3});
  CHECK(pairs.only_b == Places{3});
}

TEST_CASE("one run may have no rows, or end earlier") {
  CHECK(pairs_of({}, {0, 1}).only_b == Places{0, 1});
  CHECK(pairs_of({0, 1, 2}, {0}).only_a == Places{1, 2});
}

TEST_CASE("values are compared bit by bit, or within the tolerance") {
  const report::Column a = reals({"1", "0.1", "NaN", "0"});
  const report::Column b = reals({"1", "0.10000000000000002", "NaN", "-0"});
  const auto difference = difference_of(a, b);
  REQUIRE(difference);
  CHECK(difference->time == Time(kSecond));
  CHECK(difference->count == 2);
  CHECK_FALSE(difference_of(a, b, {1e-9, 0}));
}

TEST_CASE("integers that no double has are told apart") {
  const auto integers = [](const std::string& last) {
    return column("a.n", core::ValueType::UInt64, {"1", last});
  };
  const auto difference =
      difference_of(integers("18446744073709551615"), integers("18446744073709551614"));
  REQUIRE(difference);
  CHECK(difference->count == 1);
  CHECK(difference->a == "18446744073709551615");
  CHECK_FALSE(difference_of(integers("18446744073709551615"), integers("18446744073709551615")));
  CHECK(difference_of(integers("18446744073709551615"), integers("2"))->count == 1);
}

TEST_CASE("texts are equal or not, and a Boolean is no number") {
  const report::Column a = column("a.x", core::ValueType::String, {"on", "off"});
  CHECK(difference_of(a, column("a.x", core::ValueType::String, {"on", "on"}))->count == 1);
  CHECK_FALSE(difference_of(a, a));
  CHECK(difference_of(column("a.x", core::ValueType::Boolean, {"true"}), reals({"1"}))->a ==
        "true");
}
