#include <algorithm>
#include <cstdlib>
#include <iterator>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/study/verify/checks.h"
#include "master/study/verify/idle_comparison.h"
#include "master/study/verify/idle_run.h"
#include "master/study/verify/idle_stimulus.h"

namespace stride::verify {
namespace {

/// Runs with inputs that stay between two jumps, and with those that move within their deadbands.
constexpr std::uint64_t kStillRuns = 8;
constexpr std::uint64_t kWanderingRuns = 4;
/// Those in which a promise is held for long.
constexpr Jump kLongRuns[] = {Jump::Never, Jump::Once, Jump::Late};
/// A run that is longer than a promise may be this many times as long as the others.
constexpr std::int64_t kMostLengths = 16;

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
  const std::optional<core::Interval>& internal = tested.description().fixed_internal_step;
  request.step = tested.step() / kShorter;
  if (*request.step == Duration{} ||
      (internal && !core::Interval(*request.step).is_multiple_of(*internal))) {
    request.step = tested.step();
  }
  request.stop = *request.step * static_cast<std::int64_t>(tested.steps());
  return request;
}

/// Over more than a promise of this length, within reason.
VerifyRequest over(const TestedUnit& tested, Duration promise) {
  const auto steps = static_cast<std::int64_t>(tested.steps());
  VerifyRequest request = tested.request();
  request.step = tested.step();
  request.stop = tested.step() * (steps + std::min<Picoseconds>(promise / tested.step(),
                                                                (kMostLengths - 1) * steps));
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

struct Promises {
  std::size_t count = 0;
  Duration longest{};
  Duration longest_suspension{};

  void add(const Promises& others) {
    count += others.count;
    longest = std::max(longest, others.longest);
    longest_suspension = std::max(longest_suspension, others.longest_suspension);
  }
};

/// A run with skipping, and one without. Throws Failure if they differ.
Promises compare(const Trial& trial, Inputs inputs) {
  const Recording full = record_full(trial, inputs);
  const Recording skipping = record(trial, inputs, true);
  const auto difference = idle_difference(trial.tested, full, skipping, inputs.wander);
  if (difference) throw Failure("with skipping of idle time " + *difference, false);
  return {promises_in(skipping), skipping.longest_promise, skipping.longest_suspension};
}

/// What of the promises was not tested, in runs of this length.
std::vector<std::string> notes_on(const Promises& promises, Duration length) {
  if (promises.longest <= length) return {};
  const std::string promised = promises.longest == Duration::max()
                                   ? "without an end"
                                   : "for up to " + core::to_text(promises.longest) + " s";
  return {
      fmt::format("it promised to be idle {}, and was suspended for {} s at most; --stop makes "
                  "longer runs",
                  promised, core::to_text(promises.longest_suspension))};
}

}  // namespace

Finding check_idle(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  if (!unit.promises_idle) return skipped("it never promises to be idle (org.stride.idle)");
  const TestedUnit short_steps(in_short_steps(trial.tested));
  Promises promises;
  const std::uint64_t rounds = kStillRuns + (has_deadbands(unit) ? kWanderingRuns : 0);
  const std::uint64_t seed = trial.tested.request().seed * 1000;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const Wander wander = round < kStillRuns ? Wander::Still : Wander::WithinDeadbands;
    const Jump jump = round % 4 == 3 ? Jump::Near : Jump::Far;
    promises.add(compare({round % 4 == 0 ? trial.tested : short_steps, trial.note},
                         {seed + 10 * round, wander, jump}));
  }
  if (promises.count == 0) {
    return passed("skipping of idle time changes nothing", {"it promised nothing in these runs"});
  }
  const TestedUnit longer(over(trial.tested, promises.longest));
  for (const Jump jump : kLongRuns) {
    promises.add(compare({longer, trial.note}, {seed + 10 * rounds, Wander::Still, jump}));
  }
  const Duration length = longer.step() * static_cast<std::int64_t>(longer.steps());
  return passed(fmt::format("{} kept, in {} runs with random inputs",
                            core::counted(promises.count, "promise was", "promises were"),
                            rounds + std::size(kLongRuns)),
                notes_on(promises, length));
}

}  // namespace stride::verify
