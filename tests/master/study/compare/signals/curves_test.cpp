#include "master/study/compare/signals/curves.h"

#include <algorithm>
#include <random>

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;

namespace {

using Times = std::vector<std::int64_t>;

std::optional<Difference> compared(const Times& times_a, const report::Column& a,
                                   const Times& times_b, const report::Column& b,
                                   const CurveTolerances& tolerances) {
  SignalTally tally("a.x");
  const std::vector<Time> in_a = at_picoseconds(times_a), in_b = at_picoseconds(times_b);
  compare_curves({in_a, a}, {in_b, b}, tolerances, tally);
  return tally.difference();
}

constexpr CurveTolerances kNear{.value = {1e-12, 0}};

}  // namespace

TEST_CASE("a continuous signal goes straight from row to row") {
  const report::Column coarse = reals({"0", "4"});
  const report::Column fine = reals({"0", "1", "4"});
  CHECK_FALSE(compared({0, 4}, coarse, {0, 1, 4}, fine, kNear));
  const auto difference = compared({0, 4}, coarse, {0, 2, 4}, fine, kNear);
  REQUIRE(difference);
  CHECK(difference->time == at_picosecond(2));
  CHECK(difference->a == "2");
  CHECK(difference->b == "1");
  CHECK(difference->count == 1);
}

TEST_CASE("rows of either run are seen") {
  const report::Column coarse = reals({"0", "4"});
  const report::Column bent = reals({"0", "3", "4"});
  CHECK(compared({0, 4}, coarse, {0, 2, 4}, bent, kNear));
  CHECK(compared({0, 2, 4}, bent, {0, 4}, coarse, kNear)->a == "3");
}

TEST_CASE("with a golden B its rows are compared, and no others") {
  CurveTolerances golden = kNear;
  golden.only_rows_of_b = true;
  CHECK_FALSE(compared({0, 2, 4}, reals({"0", "3", "4"}), {0, 4}, reals({"0", "4"}), golden));
  CHECK(compared({0, 2, 4}, reals({"0", "3", "4"}), {0, 4}, reals({"0", "5"}), golden));
}

TEST_CASE("a held signal keeps its value until the next row") {
  CurveTolerances held = kNear;
  held.is_held = true;
  const report::Column a = reals({"0", "1"}, false);
  CHECK_FALSE(compared({0, 4}, a, {0, 3, 4}, reals({"0", "0", "1"}, false), held));
  const auto early = compared({0, 4}, a, {0, 3, 4}, reals({"0", "1", "1"}, false), held);
  REQUIRE(early);
  CHECK(early->time == at_picosecond(3));
  CHECK(early->a == "0");
}

TEST_CASE("a step of a held signal may be as late as the tolerance of time") {
  CurveTolerances held{.time = Duration(2), .is_held = true};
  const report::Column a = reals({"0", "1", "1"}, false);
  CHECK_FALSE(compared({0, 10, 20}, a, {0, 12, 20}, a, held));
  held.time = Duration(1);
  CHECK(compared({0, 10, 20}, a, {0, 12, 20}, a, held));
}

TEST_CASE("a pulse that one run has not is seen, however wide the tolerance of time is") {
  const CurveTolerances held{.time = Duration(5), .is_held = true};
  const report::Column flat = reals({"0", "0"}, false);
  const report::Column pulse = reals({"0", "1", "0", "0"}, false);
  CHECK(compared({0, 100}, flat, {0, 50, 51, 100}, pulse, held)->count == 1);
  CHECK(compared({0, 50, 51, 100}, pulse, {0, 100}, flat, held)->count == 1);
}

TEST_CASE("a steep continuous signal may be as late as the tolerance of time") {
  const report::Column a = reals({"0", "0", "10", "10"});
  const CurveTolerances tolerances{.time = Duration(3), .value = {1e-9, 0}};
  CHECK_FALSE(compared({0, 10, 20, 40}, a, {0, 13, 23, 40}, a, tolerances));
  CHECK(compared({0, 10, 20, 40}, a, {0, 14, 24, 40}, a, tolerances));
}

TEST_CASE("at an event a signal has the values of all rows of the instant") {
  const report::Column jump = reals({"0", "0", "1", "1"});
  const Times with_event{0, 5, 5, 10};
  CHECK_FALSE(compared(with_event, jump, with_event, jump, {}));
  // a run that has only what the event leaves comes to it on a slope
  CHECK_FALSE(
      compared({0, 5, 5, 10}, reals({"0", "1", "1", "1"}), {0, 5, 10}, reals({"0", "1", "1"}), {}));
  const auto other = compared(with_event, jump, with_event, reals({"0", "0", "2", "1"}), {});
  REQUIRE(other);
  CHECK(other->time == at_picosecond(5));
  CHECK(other->b == "2");
}

TEST_CASE("rows beyond the other curve are left out") {
  CHECK_FALSE(compared({0, 4, 8}, reals({"0", "4", "99"}), {0, 4}, reals({"0", "4"}), kNear));
  CHECK_FALSE(compared({}, reals({}), {0}, reals({"1"}), kNear));
}

TEST_CASE("texts have to be within the tolerance of time") {
  const report::Column a = column("a.x", core::ValueType::String, {"idle", "busy"});
  CHECK_FALSE(compared({0, 10}, a, {0, 11, 12},
                       column("a.x", core::ValueType::String, {"idle", "busy", "busy"}),
                       {.time = Duration(1), .is_held = true}));
  const auto late =
      compared({0, 10, 20}, column("a.x", core::ValueType::String, {"idle", "busy", "busy"}),
               {0, 12, 20}, column("a.x", core::ValueType::String, {"idle", "busy", "busy"}),
               {.time = Duration(1), .is_held = true});
  REQUIRE(late);
  CHECK(late->time == at_picosecond(10));
  CHECK(late->a == "busy");
  CHECK(late->b == "idle");
}

TEST_CASE("NaN is equal to NaN, and infinity holds until the next row") {
  CHECK_FALSE(compared({0, 4}, reals({"NaN", "1"}), {0, 4}, reals({"NaN", "1"}), {}));
  CHECK(compared({0, 4}, reals({"NaN", "1"}), {0, 4}, reals({"0", "1"}), kNear));
  CHECK_FALSE(compared({0, 4}, reals({"1", "inf"}), {0, 2, 4}, reals({"1", "1", "inf"}), kNear));
}

TEST_CASE("the nearest value is that of a search of all, for random curves") {
  std::mt19937 random(7);
  const auto pick = [&](int most) { return static_cast<int>(random() % (most + 1)); };
  for (int round = 0; round < 200; ++round) {
    Times times_a, times_b;
    Names fields_a, fields_b;
    for (auto [times, fields] : {std::pair(&times_a, &fields_a), std::pair(&times_b, &fields_b)}) {
      for (int i = 0; i < 12; ++i) {
        times->push_back((times->empty() ? 0 : times->back()) + pick(3));
        fields->push_back(std::to_string(pick(4)));
      }
    }
    const int tolerance = pick(4);
    const report::Column a = reals(fields_a, false), b = reals(fields_b, false);
    const auto value_is_near = [&](std::size_t row) {
      const std::int64_t time = times_a[row];
      bool is_near = time - tolerance > times_b.back() || time + tolerance < times_b.front();
      for (std::size_t k = 0; k < times_b.size(); ++k) {
        const std::int64_t until = k + 1 < times_b.size() ? times_b[k + 1] : times_b[k];
        const bool is_held_at_begin =
            times_b[k] <= time - tolerance && (time - tolerance < until || k + 1 == times_b.size());
        const bool is_within = std::abs(times_b[k] - time) <= tolerance;
        is_near = is_near || ((is_within || is_held_at_begin) && fields_a[row] == fields_b[k]);
      }
      return is_near;
    };
    std::size_t expected = 0;
    for (std::size_t i = 0; i < times_a.size(); ++i) expected += value_is_near(i) ? 0 : 1;
    SignalTally tally("a.x");
    const std::vector<Time> in_a = at_picoseconds(times_a), in_b = at_picoseconds(times_b);
    compare_curves({in_b, b}, {in_a, a},
                   {.time = Duration(tolerance), .is_held = true, .only_rows_of_b = true}, tally);
    const auto difference = tally.difference();
    CHECK((difference ? difference->count : 0) == expected);
  }
}
