#include <fmt/format.h>

#include "master/study/verify/checks.h"
#include "master/study/verify/start_values.h"

namespace stride::verify {

namespace {

/// The values with which an instance begins, of all variables that can be read then.
std::vector<core::ValueBlock> beginning(const core::UnitDescription& unit, TestInstance& instance) {
  std::vector<core::ValueBlock> values;
  instance.enter_initialization();
  for (const core::Variable& variable : unit.variables) {
    if (variable.is_unclocked_value()) values.push_back(instance.get(variable));
  }
  return values;
}

/// Likewise, which must be these.
void compare_beginning(const core::UnitDescription& unit, TestInstance& instance,
                       const std::vector<core::ValueBlock>& expected, const std::string& when) {
  instance.enter_initialization();
  auto value = expected.begin();
  for (const core::Variable& variable : unit.variables) {
    if (variable.is_unclocked_value()) {
      expect_value(instance, variable, *value++, when, "in a new instance it is");
    }
  }
}

}  // namespace

Finding check_reset(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  const Recording fresh = trial.record();
  const core::UnitDescription& unit = tested.description();
  TestInstance instance = trial.make_instance();
  const std::vector<core::ValueBlock> values = beginning(unit, instance);
  instance.reset();
  const auto compare = [&](const char* state) {
    instance.reset();
    compare_beginning(unit, instance, values,
                      fmt::format("in Initialization Mode after a reset {}", state));
    instance.reset();
    instance.start();
    instance.run_to(tested.steps());
    const auto differs = difference(tested, fresh.rows, instance.recording().rows,
                                    "in a new instance", fmt::format("after a reset {}", state));
    if (differs) throw Failure(*differs);
  };
  instance.start();
  instance.run_to(trial.point_at(0.6));
  compare("in Step Mode");
  instance.terminate();
  compare("of a terminated instance");
  instance.reset();
  instance.set_start_values();
  instance.enter_initialization();
  compare("in Initialization Mode");
  return passed(fmt::format("three runs of {} steps after a reset are like that of a new instance",
                            tested.steps()));
}

}  // namespace stride::verify
