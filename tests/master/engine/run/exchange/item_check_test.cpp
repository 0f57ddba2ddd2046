#include "master/engine/run/exchange/item_check.h"

#include <memory>
#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

const EnumerationItems kSignal{{"red", 1}, {"green", 2}, {"off", 5}};

std::shared_ptr<const UnitDescription> with_items(const UnitDescription& described) {
  auto description = std::make_shared<UnitDescription>(described);
  for (Variable& variable : description->variables) {
    if (variable.type == ValueType::Enumeration) variable.items = kSignal;
  }
  return description;
}

std::shared_ptr<const UnitDescription> signal_unit(const std::string& name, Causality causality) {
  return with_items(*Describe(name).add("mode", ValueType::Enumeration, causality).done());
}

std::int64_t& mode(ScriptedUnit& unit, ValueReference reference = 0) {
  return unit.block(reference).numbers<std::int64_t>()[0];
}

/// A unit whose output is an item for a second, and then this number.
ScriptedSystem system_with(std::int64_t number) {
  ScriptedSystem system;
  ScriptedUnit& a = system.add("a", signal_unit("a", Causality::Output));
  a.on_initialize = [](ScriptedUnit& self) { mode(self) = 1; };
  a.on_step = [number](ScriptedUnit& self, Time, Time to) {
    mode(self) = to_seconds(to) < 2 ? 5 : number;
    return reached(to);
  };
  return system;
}

}  // namespace

TEST_CASE("a value that is not an item ends the run, whether it is connected or recorded") {
  const bool is_connected = GENERATE(true, false);
  ScriptedSystem system = system_with(3);
  if (is_connected) {
    system.add("b", signal_unit("b", Causality::Input));
    system.wire("a", "mode", "b", "mode");
  }
  system.build(3, std::chrono::seconds(1), {{0, 0}});
  CHECK_THAT(failure(*system.simulation),
             Contains("unit 'a', variable 'mode', at 2 s: the unit gives 3, which is not an item "
                      "of its Enumeration: red (1), green (2), off (5)"));
}

TEST_CASE("items, and what nobody reads, are no mistake") {
  ScriptedSystem items = system_with(2);
  CHECK(failure(items.build(3, std::chrono::seconds(1), {{0, 0}})) == "none");
  ScriptedSystem unread = system_with(3);
  CHECK(failure(unread.build(3, std::chrono::seconds(1))) == "none");
}

TEST_CASE("before its first step, a unit may give what is not an item, which is said once") {
  const std::int64_t later = GENERATE(5, 0);
  ScriptedSystem system;
  ScriptedUnit& a = system.add("a", signal_unit("a", Causality::Output));
  a.on_initialize = [](ScriptedUnit& self) { mode(self) = 0; };
  a.on_step = [later](ScriptedUnit& self, Time, Time to) {
    mode(self) = later;
    return reached(to);
  };
  system.add("b", signal_unit("b", Causality::Input));
  system.wire("a", "mode", "b", "mode");
  std::vector<std::string> warnings;
  system.options.warn = [&](const std::string& text) { warnings.push_back(text); };
  const std::string result = failure(system.build(3, std::chrono::seconds(1), {{0, 0}}));
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("unit 'a', variable 'mode', at 0 s: the unit gives 0") &&
                              Contains("until the unit's first step"));
  if (later == 5) {
    CHECK(result == "none");
  } else {
    CHECK_THAT(result, Contains("at 1 s: the unit gives 0, which is not an item"));
  }
}

TEST_CASE("a message whose value is not an item ends the run") {
  ScriptedSystem system;
  ScriptedUnit& a =
      system.add("a", with_items(*Describe("a")
                                      .add("clock", ValueType::Clock, Causality::Output)
                                      .add("mode", ValueType::Enumeration, Causality::Output)
                                      .clocked_by(0)
                                      .done()));
  a.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.clock(0) = true;
    mode(self, 1) = 7;
    StepResult result = reached(to);
    result.event_handling_needed = true;
    return result;
  };
  a.on_event = [](ScriptedUnit& self) {
    self.clock(0) = false;
    return EventResult{};
  };
  system.build(2, std::chrono::seconds(1));
  CHECK_THAT(failure(*system.simulation),
             Contains("unit 'a', variable 'mode', at 1 s: the unit gives 7, which is not an item"));
}

TEST_CASE("an integer that becomes no item of an output of the system ends the run") {
  ScriptedSystem system;
  ScriptedUnit& a =
      system.add("a", Describe("a").add("n", ValueType::Int32, Causality::Output).done());
  a.on_initialize = [](ScriptedUnit& self) { self.block(0).numbers<std::int32_t>()[0] = 2; };
  a.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.block(0).numbers<std::int32_t>()[0] = 4;
    return reached(to);
  };
  const PathConnector connector{"mode", ValueType::Enumeration, {}, kSignal, false};
  system.declaration.outputs = {{"a", "n", {{connector, {}}}, {}}};
  system.build(2, std::chrono::seconds(1), {{1, 0}});
  CHECK_THAT(failure(*system.simulation),
             Contains("variable 'mode', at 1 s: 'a.n' gives it 4, which is not an item"));
}
