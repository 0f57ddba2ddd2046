#include "master/study/compare/signals/signal_tally.h"

#include <limits>

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;

TEST_CASE("without differences there is none") { CHECK_FALSE(SignalTally("a.x").difference()); }

TEST_CASE("the first difference is that of the least time, in whatever order they come") {
  SignalTally tally("a.x");
  tally.add(Time(2 * kSecond), 1, 2);
  tally.add(Time(kSecond), 0.1, 0.25);
  tally.add(Time(3 * kSecond), 5, 6);
  const auto difference = tally.difference();
  REQUIRE(difference);
  CHECK(difference->kind == Kind::Signal);
  CHECK(difference->name == "a.x");
  CHECK(difference->time == Time(kSecond));
  CHECK(difference->a == "0.1");
  CHECK(difference->b == "0.25");
  CHECK(difference->count == 3);
}

TEST_CASE("the greatest differences, absolute and relative to B, have their places and values") {
  SignalTally tally("a.x");
  tally.add(Time(kSecond), 1, 0.5);
  tally.add(Time(2 * kSecond), 104, 100);
  tally.add(Time(3 * kSecond), 3, 0);  // nothing is relative to zero
  const auto difference = tally.difference();
  REQUIRE(difference);
  REQUIRE(difference->absolute);
  CHECK(difference->absolute->value == 4);
  CHECK(difference->absolute->time == Time(2 * kSecond));
  CHECK(difference->absolute->a == "104");
  CHECK(difference->absolute->b == "100");
  REQUIRE(difference->relative);
  CHECK(difference->relative->value == 1);
  CHECK(difference->relative->time == Time(kSecond));
}

TEST_CASE("what is not finite has no distance") {
  SignalTally tally("a.x");
  tally.add(Time(kSecond), std::numeric_limits<double>::quiet_NaN(), 1);
  tally.add(Time(2 * kSecond), 1, std::numeric_limits<double>::infinity());
  const auto difference = tally.difference();
  REQUIRE(difference);
  CHECK(difference->count == 2);
  CHECK(difference->a == "nan");
  CHECK_FALSE(difference->absolute);
  CHECK_FALSE(difference->relative);
}

TEST_CASE("Booleans and texts are told apart, and have no distance") {
  SignalTally booleans("a.on", true);
  booleans.add(Time(kSecond), 1, 0);
  CHECK(booleans.difference()->a == "true");
  CHECK(booleans.difference()->b == "false");
  CHECK_FALSE(booleans.difference()->absolute);
  SignalTally texts("a.mode");
  texts.add(Time(kSecond), "idle", "busy");
  texts.add(Time(2 * kSecond), "idle", "broken");
  CHECK(texts.difference()->b == "busy");
  CHECK(texts.difference()->count == 2);
}
