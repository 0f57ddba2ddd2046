#include "master/engine/run/stepping/save_interval.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace stride::core;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t kMost = 256;

/// So many stretches of a unit with these costs, of which each n-th step is rolled back; 0: none.
std::size_t interval_after(int stretches, std::chrono::nanoseconds save,
                           std::chrono::nanoseconds step, int rolled_back_each = 0) {
  SaveInterval interval(kMost, true);
  std::size_t steps = 0;
  int made = 0;
  for (int i = 0; i < stretches; ++i) {
    steps = interval.begin_stretch();
    if (interval.is_measured()) interval.add_costs(save, step);
    for (std::size_t k = 0; k < steps; ++k) {
      interval.count_step();
      if (rolled_back_each != 0 && ++made % rolled_back_each == 0) interval.count_rollback();
    }
  }
  return steps;
}

}  // namespace

TEST_CASE("each step is saved until the costs are known") {
  CHECK(interval_after(1, 1ms, 1us) == 1);
  CHECK(interval_after(40, 1ms, 1us) == 1);
}

TEST_CASE("the interval is that of the least cost") {
  for (const int each : {10, 100}) {
    const double best = std::sqrt(2 * 50'000.0 * each / 1'000.0);
    CHECK(static_cast<double>(interval_after(3000, 50us, 1us, each)) ==
          Approx(best).epsilon(0.1).margin(1));
  }
}

TEST_CASE("a save that costs much less than the steps that it spares stays before each step") {
  CHECK(interval_after(1000, 100ns, 100us, 2) == 1);
}

TEST_CASE("a save that costs no more than to note a step stays before each step") {
  CHECK(interval_after(1000, 45ns, 1ns) == 1);
  CHECK(interval_after(1000, 200ns, 1ns) > 1);
}

TEST_CASE("no more is noted than the caches have room for, unless saves cost more") {
  const auto chosen = [](std::chrono::nanoseconds save) {
    SaveInterval interval(kMost, true);
    interval.set_near(4);
    std::size_t steps = 0;
    for (int i = 0; i < 1000; ++i) {
      steps = interval.begin_stretch();
      if (interval.is_measured()) interval.add_costs(save, 10ns);
      interval.count_step();
    }
    return steps;
  };
  CHECK(chosen(500ns) == 4);
  CHECK(chosen(100us) > 100);
}

TEST_CASE("where nothing is rolled back the interval grows, to the limit at most") {
  CHECK(interval_after(2000, 1us, 1us) > 50);
  CHECK(interval_after(2000, 1ms, 1us) == kMost);
}

TEST_CASE("an interruption of the machine is not taken for a cost") {
  SaveInterval disturbed(kMost, true);
  SaveInterval calm(kMost, true);
  std::size_t with = 0;
  std::size_t without = 0;
  for (int i = 0; i < 160; ++i) {
    with = disturbed.begin_stretch();
    without = calm.begin_stretch();
    disturbed.count_step();
    calm.count_step();
    if (disturbed.is_measured()) disturbed.add_costs(i == 159 ? 100ms : 1us, 1us);
    if (calm.is_measured()) calm.add_costs(1us, 1us);
  }
  with = disturbed.begin_stretch();
  without = calm.begin_stretch();
  CHECK(with < 2 * without);
}

TEST_CASE("an interval that does not adapt is the greatest one, and a limit lowers it") {
  SaveInterval interval(7, false);
  CHECK(interval.begin_stretch() == 7);
  CHECK_FALSE(interval.is_measured());
  interval.limit(3);
  CHECK(interval.begin_stretch() == 3);
  interval.limit(0);
  CHECK(interval.begin_stretch() == 1);
  interval.limit(5);
  CHECK(interval.most() == 1);
}

TEST_CASE("a save is compared with what it costs to note steps, where costs are measured") {
  SaveInterval interval(7, true), other(7, false);
  for (SaveInterval* const each : {&interval, &other}) each->add_costs(1us, 1us);
  CHECK(interval.is_save_cheaper(25));
  CHECK_FALSE(interval.is_save_cheaper(15));
  CHECK_FALSE(other.is_save_cheaper(1000));
}
