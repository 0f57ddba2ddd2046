#include "master/engine/model/system/upstream.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;

namespace {

/// a -> b -> c <-> d, and e on its own.
System chain() {
  SystemDeclaration declaration;
  declaration.name = "chain";
  const auto unit = Describe("model").input("u").input("v").output("y").done();
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    declaration.components.push_back({name, unit, {}, {}});
  }
  const auto connect = [&](const char* from, const char* to, const char* input) {
    declaration.connections.push_back({from, "y", to, input, false, {}});
  };
  connect("a", "b", "u");
  connect("b", "c", "u");
  connect("c", "d", "u");
  connect("d", "c", "v");
  return System(declaration);
}

using Components = std::vector<std::size_t>;

}  // namespace

TEST_CASE("an output may depend on its unit and on all that leads to it") {
  const System system = chain();
  CHECK(components_upstream(system, {0, 2}) == Components{0});
  CHECK(components_upstream(system, {1, 2}) == Components{1, 0});
  CHECK(components_upstream(system, {3, 2}) == Components{3, 2, 1, 0});
  CHECK(components_upstream(system, {4, 2}) == Components{4});
}

TEST_CASE("an input depends on what it is connected to, and not on its own unit") {
  const System system = chain();
  CHECK(components_upstream(system, {1, 0}) == Components{0});
  CHECK(components_upstream(system, {2, 0}) == Components{1, 0});
  CHECK(components_upstream(system, {3, 0}) == Components{2, 1, 3, 0});  // in a circle
  CHECK(components_upstream(system, {0, 0}).empty());
}
