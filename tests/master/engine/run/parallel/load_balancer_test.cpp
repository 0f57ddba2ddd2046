#include "master/engine/run/parallel/load_balancer.h"

#include <numeric>

#include <catch2/catch.hpp>

using namespace stride::core;
using namespace std::chrono_literals;
using Nanoseconds = std::chrono::nanoseconds;
using Shares = std::vector<ThreadShare>;

namespace {

std::vector<std::size_t> positions(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

Shares share(std::vector<Nanoseconds> costs, std::size_t threads,
             std::vector<char> main_only = {}) {
  main_only.resize(costs.size());
  return balance_load(positions(costs.size()), costs, main_only, threads);
}

/// A split whose units cost what the test says, on threads that are as good as it says.
struct Bench {
  std::vector<Nanoseconds> costs;
  Nanoseconds hand_over = 500ns;
  double speedup = 2;
  int hand_overs = 0;
  LoadBalancer split;

  explicit Bench(std::vector<Nanoseconds> costs_, std::size_t threads = 2, bool always = false)
      : costs(std::move(costs_)), split([&] {
          LoadBalancer::Plan plan;
          plan.stages = {positions(costs.size())};
          plan.main_only.resize(costs.size());
          plan.threads = threads;
          plan.always = always;
          plan.hand_over = [this] { return ++hand_overs, hand_over; };
          return plan;
        }()) {}

  /// Makes communication steps, and returns how many of them were parallel.
  std::size_t steps(std::size_t count) {
    const Nanoseconds serial = std::accumulate(costs.begin(), costs.end(), 0ns);
    std::size_t parallel = 0;
    for (std::size_t i = 0; i < count; ++i) {
      parallel += split.is_parallel();
      if (split.is_measuring()) {
        for (std::size_t k = 0; k < costs.size(); ++k) split.record_cost(k, costs[k]);
      }
      split.end_step(split.is_parallel()
                         ? std::chrono::duration_cast<Nanoseconds>(
                               std::chrono::duration<double, std::nano>(serial) / speedup)
                         : serial);
    }
    return parallel;
  }
};

constexpr std::size_t kMeasured = LoadBalancer::kMeasured;

}  // namespace

TEST_CASE("the most expensive units come first, each on the thread with the smallest load") {
  CHECK(share({7us, 6us, 5us, 4us}, 2) == Shares{{0, 3}, {1, 2}});
  CHECK(share({1us, 1us, 1us, 1us, 4us}, 2) == Shares{{4}, {0, 1, 2, 3}});
  CHECK(share({3us, 2us, 2us}, 3) == Shares{{0}, {1}, {2}});
}

TEST_CASE("equal costs are distributed in turn; there are no more shares than units") {
  CHECK(share({1us, 1us, 1us, 1us, 1us}, 2) == Shares{{0, 2, 4}, {1, 3}});
  CHECK(share({1us, 1us}, 8) == Shares{{0}, {1}});
  CHECK(share({1us}, 2) == Shares{{0}});
  CHECK(share({}, 2).empty());
}

TEST_CASE("units that are bound to the first thread go there, the others to the rest") {
  CHECK(share({2us, 9us, 2us, 9us}, 2, {1, 0, 1, 0}) == Shares{{0, 2, 3}, {1}});
  CHECK(share({2us, 9us}, 2, {1, 1}) == Shares{{0, 1}});
}

TEST_CASE("expensive units go on threads once they have been measured and threads are faster") {
  Bench bench({50us, 50us});
  CHECK(bench.steps(kMeasured) == 0);
  CHECK(bench.hand_overs == 1);
  // turns of 2.5 ms: 25 steps of 0.1 ms and 50 of 0.05 ms, four of each
  CHECK(bench.steps(4 * (25 + 50)) == 4 * 50);
  CHECK(bench.steps(10'000) == 10'000);
  REQUIRE(bench.split.shares(0).size() == 2);
  CHECK(bench.split.shares(0)[0] == ThreadShare{0});
  CHECK(bench.split.shares(0)[1] == ThreadShare{1});
}

TEST_CASE("the comparison is repeated, and threads lose it where other programs use the cores") {
  Bench bench({50us, 50us});
  bench.steps(1000);
  CHECK(bench.split.is_parallel());
  bench.speedup = 0.1;
  bench.steps(30'000);
  CHECK_FALSE(bench.split.is_parallel());
  CHECK(bench.steps(10'000) < 200);  // races only
}

TEST_CASE("units too cheap for any hand-over start no threads") {
  Bench bench({100ns, 100ns, 100ns, 100ns});
  CHECK(bench.steps(100'000) == 0);
  CHECK(bench.hand_overs == 0);
  CHECK(bench.split.shares(0).empty());
}

TEST_CASE("units whose hand-over costs more than it gains stay on one thread") {
  Bench bench({50us, 50us});
  bench.hand_over = 60us;
  CHECK(bench.steps(1000) == 0);
  CHECK(bench.hand_overs == 1);
}

TEST_CASE("one expensive unit among cheap ones starts no threads") {
  Bench bench({500us, 100ns, 100ns});
  CHECK(bench.steps(1000) == 0);
}

TEST_CASE("threads that are not faster are given up, and tried less and less often") {
  Bench bench({50us, 50us});
  bench.speedup = 1.01;  // as for units that wait for each other's lock
  const std::size_t first = bench.steps(400'000);
  const std::size_t second = bench.steps(400'000);
  CHECK(first > 0);
  CHECK(first < 4'000);
  CHECK(second < first / 2);
}

TEST_CASE("the decision follows the costs") {
  Bench bench({100ns, 100ns});
  CHECK(bench.steps(1000) == 0);
  bench.costs = {40us, 40us};
  bench.steps(5'000);
  CHECK(bench.split.is_parallel());
  bench.costs = {100ns, 100ns};
  bench.steps(50'000);
  CHECK_FALSE(bench.split.is_parallel());
}

TEST_CASE("with long steps a few are enough for the decision") {
  Bench bench({200ms, 200ms});
  CHECK(bench.steps(3) == 0);
  CHECK(bench.steps(LoadBalancer::kTurns) == LoadBalancer::kTurns / 2);
  CHECK(bench.steps(100) == 100);
}

TEST_CASE("with one thread or one unit there is nothing to decide") {
  CHECK_FALSE(Bench({50us, 50us}, 1).split.is_deciding());
  CHECK_FALSE(Bench({50us}, 4).split.is_deciding());
  CHECK_FALSE(Bench({}, 4).split.is_deciding());
}

TEST_CASE("a forced split is there from the first step on, without a measurement") {
  Bench bench({1ns, 1ns, 1ns}, 2, true);
  CHECK_FALSE(bench.split.is_deciding());
  CHECK(bench.split.is_parallel());
  REQUIRE(bench.split.shares(0).size() == 2);
  CHECK(bench.split.shares(0)[0] == ThreadShare{0, 2});
  CHECK(bench.split.shares(0)[1] == ThreadShare{1});
  CHECK(bench.steps(100'000) == 100'000);
  CHECK(bench.hand_overs == 0);
}

TEST_CASE("each stage is shared out for itself") {
  LoadBalancer::Plan plan;
  plan.stages = {{0, 1}, {2}, {3, 4}};
  plan.main_only.resize(5);
  plan.threads = 2;
  plan.always = true;
  const LoadBalancer split(plan);
  CHECK(split.shares(0).size() == 2);
  CHECK(split.shares(1).empty());
  REQUIRE(split.shares(2).size() == 2);
  CHECK(split.shares(2)[1] == ThreadShare{4});
}
