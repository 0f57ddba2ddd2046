#include "master/observe/checks/checks.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"
#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;
using namespace std::chrono_literals;
using core::ValueType;

namespace {

/// A unit whose outputs y and z are the time [s] and twice it.
core::ScriptedSystem clocks() {
  core::ScriptedSystem system;
  core::ScriptedUnit& a = system.add("a", core::Describe("a").output("y").output("z").done());
  a.on_step = [](core::ScriptedUnit& unit, Time, Time to) {
    unit.number(0) = to_seconds(to);
    unit.number(1) = 2 * to_seconds(to);
    return core::reached(to);
  };
  return system;
}

Definition at_most(const std::string& name, std::size_t output, const std::string& max) {
  ConditionText text;
  text.max = max;
  return {Kind::Always,
          name,
          name,
          {},
          {},
          SignalDemand{{0, output}, 0, name, "", Condition(variable(ValueType::Float64), text)}};
}

Definition messages(const std::string& name, std::size_t output) {
  return {Kind::Count, name, name, {}, {}, CountDemand{{0, output}, 0, 0}};
}

}  // namespace

TEST_CASE("checks see their own signals, recorded or not, in their own order") {
  core::ScriptedSystem system = clocks();
  Checks checks({at_most("z", 1, "0.005"), messages("m", 1), at_most("y", 0, "0.005"),
                 at_most("y again", 0, "0.002")});
  CHECK(checks.signals() == std::vector<core::VariableId>{{0, 1}, {0, 0}, {0, 0}});
  system.options.watched = checks.signals();
  system.build(0.005, 1ms, {{0, 0}}).add_observer(checks, checks.signals());
  system.simulation->run();
  const auto verdicts = checks.verdicts(ended(5));
  REQUIRE(verdicts.size() == 4);
  CHECK((verdicts[0].name == "z" && verdicts[0].time == at(3)));
  CHECK((verdicts[1].name == "m" && verdicts[1].passed == true));
  CHECK((verdicts[2].name == "y" && verdicts[2].passed == true));
  CHECK((verdicts[3].name == "y again" && verdicts[3].time == at(3)));
}

TEST_CASE("a run that never began leaves all open") {
  const Checks checks({at_most("y", 0, "1"), messages("m", 1)});
  for (const core::Verdict& verdict : checks.verdicts(broke(0))) CHECK_FALSE(verdict.passed);
}

TEST_CASE("without checks there is nothing") {
  const Checks checks({});
  CHECK((checks.is_empty() && checks.signals().empty() && checks.verdicts(ended(1)).empty()));
}
