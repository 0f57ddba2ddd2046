#include "master/study/compare/signals/recorded_signals.h"

#include <set>
#include <string>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/report/signals_file.h"
#include "master/report/table.h"

namespace stride::compare {
namespace {

void require_distinct(const std::filesystem::path& file, std::span<const report::Column> columns) {
  std::set<std::string> names;
  for (const report::Column& column : columns) {
    if (names.insert(column.name()).second) continue;
    core::fail_input({.where = {file.string(), 1}},
                     fmt::format("two columns have the name '{}'", column.name()),
                     "each signal has one column; run the scenario again");
  }
}

void append_row(const report::Table& table, RecordedSignals& signals) {
  const Time time = table.time(0);
  if (!signals.times.empty() && time < signals.times.back()) table.fail(0, "the time goes back");
  report::append_fields(signals.columns, table);
  signals.times.push_back(time);
}

}  // namespace

RecordedSignals read_recorded_signals(const std::filesystem::path& file,
                                      std::span<const report::SignalInfo> infos) {
  report::Table table(file);
  RecordedSignals signals;
  table.require_header();
  const std::span<const std::string> headings = table.columns();
  if (headings[0] != "time") table.fail(0, "expected the column 'time'");
  signals.columns = report::signal_columns(headings.subspan(1), infos);
  require_distinct(file, signals.columns);
  while (table.next()) append_row(table, signals);
  signals.cut = table.cut();
  return signals;
}

}  // namespace stride::compare
