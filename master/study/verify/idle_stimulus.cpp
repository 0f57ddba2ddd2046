#include "master/study/verify/idle_stimulus.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stride::verify {
namespace {

using core::ValueBlock;
using core::ValueType;

/// Of the deadband, to each side, so that rounding does not leave it.
constexpr double kWander = 0.49;
/// An input rests for so many points, and wanders over as many: a unit that promises only where its
/// inputs rest is tried, too.
constexpr std::size_t kRest = 8;

std::optional<std::size_t> only_jump(Jump jump, std::size_t steps) {
  if (jump == Jump::Once) return 3;
  if (jump == Jump::Late) return steps - steps / 10;
  return std::nullopt;
}

/// One number out of two.
std::uint64_t mixed(std::uint64_t one, std::uint64_t other) { return (one << 32) ^ other; }

}  // namespace

IdleStimulus::IdleStimulus(const TestedUnit& tested, std::uint64_t seed, Wander wander, Jump jump)
    : Stimulus(tested, seed),
      unit_(tested.description()),
      seed_(seed),
      wander_(wander),
      jump_(jump),
      only_jump_(only_jump(jump, tested.steps())) {}

/// At one point in ten to one in a thousand, by the seed, unless the run is quiet.
bool IdleStimulus::ticks_at(std::size_t k) const {
  if (is_quiet()) return jump_ == Jump::Late && k == only_jump_;
  const double share = 0.1 * std::pow(10, -2 * uniform(seed_ + 1, 0));
  return k > 0 && uniform(seed_ + 1, k) < share;
}

/// Each input has a rhythm of its own, from some points to hundreds of them.
std::size_t IdleStimulus::jumps_until(const Input& input, std::size_t k) const {
  if (is_quiet()) return only_jump_ && k >= *only_jump_ ? 1 : 0;
  const double rhythm = 3 * std::pow(10, 2 * uniform(seed_ + 2, input.reference));
  return static_cast<std::size_t>(static_cast<double>(k) / rhythm);
}

bool IdleStimulus::changes_at(std::size_t k) const {
  return k > 0 && std::ranges::any_of(inputs(), [&](const Input& input) {
           return !input.is_continuous && !input.is_clocked &&
                  value(input, k) != value(input, k - 1);
         });
}

double IdleStimulus::element(const Input& input, double start, double other,
                             std::uint64_t jump) const {
  const double luck = uniform(seed_ + 3, mixed(input.reference, jump));
  if (jump_ != Jump::Far) return start + luck * (other - start);
  const auto [low, high] = range_of(unit_.variables[input.variable]);
  using Limits = std::numeric_limits<double>;  // which are no bounds that a unit has declared
  const bool is_bounded = low > Limits::lowest() && high < Limits::max();
  if (is_bounded) return low + luck * (high - low);
  const double decades = 3 * uniform(seed_ + 4, mixed(input.reference, jump));
  const double way = (2 * luck - 1) * std::abs(other - start) * std::pow(10, decades);
  return std::clamp(start + way, low, high);
}

ValueBlock IdleStimulus::value(const Input& input, std::size_t k) const {
  const std::size_t jump = jumps_until(input, k);
  ValueBlock block = input.start;
  if (block.type() != ValueType::Float64) {
    if (is_quiet()) return jump == 0 ? input.start : input.other;
    return uniform(seed_ + 5, mixed(input.reference, jump)) < 0.5 ? input.start : input.other;
  }
  const core::Variable& variable = unit_.variables[input.variable];
  const auto [low, high] = range_of(variable);
  const std::size_t moved = (k / kRest) % 2 == 0 ? k - k % kRest : k;
  const double shift = 2 * uniform(seed_ + 6, mixed(input.reference, moved)) - 1;
  for (std::size_t e = 0; e < block.size(); ++e) {
    const double start = core::real(input.start, e);
    double value = jump == 0 ? start : element(input, start, core::real(input.other, e), jump);
    if (wander_ == Wander::WithinDeadbands) value += kWander * variable.deadband * shift;
    core::set_real(block, e, std::clamp(value, low, high));
  }
  return block;
}

}  // namespace stride::verify
