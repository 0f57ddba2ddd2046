#include "master/engine/run/exchange/system_outputs.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;

namespace {

OutputDeclaration output(const std::string& name, const std::string& variable,
                         Transformation transformation = {}) {
  return {"a", variable, {{{name, {}, {}, {}, false}, {false, std::move(transformation)}}}, {}};
}

ScriptedSystem counting_system() {
  ScriptedSystem system;
  ScriptedUnit& a = system.add("a", Describe("a").output("y", "m").output("z").done());
  a.on_step = [](ScriptedUnit& self, Time, Time to) {
    self.number(0) = to_seconds(to);
    return reached(to);
  };
  system.declaration.outputs = {
      output("level", "y", {Transformation::Kind::Linear, {10, 1}, {}, {}, {}}),
      output("a.z", "y")};
  return system;
}

/// What a signal is at the communication points.
struct Values : Observer {
  std::vector<Signal> signals;
  std::vector<double> seen;
  void on_start(std::span<const Signal> all) override { signals.assign(all.begin(), all.end()); }
  void on_communication_point(Time) override {
    for (const Signal& signal : signals) seen.push_back(real(*signal.block, signal.first));
  }
};

}  // namespace

TEST_CASE("an output of the system follows its variable, converted, at each communication point") {
  ScriptedSystem system = counting_system();
  const VariableId level{1, 0};
  system.build(2, std::chrono::seconds(1), {{0, 0}, level});
  REQUIRE(system.system->is_output(level));
  CHECK(system.system->full_name(level) == "level");
  CHECK(system.system->variable(level).unit == "m");
  Values values;
  system.simulation->add_observer(values);
  system.simulation->run();
  CHECK(values.seen == std::vector<double>{0, 1, 1, 11, 2, 21});
}

TEST_CASE("a name that a variable has belongs to the variable") {
  ScriptedSystem system = counting_system();
  system.build(1, std::chrono::seconds(1));
  REQUIRE(system.system->outputs().size() == 1);
  CHECK(system.system->outputs()[0].variable.name == "level");
}
