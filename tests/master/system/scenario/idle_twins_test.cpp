#include "master/system/scenario/idle_twins.h"

#include <memory>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::scenario;

namespace {

core::ComponentDeclaration component(const std::string& name, bool promises_idle) {
  core::UnitDescription unit;
  unit.promises_idle = promises_idle;
  return {name, std::make_shared<const core::UnitDescription>(unit), {}};
}

}  // namespace

TEST_CASE("a twin has the start values and the sources of its unit, and nothing is fed by it") {
  core::SystemDeclaration system;
  system.components = {component("source", false), component("idler", true),
                       component("sink", true)};
  system.connections = {{"source", "y", "idler", "u"}, {"idler", "y", "sink", "u"}};
  system.start_values = {{"source", "k", "1", {}}, {"idler", "k", "2", {}}};

  const std::vector<IdleTwin> twins = add_idle_twins(system);

  REQUIRE(twins.size() == 2);
  CHECK(twins[0].unit == 1);
  CHECK(twins[0].twin == 3);
  CHECK(twins[1].unit == 2);
  CHECK(twins[1].twin == 4);
  REQUIRE(system.components.size() == 5);
  const std::string& idler = system.components[3].name;
  const std::string& sink = system.components[4].name;
  CHECK(idler == "idler (never suspended)");
  REQUIRE(system.connections.size() == 4);
  CHECK(system.connections[2].from_component == "source");
  CHECK(system.connections[2].to_component == idler);
  CHECK(system.connections[3].from_component == "idler");
  CHECK(system.connections[3].to_component == sink);
  REQUIRE(system.start_values.size() == 3);
  CHECK(system.start_values[2].component == idler);
  CHECK(system.start_values[2].value == "2");
}
