#include "master/engine/run/parallel/load_balancer.h"

#include <algorithm>
#include <utility>

namespace stride::core {
namespace {

using Nanoseconds = LoadBalancer::Nanoseconds;

/// A lower bound of the cost of a hand-over: no thread is started for a smaller gain.
constexpr Nanoseconds kLeastHandOver{300};
/// The expected gain must be this many times the cost of the hand-over.
constexpr int kMargin = 2;
/// Threads are used if they need less than this part of the serial time.
constexpr double kWorthwhile = 0.95;
/// Fewer steps are measured where they take longer than this together.
constexpr std::chrono::milliseconds kLongMeasurement{20};
constexpr std::uint64_t kFewestMeasured = 3;

Nanoseconds median(std::vector<Nanoseconds>& samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// The cost of all shares less that of the most expensive one.
Nanoseconds gain(std::span<const ThreadShare> shares, std::span<const Nanoseconds> costs) {
  Nanoseconds sum{};
  Nanoseconds longest{};
  for (const ThreadShare& share : shares) {
    Nanoseconds cost{};
    for (const std::size_t position : share) cost += costs[position];
    sum += cost;
    longest = std::max(longest, cost);
  }
  return sum - longest;
}

}  // namespace

std::vector<ThreadShare> balance_load(std::span<const std::size_t> positions,
                                      std::span<const Nanoseconds> costs,
                                      std::span<const char> main_only, std::size_t threads) {
  std::vector<ThreadShare> shares(std::min(threads, positions.size()));
  std::vector<Nanoseconds> loads(shares.size());
  std::vector<std::size_t> order(positions.begin(), positions.end());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (main_only[a] != main_only[b]) return main_only[a] > main_only[b];
    return costs[a] > costs[b];
  });
  for (const std::size_t position : order) {
    const auto least = std::min_element(loads.begin(), loads.end());
    const std::size_t thread =
        main_only[position] ? 0 : static_cast<std::size_t>(least - loads.begin());
    shares[thread].push_back(position);
    loads[thread] += costs[position];
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
  for (std::size_t position = 0; position < costs_.size(); ++position) {
    samples_[position].push_back(std::exchange(costs_[position], Nanoseconds{}));
  }
  const bool is_long = turn_pace_.time >= kLongMeasurement && turn_pace_.steps >= kFewestMeasured;
  if (turn_pace_.steps < kMeasured && !is_long) return;
  for (std::size_t position = 0; position < costs_.size(); ++position) {
    costs_[position] = median(samples_[position]);
  }
  if (!share_stages()) return decide(false);
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

/// Shares the stages out by the units' costs. Stages where threads are not worthwhile get no
/// shares. Returns whether any stage has some.
bool LoadBalancer::share_stages() {
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
