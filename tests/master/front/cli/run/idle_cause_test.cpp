#include "master/front/cli/run/idle_cause.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

constexpr std::size_t kUnits = 9;

/// u0 -> u1 -> … -> u7, and u8 on its own.
System chain() {
  SystemDeclaration declaration;
  declaration.name = "chain";
  const auto unit = Describe("model").input("u").output("y").done();
  for (std::size_t i = 0; i < kUnits; ++i) {
    const std::string name = "u" + std::to_string(i);
    declaration.components.push_back({name, unit, {}, {}});
    if (i == 0 || i + 1 == kUnits) continue;
    declaration.connections.push_back({"u" + std::to_string(i - 1), "y", name, "u", false, {}});
  }
  return System(declaration);
}

/// The hint on the output of a unit, or on no variable, where these units were suspended.
std::string hint(const std::vector<std::size_t>& suspended, std::optional<std::size_t> unit) {
  RunStatistics statistics;
  statistics.units.resize(kUnits);
  for (const std::size_t i : suspended) statistics.units[i].suspensions = 1;
  std::optional<VariableId> variable;
  if (unit) variable = VariableId{*unit, 1};
  return stride::cli::hint_on_cause(chain(), statistics, variable);
}

}  // namespace

TEST_CASE("units that were suspended, and on which a variable depends, are named") {
  CHECK_THAT(hint({0}, 0), Contains("depends on 'u0', which was suspended"));
  CHECK_THAT(hint({0, 2, 3, 8}, 2), Contains("depends on 'u2', 'u0', which were suspended"));
  CHECK_THAT(hint({0, 8}, {}), Contains("depends on 'u0', 'u8', which were suspended"));
  CHECK_THAT(hint({0, 1, 2, 3, 4, 5, 6, 7}, 7),
             Contains("on 'u7', 'u6', 'u5', 'u4', 'u3' and 3 others, which"));
}

TEST_CASE("without such a unit there is another reason") {
  CHECK_THAT(hint({1, 8}, 0), Contains("depends on no unit that was suspended"));
  CHECK_THAT(hint({}, {}), Contains("depends on no unit that was suspended"));
}
