#include "master/report/default_plots.h"

#include <catch2/catch.hpp>

using namespace stride::report;
using stride::core::ValueType;
using stride::recorders::Plot;

namespace {

Column column(const std::string& name, const std::string& unit,
              ValueType type = ValueType::Float64) {
  return Column(SignalInfo{name, unit, type, true});
}

}  // namespace

TEST_CASE("real numbers are grouped by component and unit, all else by component") {
  const std::vector<Column> columns = {column("a.x", "m"),
                                       column("a.led", "", ValueType::Boolean),
                                       column("b.x", "m"),
                                       column("a.v", "m/s"),
                                       column("a.y", "m"),
                                       column("a.count", "", ValueType::UInt64),
                                       column("b.gain", "", ValueType::Float32)};
  const std::vector<RunFile::Component> components = {{"a", "A"}, {"b", "B"}};
  CHECK(default_plots(columns, components) ==
        std::vector<Plot>{{"a [m]", {"a.x", "a.y"}},
                          {"a: states and counts", {"a.led", "a.count"}},
                          {"b [m]", {"b.x"}},
                          {"a [m/s]", {"a.v"}},
                          {"b", {"b.gain"}}});
}

TEST_CASE("a component of a nested system is the longest that the name begins with") {
  const std::vector<Column> columns = {column("arm.motor.speed", ""), column("arm.x", ""),
                                       column("armada.x", ""), column("height", "m")};
  const std::vector<RunFile::Component> components = {{"arm", "A"}, {"arm.motor", "M"}};
  CHECK(default_plots(columns, components) == std::vector<Plot>{{"arm.motor", {"arm.motor.speed"}},
                                                                {"arm", {"arm.x"}},
                                                                {"outputs", {"armada.x"}},
                                                                {"outputs [m]", {"height"}}});
}

TEST_CASE("where the components are not known, the first point ends one") {
  const std::vector<Column> columns = {column("a.b.x", "m"), column("a.c", "m"), column("d", "m")};
  CHECK(default_plots(columns, {}) ==
        std::vector<Plot>{{"a [m]", {"a.b.x", "a.c"}}, {"d [m]", {"d"}}});
}
