#include "master/study/compare/criteria/selection.h"

#include "tests/master/study/compare/support.h"

using namespace stride::compare;
using Catch::Contains;

TEST_CASE("without patterns all signals are compared") { CHECK(Selection({}, {}).has("a.x")); }

TEST_CASE("only the matching ones are, but for those that are ignored") {
  const Selection selection({"a.*", "b.y"}, {"a.noise"});
  CHECK(selection.has("a.x"));
  CHECK(selection.has("b.y"));
  CHECK_FALSE(selection.has("b.x"));
  CHECK_FALSE(selection.has("a.noise"));
}

TEST_CASE("the name of an array means its elements, and brackets in a name are no set") {
  CHECK_FALSE(Selection({}, {"a.v"}).has("a.v[2]"));
  CHECK_FALSE(Selection({}, {"a.v[2]"}).has("a.v[2]"));
  CHECK(Selection({}, {"a.v[2]"}).has("a.v[1]"));
  CHECK(Selection({}, {"a.v"}).has("a.velocity"));
}

TEST_CASE("a pattern that means nothing is refused, with what was meant") {
  const Names names{"tank.level", "tank.inflow"};
  CHECK_NOTHROW(Selection({"tank.*"}, {"tank.level"}).require_use(names));
  CHECK_THAT(error_of([&] { Selection({"tank.levle"}, {}).require_use(names); }),
             Contains("--only 'tank.levle' is no signal and no message of either run") &&
                 Contains("did you mean 'tank.level'?"));
  CHECK_THAT(error_of([&] { Selection({}, {"pipe.*"}).require_use(names); }),
             Contains("--ignore 'pipe.*'"));
}
