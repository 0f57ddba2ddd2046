#include "master/study/verify/step_outcome.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/study/verify/deviation.h"

namespace stride::verify {
namespace {

std::string end_of(const StepOutcome& step) {
  if (step.is_rejected) return "is rejected";
  return fmt::format("ends at {} s{}{}", core::to_text(step.end),
                     step.needs_event ? " with an event" : "",
                     step.ends_run ? " and ends the run" : "");
}

bool is_near(Time one, Time other) {
  return to_seconds(std::chrono::abs(one - other)) <= kRounding * to_seconds(one);
}

bool is_rounded(const StepOutcome& one, const StepOutcome& other) {
  return one.is_rejected == other.is_rejected && one.needs_event == other.needs_event &&
         one.ends_run == other.ends_run && is_near(one.begin, other.begin) &&
         is_near(one.end, other.end);
}

}  // namespace

std::optional<std::string> difference_beyond_rounding(const std::vector<StepOutcome>& expected,
                                                      const std::vector<StepOutcome>& seen,
                                                      const std::string& expected_when,
                                                      const std::string& seen_when,
                                                      std::string& note) {
  const std::size_t common = std::min(expected.size(), seen.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (expected[i] == seen[i]) continue;
    std::string text =
        fmt::format("the step from {} s {} {}, and {} {}", core::to_text(expected[i].begin),
                    end_of(expected[i]), expected_when, end_of(seen[i]), seen_when);
    if (!is_rounded(expected[i], seen[i])) return text;
    if (note.empty()) note = std::move(text);
  }
  if (expected.size() == seen.size()) return std::nullopt;
  return fmt::format("it makes {} {}, and {} {}", core::counted(expected.size(), "step"),
                     expected_when, seen.size(), seen_when);
}

}  // namespace stride::verify
