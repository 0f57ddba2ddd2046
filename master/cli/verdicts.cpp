#include "master/cli/verdicts.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/cli/table.h"
#include "master/core/error.h"

namespace stride::cli {

std::string verdict_table(const core::System& system, std::span<const core::Verdict> verdicts) {
  if (verdicts.empty()) return "";
  Table table({{"unit"}, {"verdict"}, {"because"}});
  for (const core::Verdict& verdict : verdicts) {
    table.add({system.components()[verdict.component].name, verdict.passed ? "passed" : "FAILED",
               verdict.text});
  }
  return "\nVerdicts\n" + table.text();
}

void require_passed(const core::System& system, std::span<const core::Verdict> verdicts) {
  const auto failed = std::ranges::count(verdicts, false, &core::Verdict::passed);
  if (failed == 0) return;
  std::string message =
      fmt::format("the run is complete, and has failed by {} of {}", failed,
                  verdicts.size() == 1 ? "1 verdict" : fmt::format("{} verdicts", verdicts.size()));
  for (const core::Verdict& verdict : verdicts) {
    if (verdict.passed) continue;
    message += "\n  " + system.components()[verdict.component].name;
    if (!verdict.text.empty()) message += ": " + verdict.text;
  }
  core::fail_run({}, message);
}

}  // namespace stride::cli
