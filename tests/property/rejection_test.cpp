// What a unit that rejects steps may change for the others, and what not. A rejection shortens the
// step of all, so there are more communication points: units that feed each other continuously
// exchange values more often, and their values differ by the error of that exchange. Beyond that
// nothing may change:
//
// - the communication points of the run without rejections are still there;
// - what happens at events, their instants and messages, is the same to the bit;
// - values that are coupled through events only are the same at common instants, to rounding.
#include <cmath>

#include <catch2/catch.hpp>

#include "master/base/time_text.h"
#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kRejectionSystems = kSanitized ? 5 : 50;
constexpr Time kRejectionStop{100ms};

/// Two units that reject steps hear of a random system but feed nothing; for comparison they reject
/// none.
Assembly with_rejecters(unsigned seed, Wiring wiring, bool rejects) {
  return rejects ? stride::tests::with_rejecters(seed, wiring, "0.00003", "0.001")
                 : stride::tests::with_rejecters(seed, wiring, "1", "1");
}

/// What depends on how often it is stepped.
bool counts_steps(const std::string& name) {
  return name.size() > 6 && name.compare(name.size() - 6, 6, ".steps") == 0;
}
bool belongs_to_rejecter(const std::string& name) { return name[0] == 'r'; }

struct Comparison {
  Results plain;
  Results rejecting;
  Comparison(unsigned seed, Wiring wiring)
      : plain(run(with_rejecters(seed, wiring, false), 1ms, kRejectionStop)),
        rejecting(run(with_rejecters(seed, wiring, true), 1ms, kRejectionStop)) {
    CHECK(plain.units.at("r1").rejections == 0);
    CHECK(rejecting.units.at("r1").rejections > 50);
    CHECK(rejecting.units.at("r2").rejections > 50);
  }
};

}  // namespace

TEST_CASE("rejections change no value that is coupled through events only") {
  std::size_t compared = 0;
  for (unsigned seed = 0; seed < kRejectionSystems; ++seed) {
    INFO("seed " << seed << "\n" << with_rejecters(seed, Wiring::EventsOnly, true).text());
    const Comparison c(seed, Wiring::EventsOnly);
    // another rejecter of the system draws its limits by its steps, so its rejections differ, too
    for (const auto& [time, row] : c.plain.values) {
      const auto other = c.rejecting.values.find(time);
      if (other == c.rejecting.values.end()) continue;
      ++compared;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const std::string& name = c.plain.names[i];
        if (counts_steps(name) || belongs_to_rejecter(name)) continue;
        if (other->second[i] == Approx(row[i]).epsilon(1e-11).margin(1e-12)) continue;
        FAIL(name << " at " << core::to_text(time) << " s: " << row[i] << " became "
                  << other->second[i]);
      }
    }
  }
  CHECK(compared > 100 * kRejectionSystems);
}

TEST_CASE("rejections change no event, and no communication point is missing") {
  const Wiring wiring = GENERATE(Wiring::EventsOnly, Wiring::Continuous);
  for (unsigned seed = 0; seed < kRejectionSystems; ++seed) {
    INFO("seed " << seed << "\n" << with_rejecters(seed, wiring, true).text());
    const Comparison c(seed, wiring);
    const bool same_events = c.plain.events == c.rejecting.events;
    CHECK(same_events);
    CHECK(c.rejecting.values.size() > c.plain.values.size());
    for (Time grid{}; grid <= kRejectionStop; grid += 1ms)
      CHECK(c.rejecting.values.count(grid) == 1);
  }
}

TEST_CASE("a unit that rejects and cannot go back itself changes no more than one that can") {
  const bool can_go_back = GENERATE(false, true);
  const std::string unit = can_go_back ? "rejecter" : "rejecter_without_state";
  const auto system = [&](const char* limit) {
    return Assembly()
        .add("ball", "bouncing_ball", {{"start_height", "0.001"}})
        .add("reference", "linear")
        .add("r", unit, {{"shortest", limit}, {"longest", limit}})
        .wire("reference.x", "r.u");
  };
  const Results plain = run(system("1"), 1ms, kRejectionStop);
  const Results rejecting = run(system("0.0003"), 1ms, kRejectionStop);
  CHECK(rejecting.units.at("r").rejections > 100);
  CHECK(rejecting.units.at("reference").saves == 0);  // it follows
  CHECK(rejecting.events == plain.events);
  for (const char* name : {"reference.x", "reference.y", "ball.h", "ball.v"}) {
    CHECK(rejecting.value(kRejectionStop, name) ==
          Approx(plain.value(kRejectionStop, name)).epsilon(1e-12));
  }
  // x over steps of at most 0.25 ms instead of 1 ms: the error of its exchange is a quarter
  const double exact = [&] {  // the integral of exp(-d t) cos(w t), d = 0.5, w = 10
    const double t = 0.1, d = 0.5, w = 10;
    return (d + std::exp(-d * t) * (w * std::sin(w * t) - d * std::cos(w * t))) / (d * d + w * w);
  }();
  const double error = std::abs(plain.value(kRejectionStop, "r.y") - exact);
  CHECK(error > 1e-5);
  CHECK(std::abs(rejecting.value(kRejectionStop, "r.y") - exact) < 0.3 * error);
}
