#include "master/cli/verdicts.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/cli/table.h"
#include "master/util/error.h"
#include "master/util/time_text.h"

namespace stride::cli {
namespace {

const char* word(std::optional<bool> passed) {
  if (!passed) return "undecided";
  return *passed ? "passed" : "FAILED";
}

}  // namespace

std::string verdict_table(std::span<const core::Verdict> verdicts) {
  if (verdicts.empty()) return "";
  const bool has_times = std::ranges::any_of(
      verdicts, [](const core::Verdict& verdict) { return verdict.time.has_value(); });
  std::vector<Table::Column> columns{{"by"}, {"verdict"}};
  if (has_times) columns.push_back({"first failure [s]", Table::Align::Right});
  columns.push_back({"because"});
  Table table(columns);
  for (const core::Verdict& verdict : verdicts) {
    std::vector<std::string> row{verdict.name, word(verdict.passed)};
    if (has_times) row.push_back(verdict.time ? core::to_text(*verdict.time) : "");
    row.push_back(verdict.text);
    table.add(std::move(row));
  }
  return "\nVerdicts\n" + table.text();
}

std::string failures_text(std::span<const core::Verdict> verdicts) {
  std::string text;
  for (const core::Verdict& verdict : verdicts) {
    if (verdict.passed != false) continue;
    const std::string reason = core::reason(verdict);
    text += "\n  " + core::to_text(core::Context{verdict.where, {}, {}, {}}) + verdict.name;
    if (!reason.empty()) text += ": " + reason;
  }
  return text;
}

void require_passed(std::span<const core::Verdict> verdicts) {
  const auto failed = std::ranges::count(verdicts, std::optional(false), &core::Verdict::passed);
  if (failed == 0) return;
  core::fail_run({}, fmt::format("the run is complete, and has failed by {} of {}{}", failed,
                                 verdicts.size() == 1 ? "1 verdict"
                                                      : fmt::format("{} verdicts", verdicts.size()),
                                 failures_text(verdicts)));
}

}  // namespace stride::cli
