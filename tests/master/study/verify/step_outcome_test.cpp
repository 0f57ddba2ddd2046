#include "master/study/verify/step_outcome.h"

#include <catch2/catch.hpp>

using namespace stride::verify;

namespace {

using Steps = std::vector<StepOutcome>;

constexpr std::int64_t kStep = 1'000'000'000;  // 1 ms

std::string step_difference(const Steps& expected, const Steps& seen) {
  std::string note;
  const auto differs = difference_beyond_rounding(expected, seen, "here", "there", note);
  CHECK((!differs || note.empty()));
  return differs ? *differs : "note: " + note;
}

}  // namespace

TEST_CASE("steps that end alike do not differ") {
  CHECK(step_difference({{0, kStep}, {kStep, 2 * kStep}}, {{0, kStep}, {kStep, 2 * kStep}}) ==
        "note: ");
}

TEST_CASE("the first step that ends otherwise is named, with both ends") {
  CHECK(step_difference({{0, kStep}, {kStep, 2 * kStep}}, {{0, kStep}, {kStep, 3 * kStep / 2}}) ==
        "the step from 0.001 s ends at 0.002 s here, and ends at 0.0015 s there");
  CHECK(step_difference({{0, 0, true}}, {{0, kStep}}) ==
        "the step from 0 s is rejected here, and ends at 0.001 s there");
  CHECK(step_difference({{0, kStep, false, true}}, {{0, kStep, false, false, true}}) ==
        "the step from 0 s ends at 0.001 s with an event here, and ends at 0.001 s and ends the "
        "run there");
  CHECK(step_difference({{0, kStep}}, {{0, kStep}, {kStep, 2 * kStep}}) ==
        "it makes 1 step here, and 2 there");
}

TEST_CASE("an end that is off by rounding is a note, unless the step ends in another way") {
  CHECK(step_difference({{0, kStep}}, {{0, kStep + 1}}) ==
        "note: the step from 0 s ends at 0.001 s here, and ends at 0.001000000001 s there");
  CHECK(step_difference({{0, kStep}}, {{0, kStep + 2}}).rfind("the step", 0) == 0);
  CHECK(step_difference({{0, kStep}}, {{0, kStep + 1, false, true}}).rfind("the step", 0) == 0);
}
