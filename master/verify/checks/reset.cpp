#include <fmt/format.h>

#include "master/verify/checks.h"
#include "master/verify/start_values.h"

namespace stride::verify {

namespace {

/// The values with which an instance begins, of all variables that can be read then.
std::vector<core::ValueBlock> beginning(const core::UnitDescription& unit, Life& life) {
  std::vector<core::ValueBlock> values;
  life.enter_initialization();
  for (const core::Variable& variable : unit.variables) {
    if (is_readable(variable)) values.push_back(life.get(variable));
  }
  return values;
}

/// Likewise, which must be these.
void compare_beginning(const core::UnitDescription& unit, Life& life,
                       const std::vector<core::ValueBlock>& expected, const std::string& when) {
  life.enter_initialization();
  auto value = expected.begin();
  for (const core::Variable& variable : unit.variables) {
    if (is_readable(variable)) {
      expect_value(life, variable, *value++, when, "in a new instance it is");
    }
  }
}

}  // namespace

Finding check_reset(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  const Recording fresh = trial.record();
  const core::UnitDescription& unit = tested.description();
  Life life = trial.live();
  const std::vector<core::ValueBlock> values = beginning(unit, life);
  life.reset();
  const auto compare = [&](const char* state) {
    life.reset();
    compare_beginning(unit, life, values,
                      fmt::format("in Initialization Mode after a reset {}", state));
    life.reset();
    life.start();
    life.run_to(tested.steps());
    const auto differs = difference(tested, fresh.rows, life.recording().rows, "in a new instance",
                                    fmt::format("after a reset {}", state));
    if (differs) throw Failure(*differs);
  };
  life.start();
  life.run_to(trial.point_at(0.6));
  compare("in Step Mode");
  life.terminate();
  compare("of a terminated instance");
  life.reset();
  life.set_start_values();
  life.enter_initialization();
  compare("in Initialization Mode");
  return passed(fmt::format("three runs of {} steps after a reset are like that of a new instance",
                            tested.steps()));
}

}  // namespace stride::verify
