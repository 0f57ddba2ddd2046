#include "master/study/verify/step_outcome.h"

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::verify;

namespace {

using Steps = std::vector<StepOutcome>;

constexpr Time kStart{};
constexpr Duration kSize = std::chrono::milliseconds(1);
constexpr Time kEnd = kStart + kSize;
constexpr Duration kRoundingError(1);

std::string step_difference(const Steps& expected, const Steps& seen) {
  std::string note;
  const auto differs = difference_beyond_rounding(expected, seen, "here", "there", note);
  CHECK((!differs || note.empty()));
  return differs ? *differs : "note: " + note;
}

}  // namespace

TEST_CASE("steps that end alike do not differ") {
  CHECK(step_difference({{kStart, kEnd}, {kEnd, kEnd + kSize}},
                        {{kStart, kEnd}, {kEnd, kEnd + kSize}}) == "note: ");
}

TEST_CASE("the first step that ends otherwise is named, with both ends") {
  CHECK(step_difference({{kStart, kEnd}, {kEnd, kEnd + kSize}},
                        {{kStart, kEnd}, {kEnd, kEnd + kSize / 2}}) ==
        "the step from 0.001 s ends at 0.002 s here, and ends at 0.0015 s there");
  CHECK(step_difference({{kStart, kStart, true}}, {{kStart, kEnd}}) ==
        "the step from 0 s is rejected here, and ends at 0.001 s there");
  CHECK(step_difference({{kStart, kEnd, false, true}}, {{kStart, kEnd, false, false, true}}) ==
        "the step from 0 s ends at 0.001 s with an event here, and ends at 0.001 s and ends the "
        "run there");
  CHECK(step_difference({{kStart, kEnd}}, {{kStart, kEnd}, {kEnd, kEnd + kSize}}) ==
        "it makes 1 step here, and 2 there");
}

TEST_CASE("an end that is off by rounding is a note, unless the step ends in another way") {
  CHECK(step_difference({{kStart, kEnd}}, {{kStart, kEnd + kRoundingError}}) ==
        "note: the step from 0 s ends at 0.001 s here, and ends at 0.001000000001 s there");
  CHECK(step_difference({{kStart, kEnd}}, {{kStart, kEnd + 2 * kRoundingError}})
            .rfind("the step", 0) == 0);
  CHECK(step_difference({{kStart, kEnd}}, {{kStart, kEnd + kRoundingError, false, true}})
            .rfind("the step", 0) == 0);
}
