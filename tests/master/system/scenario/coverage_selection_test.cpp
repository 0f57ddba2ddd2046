#include "master/system/scenario/coverage_selection.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;

namespace {

using Names = std::vector<std::string>;

/// The sample unit with an input that has a range, a received message, and one output of few
/// values.
core::System covered_system() {
  auto description = sample_description();
  auto& variables = description->variables;
  variables.push_back(variable("power", 20, ValueType::Float64, Causality::Input, "W"));
  variables.back().min = "0";
  variables.back().max = "2";
  variables.push_back(variable("level", 21, ValueType::UInt8, Causality::Input));
  variables.back().min = "1";
  variables.back().max = "3";
  variables.push_back(variable("receive.clock", 22, ValueType::Clock, Causality::Input));
  variables.back().clock.emplace();
  variables.push_back(variable("receive.frame", 23, ValueType::Binary, Causality::Input));
  variables.back().clocks = {22};
  core::SystemDeclaration declaration;
  declaration.name = "sample";
  declaration.components = {{"a", description, {}, {}}, {"b", description, {}, {}}};
  return core::System(declaration);
}

PointDeclaration point(PointKind kind, const std::string& subject) {
  PointDeclaration declared{.kind = kind, .subject = subject};
  declared.where = {"x.ssd", 12};
  return declared;
}

PointDeclaration cross(std::vector<std::string> of) {
  PointDeclaration declared{.kind = PointKind::Cross, .of = std::move(of)};
  declared.where = {"x.ssd", 13};
  return declared;
}

GroupDeclaration group(std::vector<PointDeclaration> points) {
  GroupDeclaration declared{.component = "a", .points = std::move(points)};
  declared.where = {"x.ssd", 10};
  return declared;
}

SelectedCoverage selected_coverage(const std::vector<GroupDeclaration>& groups,
                                   const std::vector<CoveredDeclaration>& demands = {}) {
  return select_coverage(covered_system(), groups, demands);
}

std::string coverage_mistake(const GroupDeclaration& declared,
                             const std::vector<CoveredDeclaration>& demands = {}) {
  return error_of([&] { selected_coverage({declared}, demands); });
}
std::string coverage_mistake(const PointDeclaration& declared) {
  return coverage_mistake(group({declared}));
}

Names point_names_of(const SelectedCoverage& coverage) {
  Names names;
  for (const auto& point : coverage.groups.at(0).points) names.push_back(point.name);
  return names;
}

Names bin_names(const coverage::PointDefinition& point) {
  Names names;
  for (const auto& bin : point.bins) names.push_back(bin.name + (bin.is_ignored ? "!" : ""));
  return names;
}

}  // namespace

TEST_CASE("a group without points gets automatic ones, and says for which inputs it cannot") {
  const SelectedCoverage coverage = selected_coverage({group({})});
  CHECK(point_names_of(coverage) == Names{"led", "led:transitions", "mode", "mode:transitions",
                                          "power", "level", "receive.frame:words",
                                          "receive.frame:lengths", "receive.frame:sequences",
                                          "receive.frame:gaps"});
  const auto& points = coverage.groups[0].points;
  CHECK(bin_names(points[2]) == Names{"off", "on <&>", "other!"});
  CHECK(points[4].bins.size() == 13);
  CHECK(points[4].unit == "W");
  CHECK(bin_names(points[5]) == Names{"1", "2", "3", "other!"});
  CHECK((points[6].is_open && points[7].is_open && points[8].is_open && !points[9].is_open));
  CHECK((points[6].is_text && points[0].id.component == 0));
  REQUIRE(coverage.notes.size() == 1);
  CHECK_THAT(coverage.notes[0], Contains("coverage of 'a'") && Contains("temperature") &&
                                    Contains("<stride:Values signal=\"temperature\" min="));
}

TEST_CASE("a glob, and an array as a whole, is a point for each, with the name before it") {
  PointDeclaration position = point(PointKind::Values, "position");
  position.edges = {0, 1};
  CHECK(point_names_of(selected_coverage({group({position})})) ==
        Names{"position[1]", "position[2]", "position[3]"});
  position.name = "where";
  CHECK(point_names_of(selected_coverage({group({position})}))[1] == "where: position[2]");
  position.subject = "position[2]";
  const SelectedCoverage one = selected_coverage({group({position})});
  CHECK((point_names_of(one) == Names{"where"} && one.groups[0].points[0].element == 1));
  PointDeclaration range = point(PointKind::Values, "range");
  range.edges = {0, 1};
  CHECK(point_names_of(selected_coverage({group({range})})) == Names{"distance"});
  CHECK(point_names_of(selected_coverage({group({point(PointKind::Gaps, "*")})})) ==
        Names{"transmit.frame:gaps", "tick:gaps", "receive.frame:gaps"});
}

TEST_CASE("bins are those that are written, else those of the range and the type") {
  PointDeclaration power = point(PointKind::Values, "power");
  power.bins = 2;
  CHECK(bin_names(selected_coverage({group({power})}).groups[0].points[0]) ==
        Names{"[0, 1)", "[1, 2]", "< 0!", "> 2!", "NaN!"});
  power.max = 4;
  CHECK(bin_names(selected_coverage({group({power})}).groups[0].points[0])[1] == "[2, 4]");
  PointDeclaration words = point(PointKind::Sequences, "receive.frame");
  words.words = {"read", "write"};
  CHECK(bin_names(selected_coverage({group({words})}).groups[0].points[0]) ==
        Names{"read -> read", "read -> write", "write -> read", "write -> write"});
  CHECK(selected_coverage({group({point(PointKind::Transitions, "level")})})
            .groups[0]
            .points[0]
            .bins.size() == 6);
}

TEST_CASE("what is ignored is so in points, and then not in their crosses") {
  PointDeclaration power = point(PointKind::Values, "power");
  power.bins = 2;
  GroupDeclaration declared =
      group({power, point(PointKind::Values, "led"), cross({"power", "led"})});
  declared.ignored = {{"power", "[0, 1)"}, {"* × *", "* × false"}};
  const SelectedCoverage coverage = selected_coverage({declared});
  const auto& points = coverage.groups[0].points;
  CHECK(bin_names(points[0])[0] == "[0, 1)!");
  CHECK(points[2].name == "power × led");
  CHECK(bin_names(points[2]) == Names{"[1, 2] × false!", "[1, 2] × true"});
  declared.ignored = {{"power", "[0, 3)"}};
  CHECK_THAT(coverage_mistake(declared), Contains("no point 'power' has a bin '[0, 3)'"));
  declared.ignored = {{"pwer", "*"}};
  CHECK_THAT(coverage_mistake(declared), Contains("no point 'pwer'") && Contains("'power'?"));
}

TEST_CASE("mistakes in points are named, with the nearest name") {
  CHECK_THAT(coverage_mistake(point(PointKind::Values, "lde")),
             Contains("x.ssd:12: the component has no signal 'lde'") && Contains("'led'?"));
  CHECK_THAT(coverage_mistake(point(PointKind::Values, "receive.frame")),
             Contains("'receive.frame' is not a signal") && Contains("<stride:Words>"));
  CHECK_THAT(coverage_mistake(point(PointKind::Words, "led")),
             Contains("'led' is not a message") && Contains("<stride:Values>"));
  CHECK_THAT(coverage_mistake(point(PointKind::Words, "receive.clock")),
             Contains("'receive.clock' is not a message") && Contains("name what the clock"));
  CHECK_THAT(coverage_mistake(point(PointKind::Values, "label")), Contains("it is a String"));
  CHECK_THAT(coverage_mistake(point(PointKind::Values, "temperature")),
             Contains("'temperature': it has no min and max; write min="));
  CHECK_THAT(coverage_mistake(point(PointKind::Transitions, "power")),
             Contains("an Enumeration") &&
                 Contains("cover its values in bins: <stride:Values signal=\"power\" min="));
  CHECK_THAT(coverage_mistake(point(PointKind::Transitions, "temperature")),
             Contains("<stride:Values signal=\"temperature\""));
  CHECK_THAT(coverage_mistake(point(PointKind::Lengths, "tick")), Contains("a Binary or a String"));
  CHECK_THAT(
      coverage_mistake(group({point(PointKind::Values, "led"), point(PointKind::Values, "l*d")})),
      Contains("a second point 'led'"));
}

TEST_CASE(
    "outputs that are messages since their clock is connected to a triggered one are covered so") {
  auto description = std::make_shared<core::UnitDescription>();
  description->has_event_mode = true;
  auto& variables = description->variables;
  variables.push_back(variable("tx", 1, ValueType::Clock, Causality::Input));
  variables.back().clock.emplace().variability = core::IntervalVariability::Countdown;
  variables.push_back(variable("out", 2, ValueType::Int32, Causality::Output));
  variables.back().clocks = {1};
  variables.push_back(variable("rx", 3, ValueType::Clock, Causality::Input));
  variables.back().clock.emplace();
  core::SystemDeclaration declaration;
  declaration.components = {{"a", description, {}, {}}, {"b", description, {}, {}}};
  declaration.connections.push_back({"a", "tx", "b", "rx", false, {}});
  const core::System system(declaration);
  PointDeclaration values = point(PointKind::Values, "out");
  values.edges = {0, 1};
  const PointDeclaration words = point(PointKind::Words, "out");
  const auto select = [&](const std::string& component, const PointDeclaration& declared) {
    GroupDeclaration of = group({declared});
    of.component = component;
    return error_of([&] { select_coverage(system, std::vector{of}, {}); });
  };
  CHECK(select("a", words) == "(no error)");
  CHECK_THAT(select("a", values), Contains("'out' is not a signal") && Contains("<stride:Words>"));
  CHECK(select("b", values) == "(no error)");
  CHECK_THAT(select("b", words), Contains("'out' is not a message"));
}

TEST_CASE("bins of integers that no value can be in are mistakes") {
  PointDeclaration level = point(PointKind::Values, "level");
  level.edges = {1, 1.5, 1.8, 3};
  CHECK_THAT(coverage_mistake(level), Contains("x.ssd:12: 'level': no UInt8 is in the bin [1.5,"));
  level.edges.clear();
  level.min = 250, level.max = 256;
  CHECK_THAT(coverage_mistake(level), Contains("'level': 256 is no UInt8"));
  level.min = 0.2, level.max = 0.8;
  CHECK_THAT(coverage_mistake(level), Contains("'level': no UInt8 is from 0.2 to 0.8"));
  level.min = 9.3e18, level.max = 9.4e18;
  CHECK_THAT(coverage_mistake(level), Contains("expected edges up to 9007199254740991"));
}

TEST_CASE("a goal of a group that has no percentage is a mistake") {
  GroupDeclaration declared = group({point(PointKind::Words, "receive.frame")});
  CHECK(coverage_mistake(declared) == "(no error)");
  declared.goal = 50;
  CHECK_THAT(coverage_mistake(declared),
             Contains("x.ssd:10: the group of 'a' has a goal, but no percentage") &&
                 Contains("words=\"…\""));
  declared.points.push_back(point(PointKind::Values, "led"));
  CHECK(coverage_mistake(declared) == "(no error)");
  declared.ignored = {{"led", "*"}};
  CHECK_THAT(coverage_mistake(declared), Contains("has a goal, but no percentage"));
}

TEST_CASE("a cross of what has become several points says so") {
  PointDeclaration position = point(PointKind::Values, "position");
  position.edges = {0, 1};
  const PointDeclaration led = point(PointKind::Values, "led");
  const SelectedCoverage element =
      selected_coverage({group({position, led, cross({"position[2]", "led"})})});
  CHECK(element.groups[0].points.back().name == "position[2] × led");
  CHECK_THAT(coverage_mistake(group({position, led, cross({"position", "led"})})),
             Contains("x.ssd:13: 'position' is an array, with a point for each element") &&
                 Contains("such as position[1]"));
  position.name = "where";
  CHECK_THAT(coverage_mistake(group({position, led, cross({"where", "led"})})),
             Contains("'where' is of several signals") && Contains("'where: position[1]' alone"));
  position.name = "the place";
  position.subject = "position[1]";
  CHECK_THAT(coverage_mistake(group({position, led, cross({"the", "place", "led"})})),
             Contains("no point 'the'; blanks separate points") &&
                 Contains("give 'the place' a name without blanks"));
}

TEST_CASE("mistakes in crosses") {
  const PointDeclaration led = point(PointKind::Values, "led");
  const PointDeclaration mode = point(PointKind::Values, "mode");
  const auto of = [&](const PointDeclaration& declared) {
    return coverage_mistake(group({led, mode, point(PointKind::Gaps, "receive.frame"),
                                   point(PointKind::Words, "receive.frame"),
                                   point(PointKind::Words, "transmit.frame"), declared}));
  };
  CHECK_THAT(of(cross({"led"})), Contains("x.ssd:13: a cross is of 2 to 4 points"));
  CHECK_THAT(of(cross({"led", "led"})), Contains("crossed with itself"));
  CHECK_THAT(of(cross({"led", "mod"})), Contains("no point 'mod'") && Contains("'mode'?"));
  CHECK_THAT(of(cross({"led", "receive.frame:gaps"})), Contains("is of gaps"));
  CHECK_THAT(of(cross({"receive.frame:words", "transmit.frame:words"})),
             Contains("different messages"));
  const SelectedCoverage good = selected_coverage({group(
      {led, point(PointKind::Words, "receive.frame"), cross({"receive.frame:words", "led"})})});
  CHECK(good.groups[0].points[2].is_open);
}

TEST_CASE("all mistakes are reported at once") {
  GroupDeclaration other = group({});
  other.component = "c";
  const std::string text = error_of([&] {
    selected_coverage(
        {group({point(PointKind::Values, "lde"), point(PointKind::Words, "x")}), other, group({})});
  });
  CHECK_THAT(text, Contains("there are 4 mistakes") && Contains("'lde'") &&
                       Contains("no message 'x'") && Contains("no component 'c'") &&
                       Contains("a second group of the component 'a'; the first is in line 10"));
}

TEST_CASE("demands are of the group, or of each point that is meant") {
  const std::vector<CoveredDeclaration> demands{{"all", "a", {}, 50, {"x.ssd", 20}},
                                                {"", "a", "led*", 90, {"x.ssd", 21}}};
  const SelectedCoverage coverage = selected_coverage({group({})}, demands);
  REQUIRE(coverage.demands.size() == 3);
  CHECK((coverage.demands[0].name == "all" && !coverage.demands[0].point));
  CHECK(coverage.demands[0].demand == "a covered >= 50 %");
  CHECK(coverage.demands[2].name == "a, led:transitions covered >= 90 %");
  CHECK(coverage.demands[2].point == 1U);
  CHECK_THAT(coverage_mistake(group({}), {{"", "b", {}, 50, {"x.ssd", 20}}}),
             Contains("x.ssd:20: the component 'b' has no coverage"));
  CHECK_THAT(coverage_mistake(group({}), {{"", "a", "receive.frame:words", 50, {}}}),
             Contains("has no percentage"));
  CHECK_THAT(coverage_mistake(group({}), {{"", "a", "lde", 50, {}}}),
             Contains("did you mean 'led'?"));
}
