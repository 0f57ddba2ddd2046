#include "master/algorithm/parallel/load_balancer.h"

#include <algorithm>
#include <utility>

namespace stride::core {
namespace {

using Nanoseconds = LoadBalancer::Nanoseconds;

/// Less than this no hand-over costs, so for a smaller gain threads are not even started.
constexpr Nanoseconds kLeastHandOver{300};
/// How far above the cost of the hand-over the promised gain must be.
constexpr int kMargin = 2;
/// Of the serial time; threads that do not come below it are not worth having.
constexpr double kWorthwhile = 0.95;
/// Units that take longer than this together are not measured as often as others.
constexpr std::chrono::milliseconds kLongMeasurement{20};
constexpr std::uint64_t kFewestMeasured = 3;

Nanoseconds median(std::vector<Nanoseconds>& samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// What the units of the shares cost together, less what the longest share costs.
Nanoseconds gain(std::span<const ThreadShare> shares, std::span<const Nanoseconds> costs) {
  Nanoseconds sum{};
  Nanoseconds longest{};
  for (const ThreadShare& share : shares) {
    Nanoseconds cost{};
    for (const std::size_t place : share) cost += costs[place];
    sum += cost;
    longest = std::max(longest, cost);
  }
  return sum - longest;
}

}  // namespace

std::vector<ThreadShare> balance_load(std::span<const std::size_t> places,
                                      std::span<const Nanoseconds> costs,
                                      std::span<const char> main_only, std::size_t threads) {
  std::vector<ThreadShare> shares(std::min(threads, places.size()));
  std::vector<Nanoseconds> loads(shares.size());
  std::vector<std::size_t> order(places.begin(), places.end());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (main_only[a] != main_only[b]) return main_only[a] > main_only[b];
    return costs[a] > costs[b];
  });
  for (const std::size_t place : order) {
    const auto least = std::min_element(loads.begin(), loads.end());
    const std::size_t thread =
        main_only[place] ? 0 : static_cast<std::size_t>(least - loads.begin());
    shares[thread].push_back(place);
    loads[thread] += costs[place];
  }
  for (ThreadShare& share : shares) std::sort(share.begin(), share.end());
  while (!shares.empty() && shares.back().empty()) shares.pop_back();
  return shares;
}

LoadBalancer::LoadBalancer(Plan plan)
    : plan_(std::move(plan)),
      shares_(plan_.stages.size()),
      costs_(plan_.main_only.size(), Nanoseconds(1)),
      samples_(plan_.main_only.size()) {
  for (std::size_t stage = 0; stage < shares_.size(); ++stage) {
    shares_[stage] = balance_load(plan_.stages[stage], costs_, plan_.main_only, plan_.threads);
    if (shares_[stage].size() < 2) shares_[stage].clear();
  }
  const bool has_choice = std::any_of(shares_.begin(), shares_.end(),
                                      [](const auto& shares) { return !shares.empty(); });
  if (!has_choice) return;
  if (plan_.always) {
    parallel_ = true;
  } else {
    begin_measuring();
  }
}

void LoadBalancer::begin_measuring() {
  phase_ = Phase::Measuring;
  parallel_ = false;
  steps_ = 0;
  turn_pace_ = {};
  for (auto& samples : samples_) samples.clear();
  std::fill(costs_.begin(), costs_.end(), Nanoseconds{});
}

void LoadBalancer::begin_turn(std::size_t turn) {
  phase_ = Phase::Racing;
  parallel_ = turn % 2 == 1;
  turn_ = turn;
  turn_pace_ = {};
}

void LoadBalancer::decide(bool parallel) {
  phase_ = Phase::Decided;
  parallel_ = parallel;
  hold_factor_ = parallel ? kHoldFactor : std::min(2 * hold_factor_, kLargestHoldFactor);
  steps_ *= hold_factor_;
}

void LoadBalancer::record_step(Nanoseconds elapsed) {
  ++steps_;
  turn_pace_.time += elapsed;
  ++turn_pace_.steps;
  phase_ == Phase::Measuring ? measure() : race();
}

void LoadBalancer::measure() {
  for (std::size_t place = 0; place < costs_.size(); ++place) {
    samples_[place].push_back(std::exchange(costs_[place], Nanoseconds{}));
  }
  const bool is_long = turn_pace_.time >= kLongMeasurement && turn_pace_.steps >= kFewestMeasured;
  if (turn_pace_.steps < kMeasured && !is_long) return;
  for (std::size_t place = 0; place < costs_.size(); ++place) {
    costs_[place] = median(samples_[place]);
  }
  if (!promises_gain()) return decide(false);
  paces_[0] = paces_[1] = {};
  begin_turn(0);
}

void LoadBalancer::race() {
  if (turn_pace_.time < kTurn) return;
  Pace& pace = paces_[parallel_];
  pace.time += turn_pace_.time;
  pace.steps += turn_pace_.steps;
  if (turn_ + 1 < kTurns) return begin_turn(turn_ + 1);
  decide(is_parallel_faster());
}

bool LoadBalancer::is_parallel_faster() const {
  const auto mean = [](const Pace& pace) {
    return static_cast<double>(pace.time.count()) / static_cast<double>(pace.steps);
  };
  return mean(paces_[1]) < kWorthwhile * mean(paces_[0]);
}

/// Shares the stages out by the units' costs; those where threads cannot pay get no shares.
bool LoadBalancer::promises_gain() {
  Nanoseconds needed = kMargin * kLeastHandOver;
  bool is_measured = false;
  bool any = false;
  for (std::size_t stage = 0; stage < shares_.size(); ++stage) {
    auto& shares = shares_[stage];
    shares = balance_load(plan_.stages[stage], costs_, plan_.main_only, plan_.threads);
    const Nanoseconds saved = gain(shares, costs_);
    if (saved > needed && !is_measured) {
      needed = kMargin * plan_.hand_over();
      is_measured = true;
    }
    if (saved > needed) {
      any = true;
    } else {
      shares.clear();
    }
  }
  return any;
}

}  // namespace stride::core
