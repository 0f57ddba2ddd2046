#include "master/engine/run/time_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride::core {
namespace {

/// Of the time of a run, for readings of the clock.
constexpr double kShare = 0.005;
constexpr std::uint64_t kLongestBlock = 8192;
/// From one block to the next, so that a single slow one changes little.
constexpr std::uint64_t kGrowth = 4;

/// The shortest of some: others were interrupted.
std::chrono::nanoseconds time_of_reading() {
  using Source = WallClock::Source;
  constexpr int kTries = 16, kReadings = 8;
  auto shortest = Source::duration::max();
  for (int i = 0; i < kTries; ++i) {
    const auto began = Source::now();
    auto end = began;
    for (int k = 0; k < kReadings; ++k) end = Source::now();
    shortest = std::min(shortest, end - began);
  }
  return shortest / kReadings;
}

}  // namespace

TimeSampling::TimeSampling(WallClock& clock, RunStatistics& statistics)
    : clock_(clock), statistics_(statistics), is_on_(clock.measures()) {
  if (!is_on_) measured_ = block_end_ = std::numeric_limits<std::uint64_t>::max();
}

/// The times that are measured in some steps only.
std::vector<TimeSampling::Sampled> TimeSampling::sampled(RunStatistics& statistics) {
  PhaseTimes& phases = statistics.phases;
  PhaseTimes& uncertain = statistics.phase_uncertainties;
  std::vector<Sampled> sampled{{&phases.steps, &uncertain.steps},
                               {&phases.instants, &uncertain.instants},
                               {&phases.observers, &uncertain.observers}};
  for (UnitStatistics& unit : statistics.units) {
    sampled.push_back({&unit.step_time, &unit.step_time_uncertainty});
    sampled.push_back({&unit.event_time, &unit.event_time_uncertainty});
  }
  return sampled;
}

void TimeSampling::begin() {
  if (!is_on_) return;
  for (const auto& [time, uncertainty] : sampled(statistics_)) {
    const auto deviation = static_cast<double>(uncertainty->count());
    meters_.push_back({time, *time, static_cast<double>(time->count()), deviation * deviation});
  }
  constexpr int kPhaseReadings = 8;
  reading_ = time_of_reading() * (2 * statistics_.units.size() + kPhaseReadings);
  clock_.measure(false);
  begin_block();
}

void TimeSampling::begin_block() {
  measured_ = step_ + (size_ == 1 ? 0 : random_() % size_);
  block_end_ = step_ + size_;
  block_began_ = WallClock::Source::now();
}

void TimeSampling::end_measured_step() {
  clock_.measure(false);
  ++statistics_.measured_steps;
  const auto weight = static_cast<double>(size_);
  for (Meter& meter : meters_) {
    const double added = weight * static_cast<double>((*meter.time - meter.before).count());
    meter.before = *meter.time;
    meter.sum += added;
    const double change = added - meter.last;
    if (meter.has_last) meter.variance += (1 - 1 / weight) * change * change / 2;
    meter.last = added;
    meter.has_last = size_ > 1;
  }
}

/// The size of the next block, from the time that the steps of this one took.
void TimeSampling::end_block() {
  const Nanoseconds took = WallClock::Source::now() - block_began_ - reading_;
  const double step = std::max(1.0, static_cast<double>(took.count()) / static_cast<double>(size_));
  const double wanted = static_cast<double>(reading_.count()) / (kShare * step);
  const auto most = static_cast<double>(std::min(kLongestBlock, kGrowth * size_));
  size_ = static_cast<std::uint64_t>(std::clamp(std::floor(wanted), 1.0, most));
  begin_block();
}

void TimeSampling::scale(RunStatistics& copy) const {
  if (!is_on_ || meters_.empty()) return;
  const std::vector<Sampled> scaled = sampled(copy);
  for (std::size_t i = 0; i < meters_.size(); ++i) {
    const Meter& meter = meters_[i];
    const double rest = static_cast<double>((*meter.time - meter.before).count());
    *scaled[i].time = Nanoseconds(std::llround(meter.sum + rest));
    *scaled[i].uncertainty = Nanoseconds(std::llround(std::sqrt(meter.variance)));
  }
}

}  // namespace stride::core
