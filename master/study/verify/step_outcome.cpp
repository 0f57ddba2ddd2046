#include "master/study/verify/step_outcome.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/study/verify/deviation.h"
#include "master/study/verify/row.h"

namespace stride::verify {
namespace {

std::string end_of(const StepOutcome& step) {
  if (step.is_rejected) return "is rejected";
  return fmt::format("ends at {} s{}{}", instant_text(step.end),
                     step.needs_event ? " with an event" : "",
                     step.ends_run ? " and ends the run" : "");
}

bool is_near(std::int64_t one, std::int64_t other) {
  return static_cast<double>(std::abs(one - other)) <= kRounding * static_cast<double>(one);
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
        fmt::format("the step from {} s {} {}, and {} {}", instant_text(expected[i].begin),
                    end_of(expected[i]), expected_when, end_of(seen[i]), seen_when);
    if (!is_rounded(expected[i], seen[i])) return text;
    if (note.empty()) note = std::move(text);
  }
  if (expected.size() == seen.size()) return std::nullopt;
  return fmt::format("it makes {} {}, and {} {}", core::counted(expected.size(), "step"),
                     expected_when, seen.size(), seen_when);
}

}  // namespace stride::verify
