#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "master/verify/checks.h"
#include "master/verify/idle_comparison.h"
#include "master/verify/idle_run.h"
#include "master/verify/idle_stimulus.h"

namespace stride::verify {
namespace {

/// Runs with inputs that stay between two jumps, and with those that move within their deadbands.
constexpr std::uint64_t kStillRuns = 8;
constexpr std::uint64_t kWanderingRuns = 4;

struct Inputs {
  std::uint64_t seed;
  Wander wander;
  Jump jump;
};

Recording record(const Trial& trial, const Inputs& inputs, bool is_skipping) {
  return recording_from_text(trial.in_child([&] {
    const auto stimulus =
        std::make_shared<const IdleStimulus>(trial.tested, inputs.seed, inputs.wander, inputs.jump);
    TestInstance instance = trial.make_instance({.stimulus = stimulus});
    return to_text(IdleRun(trial.tested, instance, *stimulus, is_skipping).run());
  }));
}

bool has_deadbands(const core::UnitDescription& unit) {
  return std::ranges::any_of(unit.variables,
                             [](const core::Variable& input) { return input.deadband > 0; });
}

/// The same unit in shorter steps, so that what comes late by less than a step is seen, too. Where
/// it has an internal step, the steps are multiples of that.
VerifyRequest in_short_steps(const TestedUnit& tested) {
  constexpr std::int64_t kShorter = 16;
  VerifyRequest request = tested.request();
  const std::optional<Duration>& internal = tested.description().fixed_internal_step;
  request.step = tested.step() / kShorter;
  if (*request.step == Duration{} || (internal && *request.step % *internal != Duration{})) {
    request.step = tested.step();
  }
  request.stop = *request.step * static_cast<std::int64_t>(tested.steps());
  return request;
}

/// A run without skipping; what is far from the start values may be nonsense to the unit.
Recording record_full(const Trial& trial, Inputs& inputs) {
  if (inputs.jump == Jump::Far) {
    try {
      return record(trial, inputs, false);
    } catch (const Failure&) {
      inputs.jump = Jump::Near;
    }
  }
  return record(trial, inputs, false);
}

std::size_t promises_in(const Recording& skipping) {
  const auto last = std::find_if(skipping.rows.rbegin(), skipping.rows.rend(),
                                 [](const Row& row) { return !row.is_event; });
  return last == skipping.rows.rend() ? 0 : std::strtoul(last->values.back().c_str(), nullptr, 10);
}

}  // namespace

Finding check_idle(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  if (!unit.promises_idle) return skipped("it never promises to be idle (org.stride.idle)");
  const TestedUnit short_steps(in_short_steps(trial.tested));
  std::size_t promises = 0;
  const std::uint64_t rounds = kStillRuns + (has_deadbands(unit) ? kWanderingRuns : 0);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const Wander wander = round < kStillRuns ? Wander::Still : Wander::WithinDeadbands;
    const Jump jump = round % 4 == 3 ? Jump::Near : Jump::Far;
    Inputs inputs{trial.tested.request().seed * 1000 + 10 * round, wander, jump};
    const Trial used{round % 4 == 0 ? trial.tested : short_steps, trial.note};
    const Recording full = record_full(used, inputs);
    const Recording skipping = record(used, inputs, true);
    const auto difference = idle_difference(used.tested, full, skipping, wander);
    if (difference) throw Failure("with skipping of idle time " + *difference, false);
    promises += promises_in(skipping);
  }
  if (promises == 0) {
    return passed("skipping of idle time changes nothing", {"it promised nothing in these runs"});
  }
  return passed(
      fmt::format("{} promises were kept, in {} runs with random inputs", promises, rounds));
}

}  // namespace stride::verify
