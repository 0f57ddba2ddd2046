#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/study/verify/checks.h"
#include "master/study/verify/deviation.h"

namespace stride::verify {
namespace {

/// Why halves of a step have to give what the whole gives; empty if there is no reason.
std::string reason_for_equality(const TestedUnit& tested) {
  const core::UnitDescription& unit = tested.description();
  if (unit.split_invariant) return "though it declares that steps may be split (splitInvariant)";
  const bool is_on_grid =
      unit.fixed_internal_step && tested.step() % 2 == Duration{} &&
      core::Interval(tested.step() / 2).is_multiple_of(*unit.fixed_internal_step);
  if (!is_on_grid) return "";
  return fmt::format("though both are multiples of its fixedInternalStepSize, {} s",
                     core::to_text(*unit.fixed_internal_step));
}

}  // namespace

Finding check_splitting(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  const core::UnitDescription& unit = tested.description();
  const auto run = [&](Split split) {
    return trial.record({.split = split}).without_events().rows;
  };
  const std::vector<Row> whole = run(Split::None);
  std::string text;
  const auto examine = [&](Split split, const std::string& what, const std::string& reason) {
    const Deviation seen = deviation(observed_names(tested), whole, run(split));
    if (!reason.empty() && seen.worst > kRounding) {
      throw Failure(fmt::format("{} where steps of {} s are split {}, {}", seen.text,
                                core::to_text(tested.step()), what, reason));
    }
    if (!text.empty()) text += "; ";
    if (seen.is_equal) {
      text += fmt::format("{}: the same bits", what);
    } else if (seen.worst <= kRounding) {
      text += fmt::format("{}: the same but for rounding ({:.1e})", what, seen.worst);
    } else {
      text += fmt::format("{}: other values, which nothing excludes ({})", what, seen.text);
    }
  };
  examine(Split::Halves, "into halves", reason_for_equality(tested));
  if (unit.can_vary_step) {
    examine(Split::Uneven, "unevenly", unit.split_invariant ? reason_for_equality(tested) : "");
  } else {
    text += "; it has no canHandleVariableCommunicationStepSize";
  }
  return passed(std::move(text));
}

}  // namespace stride::verify
