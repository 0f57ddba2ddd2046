#include "master/engine/run/loops/loop_derivatives.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "master/engine/run/loops/ordered_evaluation.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;

namespace {

constexpr ValueReference kInput = 0, kOutput = 1;

/// A unit of two inputs and two outputs, whose derivatives are the matrix, row by row.
ScriptedUnit& linear(ScriptedSystem& system, const std::string& name,
                     const BaseUnitOfMeasure& meaning, std::vector<double> matrix) {
  ScriptedUnit& unit = system.add(name, Describe("linear")
                                            .unit("unit", meaning)
                                            .add("u", ValueType::Float64, Causality::Input, "unit")
                                            .size(2)
                                            .add("y", ValueType::Float64, Causality::Output, "unit")
                                            .size(2)
                                            .depends_on({kInput})
                                            .directional_derivatives()
                                            .done());
  unit.on_derivative = [matrix](ScriptedUnit&, ValueReference unknown, ValueReference known) {
    CHECK(unknown == kOutput);
    CHECK(known == kInput);
    return matrix;
  };
  return unit;
}

/// x = cos x, with a unit that knows its derivative or does not.
struct Cosine : ScriptedSystem {
  explicit Cosine(bool knows_derivative) {
    Describe description("cosine");
    if (knows_derivative) description.directional_derivatives();
    auto& unit = add("a", description.input("u").output("y").depends_on({kInput}).done());
    unit.on_initialize = [](ScriptedUnit& self) {
      self.number(kOutput) = std::cos(self.number(kInput));
    };
    unit.on_derivative = [](ScriptedUnit& self, ValueReference, ValueReference) {
      return std::vector{-std::sin(self.number(kInput))};
    };
    wire("a", "y", "a", "u");
  }
};

std::size_t count(const ScriptedUnit& unit, const std::string& call) {
  return static_cast<std::size_t>(std::count(unit.calls.begin(), unit.calls.end(), call));
}

}  // namespace

TEST_CASE("the chain rule runs through arrays and units of measurement") {
  ScriptedSystem f;
  const BaseUnitOfMeasure metre{{0, 1}, 1, 0};
  const BaseUnitOfMeasure millimetre{{0, 1}, 1e-3, 0};
  linear(f, "a", metre, {1, 2, 3, 4});
  linear(f, "b", millimetre, {5, 0, 7, 11});
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "a", "u");
  const System system(f.declaration);
  const auto order = evaluation_order(system, Phase::Initialization);
  REQUIRE(order.size() == 1);
  REQUIRE(LoopDerivatives::exist(system, order[0]));
  REQUIRE(order[0].tearing_variables.size() == 1);
  LoopDerivatives derivatives(system, f.units, order[0]);
  std::vector<double> first(2), second(2);
  derivatives.derive(0, 0, first);
  derivatives.derive(0, 1, second);
  // the loop is torn before one of the two; the product of the matrices is that of the other then
  const bool torn_before_a = order[0].tearing_variables[0].inputs[0].id.component == 0;
  if (torn_before_a) {
    CHECK(first == std::vector<double>{5, 40});    // b (a e1), in metres again
    CHECK(second == std::vector<double>{10, 58});  // b (a e2)
  } else {
    CHECK(first == std::vector<double>{19, 43});   // a (b e1)
    CHECK(second == std::vector<double>{22, 44});  // a (b e2)
  }
}

TEST_CASE("a loop is solved with the derivatives of its units, if all provide them") {
  Cosine with(true);
  Cosine without(false);
  for (Cosine* system : {&with, &without}) {
    ScriptedUnit& unit = *system->instances[0];
    system->build(0.001, std::chrono::milliseconds(1)).run();
    CHECK(unit.number(kInput) == Approx(0.73908513321516064).epsilon(1e-14));
  }
  CHECK(count(*with.instances[0], "get_directional_derivative") > 0);
  CHECK(count(*without.instances[0], "get_directional_derivative") == 0);
  CHECK(with.instances[0]->gets < without.instances[0]->gets);
}

TEST_CASE("derivatives are of no use where something else than real numbers is in the loop") {
  ScriptedSystem f;
  f.add("a", Describe("a")
                 .add("u", ValueType::Boolean, Causality::Input)
                 .add("y", ValueType::Boolean, Causality::Output)
                 .depends_on({kInput})
                 .directional_derivatives()
                 .done());
  f.wire("a", "y", "a", "u");
  const System system(f.declaration);
  CHECK_FALSE(
      LoopDerivatives::exist(system, evaluation_order(system, Phase::Initialization).front()));
}
