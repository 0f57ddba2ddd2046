#include "master/study/compare/signals/signals.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/study/compare/signals/curves.h"
#include "master/study/compare/signals/rows.h"

namespace stride::compare {
namespace {

using report::Column;

constexpr const char* kNone = "none";

std::string seconds(Time time) { return core::to_text(time); }

/// Columns of the same name, in the order of A.
struct ColumnPairs {
  std::vector<std::pair<const Column*, const Column*>> both;
  std::vector<const Column*> only_a;
  std::vector<const Column*> only_b;
  bool is_reordered = false;
};

std::map<std::string, const Column*> by_name(const std::vector<Column>& columns) {
  std::map<std::string, const Column*> names;
  for (const Column& column : columns) names.emplace(column.name(), &column);
  return names;
}

ColumnPairs pair_columns(const RecordedSignals& a, const RecordedSignals& b,
                         const Selection& selection) {
  const auto names_a = by_name(a.columns);
  const auto names_b = by_name(b.columns);
  ColumnPairs pairs;
  for (const Column& column : a.columns) {
    if (!selection.has(column.name())) continue;
    const auto other = names_b.find(column.name());
    if (other == names_b.end()) {
      pairs.only_a.push_back(&column);
      continue;
    }
    // both are elements of the vector of B
    pairs.is_reordered |= !pairs.both.empty() && other->second < pairs.both.back().second;
    pairs.both.emplace_back(&column, other->second);
  }
  for (const Column& column : b.columns) {
    if (selection.has(column.name()) && !names_a.contains(column.name())) {
      pairs.only_b.push_back(&column);
    }
  }
  return pairs;
}

void add_unpaired(const ColumnPairs& pairs, const std::string& file, Differences& differences) {
  for (const Column* column : pairs.only_a) {
    differences.push_back({Kind::Signal, column->name(), {}, "recorded", kNone});
  }
  for (const Column* column : pairs.only_b) {
    differences.push_back({Kind::Signal, column->name(), {}, kNone, "recorded"});
  }
  if (pairs.is_reordered) {
    differences.push_back({Kind::File, file, {}, "its columns in one order", "in another one"});
  }
}

Tolerance tolerance_of(const Column& a, const Column& b, const Tolerances& tolerances) {
  if (!core::is_real(a.type()) || !core::is_real(b.type())) return {};
  return tolerances.of(a.name(), a.unit());
}

/// Rows of one run that the other has not.
std::optional<Difference> unpaired_rows(const RecordedSignals& a, const RecordedSignals& b,
                                        const RowPairs& rows, const std::string& file,
                                        bool is_golden) {
  Difference difference{Kind::File, file, {}, kNone, kNone, rows.only_b.size()};
  if (!rows.only_b.empty()) {
    difference.time = b.times[rows.only_b.front()];
    difference.b = kRow;
  }
  if (!is_golden) {
    difference.count += rows.only_a.size();
    const std::optional<Time> time =
        rows.only_a.empty() ? std::nullopt : std::optional(a.times[rows.only_a.front()]);
    if (time && (!difference.time || *time < *difference.time)) {
      difference.time = time;
      difference.a = kRow;
      difference.b = kNone;
    }
  }
  if (difference.count == 0) return std::nullopt;
  return difference;
}

/// One run begins or ends where the other, by more than the tolerance, does not.
std::optional<Difference> other_span(const RecordedSignals& a, const RecordedSignals& b,
                                     Duration tolerance, const std::string& file, bool is_golden) {
  if (a.times.empty() || b.times.empty()) {
    if (a.times.empty() == b.times.empty()) return std::nullopt;
    const auto rows = [](const RecordedSignals& signals) {
      return signals.times.empty() ? std::string("no rows") : std::string("rows");
    };
    const Time first = a.times.empty() ? b.times.front() : a.times.front();
    return Difference{Kind::File, file, first, rows(a), rows(b)};
  }
  const auto differs = [&](Time mine, Time other, bool is_longer) {
    return (!is_golden || is_longer) && std::chrono::abs(mine - other) > tolerance;
  };
  const Time begin_a = a.times.front(), begin_b = b.times.front();
  if (differs(begin_a, begin_b, begin_b < begin_a)) {
    return Difference{Kind::File, file, std::min(begin_a, begin_b),
                      fmt::format("rows from {} s on", seconds(begin_a)),
                      fmt::format("rows from {} s on", seconds(begin_b))};
  }
  const Time end_a = a.times.back(), end_b = b.times.back();
  if (!differs(end_a, end_b, end_b > end_a)) return std::nullopt;
  return Difference{Kind::File, file, std::min(end_a, end_b),
                    fmt::format("rows until {} s", seconds(end_a)),
                    fmt::format("rows until {} s", seconds(end_b))};
}

class SignalComparison {
 public:
  SignalComparison(const RecordedSignals& a, const RecordedSignals& b, const Settings& settings,
                   const Tolerances& tolerances, const std::string& file)
      : a_(a), b_(b), settings_(settings), tolerances_(tolerances) {
    if (settings.time_tolerance) {
      instants_ = other_span(a, b, *settings.time_tolerance, file, settings.is_golden);
    } else {
      rows_ = pair_rows(a.times, b.times);
      instants_ = unpaired_rows(a, b, rows_, file, settings.is_golden);
    }
  }

  const std::optional<Difference>& instants() const { return instants_; }

  std::optional<Difference> compare(const Column& a, const Column& b) const {
    if (a.unit() != b.unit()) {
      return Difference{Kind::Signal,
                        a.name(),
                        {},
                        fmt::format("in [{}]", a.unit()),
                        fmt::format("in [{}]", b.unit())};
    }
    if (!a.is_deduced() && !b.is_deduced() && a.type() != b.type()) {
      return Difference{Kind::Signal, a.name(), {}, core::name(a.type()), core::name(b.type())};
    }
    SignalTally tally(a.name(), a.type() == core::ValueType::Boolean);
    const Tolerance tolerance = tolerance_of(a, b, tolerances_);
    if (settings_.time_tolerance) {
      compare_curves({a_.times, a}, {b_.times, b},
                     {.time = *settings_.time_tolerance,
                      .value = tolerance,
                      .is_held = a.is_stepped() || b.is_stepped(),
                      .only_rows_of_b = settings_.is_golden},
                     tally);
    } else {
      compare_rows(a_.times, a, b, rows_.both, tolerance, tally);
    }
    return tally.difference();
  }

 private:
  const RecordedSignals& a_;
  const RecordedSignals& b_;
  const Settings& settings_;
  const Tolerances& tolerances_;
  RowPairs rows_;
  std::optional<Difference> instants_;
};

void require_use(const Tolerances& tolerances, const RecordedSignals& a, const RecordedSignals& b) {
  std::vector<std::string> names, units;
  for (const RecordedSignals* signals : {&a, &b}) {
    for (const Column& column : signals->columns) {
      names.push_back(column.name());
      units.push_back(column.unit());
    }
  }
  tolerances.require_use(names, units);
}

}  // namespace

Differences compare_signals(const RecordedSignals& a, const RecordedSignals& b,
                            const Settings& settings, const Selection& selection,
                            const std::string& file) {
  const Tolerances tolerances(settings.tolerance, settings.tolerances);
  require_use(tolerances, a, b);
  const ColumnPairs columns = pair_columns(a, b, selection);
  Differences differences;
  add_unpaired(columns, file, differences);
  const SignalComparison comparison(a, b, settings, tolerances, file);
  if (comparison.instants()) differences.push_back(*comparison.instants());
  for (const auto& [mine, other] : columns.both) {
    if (auto difference = comparison.compare(*mine, *other)) {
      differences.push_back(*std::move(difference));
    }
  }
  return differences;
}

}  // namespace stride::compare
