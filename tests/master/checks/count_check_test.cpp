#include "master/checks/count_check.h"

#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/checks/support.h"

using namespace stride;
using namespace stride::checks;

namespace {

using Limit = std::optional<std::uint64_t>;

/// Messages at 1, 2, 3 and 4 ms, with others between, and communication points there and at 5 ms.
core::Verdict counted(Limit min, Limit max, Window of = {}, const Ending& ending = ended(5)) {
  const Definition definition{Kind::Count, "frames", "", of, {}, CountDemand{{0, 3}, min, max}};
  CountCheck check(definition);
  check.on_point(at(0));
  for (int time = 1; time <= 4; ++time) {
    check.on_message(message(time, 3));
    check.on_message(message(time, 4));
    check.on_point(at(time));
  }
  check.on_point(at(5));
  return check.verdict(ending);
}

}  // namespace

TEST_CASE("messages of the variable are counted, and no others") {
  const auto verdict = counted(4, 4);
  CHECK((verdict.passed == true && verdict.text == "4 messages" && verdict.kind == "count"));
  CHECK(counted(1, 1, window(4, {})).text == "1 message");
}

TEST_CASE("one too many fails where it comes, also if the run breaks off") {
  for (const Ending& ending : {ended(5), broke(5)}) {
    const auto verdict = counted({}, 2, {}, ending);
    CHECK((verdict.passed == false && verdict.time == at(3)));
    CHECK(verdict.text == "message number 3; expected 2 at most");
  }
}

TEST_CASE("too few fail where the interval ends") {
  const auto verdict = counted(5, {});
  CHECK((verdict.passed == false && verdict.time == at(5)));
  CHECK(verdict.text == "4 messages; expected 5 at least");
  CHECK(counted(3, {}, window(0, 2)).time == at(2));
}

TEST_CASE("the interval's ends belong to it") {
  CHECK(counted(3, 3, window(2, 4)).passed == true);
  CHECK(counted(0, 0, window(5, {})).passed == true);
}

TEST_CASE("a run that breaks off leaves open what could still come") {
  CHECK_FALSE(counted(5, {}, {}, broke(5)).passed);
  CHECK_FALSE(counted({}, 4, {}, broke(5)).passed);
  CHECK(counted(4, {}, {}, broke(5)).passed == true);
  CHECK(counted({}, 4, window({}, 5), broke(5)).passed == true);
  CHECK_FALSE(counted({}, 4, window({}, 6), ended(5)).passed);
}
