#include "master/observe/coverage/demand.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

Report half() {
  Device device(
      group_of({values_of("level", 0, equal_ranges(0, 4, 4, false, core::ValueType::Float64)),
                values_of("lamp", 1, truths())}));
  device.point(0, 0.5);
  device.point(1, 1.5);
  device.point(2, 1.5);
  return device.coverage.report("s");
}

core::Verdict verdict_of(std::optional<std::size_t> point, double min, bool is_complete = true) {
  return verdicts(std::vector{Demand{"d", "d", 0, point, min}}, half(), at(2), is_complete).at(0);
}

}  // namespace

TEST_CASE("a demand is met where the percentage is enough, and has a margin") {
  const core::Verdict passed = verdict_of(0, 40);
  CHECK(passed.passed == true);
  CHECK(passed.kind == "covered");
  CHECK(passed.text == "50 %: 2 of 4 bins; not [2, 3), [3, 4]");
  CHECK((passed.margin->value == 10 && passed.margin->unit == "percentage points"));
  CHECK(verdict_of(0, 50).passed == true);
  const core::Verdict failed = verdict_of({}, 60);
  CHECK(failed.passed == false);
  CHECK(failed.time == at(2));
  CHECK(failed.margin->value == -10);
  CHECK(failed.text == "50 %: 0 of 2 points as a whole; not level, lamp; expected 60 % at least");
}

TEST_CASE("a run that broke off may have met the demand already, and else could have") {
  CHECK(verdict_of(0, 40, false).passed == true);
  CHECK_FALSE(verdict_of(0, 60, false).passed);
  CHECK_FALSE(verdict_of(0, 60, false).margin);
}

TEST_CASE("a demand of what has no bin that counts is undecided") {
  PointDefinition level =
      values_of("level", 0, equal_ranges(0, 4, 2, false, core::ValueType::Float64));
  for (DeclaredBin& bin : level.bins) bin.is_ignored = true;
  const Device device(group_of({level}));
  for (const std::optional<std::size_t> point : {std::optional<std::size_t>(0), {}}) {
    const auto verdict = verdicts(std::vector{Demand{"d", "d", 0, point, 0}},
                                  device.coverage.report("s"), at(2), true);
    CHECK_FALSE(verdict.at(0).passed);
    CHECK(verdict.at(0).text == "there is no bin that counts");
  }
}

TEST_CASE("a percentage is never rounded up") {
  CHECK(percentage_text(99.999) == "99.99 %");
  CHECK(percentage_text(100) == "100 %");
  CHECK(percentage_text(200.0 / 3) == "66.66 %");
  CHECK(percentage_text({}) == "-");
}
