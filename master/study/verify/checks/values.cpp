#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/study/verify/checks.h"
#include "master/study/verify/start_values.h"

namespace stride::verify {
namespace {

using core::Causality;
using core::Initial;
using core::ValueBlock;
using core::ValueType;
using core::Variable;

/// Sets each start value that can be set, reads them back, before and after the initialization.
void examine_start(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  TestInstance instance = trial.make_instance();
  const bool is_readable_at_once = unit.fmi_version.starts_with("3");
  if (is_readable_at_once) expect_start_values(unit, instance, "in a new instance");
  for (const Variable& variable : unit.variables) {
    const bool is_set =
        has_exact_start(variable) && variable.variability != core::Variability::Constant;
    if (is_set) instance.set(variable, start_value(variable));
  }
  instance.enter_initialization();
  expect_start_values(unit, instance, "in Initialization Mode");
  for (const Variable& variable : unit.variables) {
    if (variable.causality != Causality::Input || !has_exact_start(variable)) continue;
    const ValueBlock other = other_value(variable, start_value(variable));
    instance.set(variable, other);
    expect_value(instance, variable, other, "in Initialization Mode", "it was set to");
    instance.set(variable, start_value(variable));
  }
  instance.exit_initialization();
  for (const Variable& variable : unit.variables) {
    const bool is_kept =
        variable.causality == Causality::Input || variable.causality == Causality::Parameter;
    if (is_kept && has_exact_start(variable)) {
      expect_value(instance, variable, start_value(variable), "after the initialization",
                   "it was set to");
    } else if (variable.is_unclocked_value()) {
      instance.get(variable);
    }
  }
}

/// What is declared of the numbers of a column.
struct Range {
  const Variable* variable;
  bool is_checked;
  double low, high;
};

std::vector<Range> ranges(const TestedUnit& tested) {
  std::vector<Range> ranges;
  for (const TestedUnit::Group& group : tested.observed()) {
    for (const std::size_t i : group.places) {
      const Variable& variable = tested.description().variables[i];
      const bool is_number = variable.type != ValueType::String &&
                             variable.type != ValueType::Binary &&
                             variable.type != ValueType::Boolean;
      ranges.push_back({&variable, is_number,
                        variable.min.empty() ? -HUGE_VAL : std::stod(variable.min),
                        variable.max.empty() ? HUGE_VAL : std::stod(variable.max)});
    }
  }
  return ranges;
}

void examine_row(const std::vector<Range>& ranges, const Row& row) {
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto& [variable, is_checked, low, high] = ranges[i];
    if (!is_checked) continue;
    std::istringstream words(row.values[i]);
    for (std::string word; words >> word;) {
      const double number = std::strtod(word.c_str(), nullptr);
      const std::string at =
          fmt::format("at {} s '{}' is {}", core::to_text(row.time), variable->name, word);
      if (std::isnan(number)) throw Failure(at);
      if (number < low) throw Failure(at + ", which is below its min " + variable->min);
      if (number > high) throw Failure(at + ", which is above its max " + variable->max);
    }
  }
}

}  // namespace

Finding check_values(const Trial& trial) {
  const Recording run = trial.record();
  examine_start(trial);
  const std::vector<Range> declared = ranges(trial.tested);
  for (const Row& row : run.rows) {
    if (!row.is_event) examine_row(declared, row);
  }
  const auto& variables = trial.tested.description().variables;
  const auto starts = std::count_if(variables.begin(), variables.end(), has_exact_start);
  return passed(fmt::format("{}, {} in {} to {} s{}", core::counted(starts, "start value"),
                            core::counted(trial.tested.observed_count(), "value"),
                            core::counted(trial.tested.steps(), "step"),
                            core::to_text(trial.tested.point(trial.tested.steps())),
                            run.has_ended ? "; it ended the run before" : ""));
}

}  // namespace stride::verify
