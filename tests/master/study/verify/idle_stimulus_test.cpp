#include "master/study/verify/idle_stimulus.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "master/study/verify/idle_comparison.h"
#include "tests/at.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::verify;
using Catch::Matchers::Contains;
using stride::tests::at;
using stride::tests::at_picosecond;

namespace {

constexpr std::size_t kPoints = 300;
constexpr double kDeadband = 1e-5;  // of the idler's inflow

TestedUnit idler() { return TestedUnit(VerifyRequest{.file = tests::test_fmu("idler")}); }

/// Of the only number with a deadband.
std::vector<double> course(const IdleStimulus& stimulus) {
  std::vector<double> values;
  for (std::size_t k = 0; k < kPoints; ++k) {
    values.push_back(core::real(stimulus.value(stimulus.inputs().front(), k), 0));
  }
  return values;
}

std::size_t count_beyond(const std::vector<double>& values, double distance) {
  std::size_t count = 0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    count += std::abs(values[k] - values[k - 1]) > distance ? 1U : 0U;
  }
  return count;
}

/// A recording with one event, and of each point the outputs level and reports and the promises.
Recording recording(std::int64_t event, const std::string& level, const std::string& reports) {
  Recording made;
  made.rows.push_back({at_picosecond(event), {"report"}, true});
  made.rows.push_back({at(0.001), {level, reports, "2"}, false});
  return made;
}

}  // namespace

TEST_CASE("between two jumps inputs stay, or move within their deadbands") {
  const TestedUnit tested = idler();
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  const Jump jump = GENERATE(Jump::Near, Jump::Far);
  const auto still = course(IdleStimulus(tested, seed, Wander::Still, jump));
  const auto moving = course(IdleStimulus(tested, seed, Wander::WithinDeadbands, jump));
  const std::size_t jumps = count_beyond(still, 0);
  CHECK(jumps >= 1);
  CHECK(jumps < kPoints / 2);
  const std::size_t beyond = count_beyond(still, kDeadband);
  CHECK(10 * beyond > 9 * jumps);  // a jump is as far as luck has it
  CHECK(count_beyond(moving, 0) > kPoints / 2);
  CHECK(count_beyond(moving, kDeadband) == beyond);
  CHECK(still.front() == 1);  // the start value
}

TEST_CASE("a quiet stimulus jumps once or never, and nothing ticks") {
  const TestedUnit tested = idler();
  const auto [jump, jumps] =
      GENERATE(table<Jump, std::size_t>({{Jump::Once, 1}, {Jump::Never, 0}}));
  const IdleStimulus quiet(tested, 5, Wander::Still, jump);
  CHECK(count_beyond(course(quiet), 0) == jumps);
  for (std::size_t k = 0; k < kPoints; ++k) CHECK_FALSE(quiet.ticks_at(k));
}

TEST_CASE("a late stimulus jumps in the last tenth of the run, with an event") {
  const TestedUnit tested = idler();
  const IdleStimulus late(tested, 5, Wander::Still, Jump::Late);
  const std::size_t point = tested.steps() - tested.steps() / 10;
  const std::vector<double> values = course(late);
  CHECK(count_beyond(values, 0) == 1);
  CHECK(values[point] != values[point - 1]);
  for (std::size_t k = 0; k < tested.steps(); ++k) CHECK(late.ticks_at(k) == (k == point));
}

TEST_CASE("each input jumps where there is one jump, whatever its type and the seed") {
  const TestedUnit tested(VerifyRequest{.file = tests::test_fmu("types")});
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const IdleStimulus late(tested, seed, Wander::Still, Jump::Late);
    REQUIRE(late.inputs().size() > 3);
    for (const auto& input : late.inputs()) {
      INFO(tested.description().variables[input.variable].name << ", seed " << seed);
      CHECK(late.value(input, 0) != late.value(input, tested.steps()));
    }
  }
}

TEST_CASE("an input within its deadband rests at times") {
  const TestedUnit tested = idler();
  const auto moving = course(IdleStimulus(tested, 1, Wander::WithinDeadbands, Jump::Near));
  std::size_t longest = 0, rest = 0;
  for (std::size_t k = 1; k < moving.size(); ++k) {
    rest = moving[k] == moving[k - 1] ? rest + 1 : 0;
    longest = std::max(longest, rest);
  }
  CHECK(longest >= 5);
}

TEST_CASE("a stimulus is a function of the seed and the point") {
  const TestedUnit tested = idler();
  const auto make = [&](std::uint64_t seed) {
    return course(IdleStimulus(tested, seed, Wander::WithinDeadbands, Jump::Far));
  };
  CHECK(make(7) == make(7));
  CHECK(make(7) != make(8));
}

TEST_CASE("two runs differ by what promises do not allow") {
  const TestedUnit tested = idler();
  const Recording full = recording(5, "1", "3");
  const auto difference = [&](const Recording& skipping, Wander wander = Wander::Still) {
    return idle_difference(tested, full, skipping, wander).value_or("none");
  };
  CHECK(difference(full) == "none");
  CHECK(difference(recording(5, "1.0019", "3")) == "none");  // two promises of 1e-3 each
  CHECK_THAT(difference(recording(5, "1.0021", "3")),
             Contains("at 0.001 s 'level' is 1.0021, and 1 without skipping, with a tolerance"));
  CHECK_THAT(difference(recording(5, "1", "4")), Contains("'reports' is 4, and 3 without"));
  CHECK_THAT(difference(recording(6, "1", "3")), Contains("the event report is at"));
  CHECK(difference(recording(6, "1", "3"), Wander::WithinDeadbands) == "none");
  Recording missing = full;
  missing.rows.erase(missing.rows.begin());
  CHECK_THAT(difference(missing), Contains("there is without skipping only the event report"));
}
