#include "master/study/verify/idle_comparison.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/engine/run/idle/idle_agreement.h"
#include "master/study/verify/idle_run.h"

namespace stride::verify {
namespace {

using core::Variable;

struct Difference {
  Time time;
  std::string text;
};

std::vector<Row> rows_of(const Recording& recording, bool events) {
  std::vector<Row> rows;
  std::ranges::copy_if(recording.rows, std::back_inserter(rows),
                       [&](const Row& row) { return row.is_event == events; });
  return rows;
}

std::string what_ticked(const Row& row) {
  std::string text;
  for (const std::string& value : row.values) text += (text.empty() ? "" : ", ") + value;
  return text;
}

bool are_near(const std::string& one, const std::string& other, double tolerance) {
  std::istringstream here(one), there(other);
  std::string a, b;
  while (here >> a && there >> b) {
    if (a == b) continue;
    const double x = std::strtod(a.c_str(), nullptr);
    const double y = std::strtod(b.c_str(), nullptr);
    const double greatest = std::max({1.0, std::abs(x), std::abs(y)});
    if (!core::agree_when_idle(x, y, tolerance, greatest)) return false;
  }
  return true;
}

class Comparison {
 public:
  Comparison(const TestedUnit& tested, Wander wander) : tested_(tested), wander_(wander) {
    for (const std::size_t i : promised_outputs(tested.description())) {
      outputs_.push_back(&tested.description().variables[i]);
    }
  }

  std::optional<Difference> of_events(const std::vector<Row>& full,
                                      const std::vector<Row>& skipping) const {
    const Duration shift = wander_ == Wander::Still ? Duration{} : tested_.step();
    const std::size_t common = std::min(full.size(), skipping.size());
    for (std::size_t i = 0; i < common; ++i) {
      const Duration apart = std::chrono::abs(full[i].time - skipping[i].time);
      if (apart <= shift && full[i].values == skipping[i].values) continue;
      return Difference{std::min(full[i].time, skipping[i].time),
                        fmt::format("the event {} is at {} s, and without skipping {} is at {} s",
                                    what_ticked(skipping[i]), core::to_text(skipping[i].time),
                                    what_ticked(full[i]), core::to_text(full[i].time))};
    }
    if (full.size() == skipping.size()) return std::nullopt;
    const bool is_missing = skipping.size() < full.size();
    const Row& row = (is_missing ? full : skipping)[common];
    const Time end = tested_.point(tested_.steps());
    if (row.time + shift >= end && shift > Duration{}) return std::nullopt;
    return Difference{row.time, fmt::format("there is {}the event {} at {} s",
                                            is_missing ? "without skipping only " : "",
                                            what_ticked(row), core::to_text(row.time))};
  }

  std::optional<Difference> of_points(const std::vector<Row>& full,
                                      const std::vector<Row>& skipping) const {
    const std::size_t common = std::min(full.size(), skipping.size());
    for (std::size_t row = 0; row < common; ++row) {
      for (std::size_t i = 0; i < outputs_.size(); ++i) {
        if (agrees(full, skipping[row], row, i)) continue;
        return Difference{
            full[row].time,
            fmt::format("at {} s '{}' is {}, and {} without skipping{}",
                        core::to_text(full[row].time), outputs_[i]->name, skipping[row].values[i],
                        full[row].values[i], allowance_text(skipping[row], *outputs_[i]))};
      }
    }
    if (full.size() == skipping.size()) return std::nullopt;
    const Time end = common == 0 ? Time() : full[common - 1].time;
    return Difference{end,
                      fmt::format("after {} s only the run {} skipping goes on", core::to_text(end),
                                  skipping.size() < full.size() ? "without" : "with")};
  }

 private:
  static double allowance(const Row& skipping, const Variable& output) {
    const double promises = std::strtod(skipping.values.back().c_str(), nullptr);
    return output.tolerance.value_or(0) * std::max(1.0, promises);
  }
  static std::string allowance_text(const Row& skipping, const Variable& output) {
    if (!output.tolerance) return "";
    return fmt::format(", with a tolerance of {} and {} promises so far", *output.tolerance,
                       skipping.values.back());
  }
  bool equals(const Row& full, const Row& skipping, std::size_t i) const {
    if (full.values[i] == skipping.values[i]) return true;
    return core::is_real(outputs_[i]->type) &&
           are_near(full.values[i], skipping.values[i], allowance(skipping, *outputs_[i]));
  }
  bool agrees(const std::vector<Row>& full, const Row& skipping, std::size_t row,
              std::size_t i) const {
    const std::size_t reach = wander_ == Wander::Still ? 0 : 1;
    const std::size_t last = std::min(row + reach, full.size() - 1);
    for (std::size_t other = row - std::min(row, reach); other <= last; ++other) {
      if (equals(full[other], skipping, i)) return true;
    }
    return false;
  }

  const TestedUnit& tested_;
  Wander wander_;
  std::vector<const Variable*> outputs_;
};

}  // namespace

std::optional<std::string> idle_difference(const TestedUnit& tested, const Recording& full,
                                           const Recording& skipping, Wander wander) {
  const Comparison comparison(tested, wander);
  const auto event = comparison.of_events(rows_of(full, true), rows_of(skipping, true));
  const auto point = comparison.of_points(rows_of(full, false), rows_of(skipping, false));
  if (event && point) return (event->time <= point->time ? event : point)->text;
  if (event) return event->text;
  if (point) return point->text;
  return std::nullopt;
}

}  // namespace stride::verify
