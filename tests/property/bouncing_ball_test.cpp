// Impacts against the closed form: exact, whatever the communication steps and the neighbours are.
#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "tests/property/assembly.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

constexpr double kGravity = 9.81;
constexpr double kHeight = 1;
constexpr double kRestitution = 0.8;
constexpr double kRestSpeed = 0.01;

/// With t0 = sqrt(2 h / g) the n-th impact is at t0 (1 + 2 e (1 - e^(n-1)) / (1 - e)), and the
/// rebound has the speed e^n g t0.
double impact_time(int n) {
  const double t0 = std::sqrt(2 * kHeight / kGravity);
  return t0 * (1 + 2 * kRestitution * (1 - std::pow(kRestitution, n - 1)) / (1 - kRestitution));
}
int impacts_to_rest() {
  const double speed = std::sqrt(2 * kHeight * kGravity);
  return static_cast<int>(std::ceil(std::log(kRestSpeed / speed) / std::log(kRestitution)));
}

/// The instants of the messages that the ball has sent, as events.csv gives them.
std::vector<double> sent_at(const Results& results, const std::string& ball) {
  std::vector<double> times;
  for (const std::string& row : results.event_rows()) {
    if (row.find("," + ball + ",impact.number,sent,") == std::string::npos) continue;
    times.push_back(std::stod(row));
  }
  std::sort(times.begin(), times.end());
  return times;
}

Assembly ball() {
  return Assembly()
      .add("ball", "bouncing_ball")
      .add("listener", "listener")
      .wire_message("ball.impact", "listener.message");
}

}  // namespace

TEST_CASE("a bouncing ball's impacts are those of the closed form") {
  const Duration step =
      GENERATE(Duration(1ms), Duration(10ms), Duration(700us), Duration(1s), Duration(333'333'333));
  const bool has_neighbours = GENERATE(false, true);
  Assembly system = ball();
  if (has_neighbours) {  // which are rolled back, reject, stop elsewhere
    system.add("linear", "linear").wire("ball.h", "linear.u");
    system.add("rejecter", "rejecter", {{"shortest", "0.0003"}, {"longest", "0.02"}});
    system.add("early", "early", {{"instants", "0.1 0.4515 0.9 1.3 2.2 2.3 3 3.9"}});
    system.add("ticker", "ticker", {{"period", "0.0123"}, {"announces", "0"}});
  }
  const Time stop{5s};
  const Results results = run(system, step, stop);
  const std::vector<double> times = sent_at(results, "ball");
  REQUIRE(times.size() == static_cast<std::size_t>(impacts_to_rest()));
  for (int n = 1; n <= impacts_to_rest(); ++n) {
    CAPTURE(n);
    CHECK(std::abs(times[static_cast<std::size_t>(n) - 1] - impact_time(n)) < 1e-9);
  }
  CHECK(results.value(stop, "listener.received") == impacts_to_rest());
  CHECK(results.value(stop, "listener.misplaced") == 0);
  CHECK(results.value(stop, "listener.out_of_turn") == 0);
  CHECK(results.value(stop, "ball.resting") == 1);
  CHECK(results.value(stop, "ball.h") == 0);
  CHECK(results.units.at("ball").early_returns > 0);
  if (has_neighbours) CHECK(results.units.at("linear").saves == 0);  // it follows
}

TEST_CASE("after the last bounce the ball requests no more communication points") {
  const Results results = run(ball(), 1s, Time(20s));
  const auto impacts = static_cast<std::uint64_t>(impacts_to_rest());
  CHECK(results.statistics.communication_steps == impacts + 20);
}

TEST_CASE("two balls that meet the ground at one instant share a communication point") {
  Assembly system = ball();
  system.add("twin", "bouncing_ball");
  const Results alone = run(ball(), 1s, Time(5s));
  const Results both = run(system, 1s, Time(5s));
  CHECK(sent_at(both, "twin") == sent_at(both, "ball"));
  CHECK(both.statistics.communication_steps == alone.statistics.communication_steps);
}
