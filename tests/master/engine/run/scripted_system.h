// A system of scripted units, and a simulation of it.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_SCRIPTED_SYSTEM_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_SCRIPTED_SYSTEM_H

#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "master/engine/run/simulation.h"
#include "tests/master/engine/run/scripted_unit.h"

namespace stride::core {

/// Units wired as the test defines; the instances stay reachable while the simulation
/// owns them.
struct ScriptedSystem {
  SystemDeclaration declaration;
  std::vector<ScriptedUnit*> instances;
  std::vector<std::unique_ptr<Unit>> units;
  std::unique_ptr<System> system;
  std::unique_ptr<Simulation> simulation;
  RunOptions options;

  template <class SomeUnit = ScriptedUnit>
  SomeUnit& add(const std::string& name, std::shared_ptr<const UnitDescription> description) {
    declaration.components.push_back({name, description, {}, {}});
    auto unit = std::make_unique<SomeUnit>(description);
    SomeUnit& added = *unit;
    instances.push_back(&added);
    units.push_back(std::move(unit));
    return added;
  }
  void wire(const std::string& from, const std::string& from_connector, const std::string& to,
            const std::string& to_connector) {
    declaration.connections.push_back({from, from_connector, to, to_connector, false, {}});
  }
  Simulation& build(double stop, const Interval& step, std::vector<VariableId> recorded = {}) {
    system = std::make_unique<System>(declaration);
    options.stop = time_from_seconds(stop);
    options.step.size = step;
    options.recorded = std::move(recorded);
    simulation = std::make_unique<Simulation>(*system, std::move(units), options);
    return *simulation;
  }
};

/// The error of a run that fails; "none" of one that does not.
inline std::string failure(Simulation& simulation) {
  try {
    simulation.run();
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Run);
    return error.what();
  }
  return "none";
}

/// Notes the communication points.
struct Points : Observer {
  std::vector<Time> times;
  void on_communication_point(Time time) override { times.push_back(time); }
};

/// Those of a run of the system.
inline std::vector<Time> points(ScriptedSystem& system, double stop, const Interval& step) {
  Points points;
  system.build(stop, step).add_observer(points);
  system.simulation->run();
  return points.times;
}

/// The step that a unit makes when all is well.
inline StepResult reached(Time time) {
  StepResult result;
  result.reached = time;
  return result;
}

}  // namespace stride::core

#endif
