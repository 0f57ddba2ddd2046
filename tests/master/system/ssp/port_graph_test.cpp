#include "master/system/ssp/port_graph.h"

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

Connector connector(const std::string& name, Flow flow) {
  Connector made;
  made.declared.name = name;
  made.flow = flow;
  return made;
}

ElementNode unit(const std::string& name) {
  ElementNode element;
  element.name = name;
  return element;
}

SystemConnection wired(ConnectionEnd start, ConnectionEnd end) {
  return {std::move(start), std::move(end), {}, {"x.ssd", 1}};
}

/// root: a.y -> s.u, and in s: u -> c.u, u -> d.u, c.y -> y.
SystemNode tree() {
  SystemNode inner;
  inner.connectors = {connector("u", Flow::In), connector("y", Flow::Out)};
  inner.elements.push_back(unit("c"));
  inner.elements.push_back(unit("d"));
  inner.connections = {wired({"", "u"}, {"c", "u"}), wired({"d", "u"}, {"", "u"}),
                       wired({"c", "y"}, {"", "y"})};
  SystemNode root;
  root.elements.push_back(unit("a"));
  root.elements.push_back(unit("s"));
  root.elements[1].system = std::make_unique<SystemNode>(std::move(inner));
  root.connections = {wired({"a", "y"}, {"s", "u"})};
  return root;
}

std::vector<std::string> names(const PortGraph& graph, const PortGraph::Way& way) {
  std::vector<std::string> names{graph.ports()[graph.connections()[way.front()].from].path};
  for (const std::size_t wire : way)
    names.push_back(graph.ports()[graph.connections()[wire].to].path);
  return names;
}

}  // namespace

TEST_CASE("ways lead from a port to all components behind it, and from what feeds it") {
  const SystemNode root = tree();
  const PortGraph graph(root);
  REQUIRE(graph.components().size() == 3);
  CHECK(graph.components()[1].path == "s.c");
  CHECK(graph.component(root.elements[0]) == 0);
  const auto& connectors = graph.connectors(*root.elements[1].system);

  std::vector<std::vector<std::string>> found;
  graph.follow(connectors.at("u"), [&](const auto& way) { found.push_back(names(graph, way)); });
  CHECK(found == std::vector<std::vector<std::string>>{{"s.u", "s.c.u"}, {"s.u", "s.d.u"}});
  CHECK(names(graph, graph.way_to(connectors.at("y"))) == std::vector<std::string>{"s.c.y", "s.y"});
  CHECK(names(graph, graph.way_to(connectors.at("u"))) == std::vector<std::string>{"a.y", "s.u"});
}

TEST_CASE("a circle of connectors without a component is found where it is followed") {
  SystemNode root = tree();
  SystemNode& inner = *root.elements[1].system;
  inner.connections = {wired({"", "u"}, {"", "y"})};
  root.connections = {wired({"s", "y"}, {"s", "u"})};
  const PortGraph graph(root);
  const std::size_t u = graph.connectors(inner).at("u");
  CHECK_THROWS_WITH(graph.way_to(u), Contains("x.ssd:1: this connection leads from"));
  CHECK_THROWS_WITH(graph.follow(u, [](const auto&) {}), Contains("through connectors of systems"));
}

TEST_CASE("a connection to a connector of a system that is there twice is one, with a warning") {
  SystemNode root = tree();
  root.connections.push_back(wired({"s", "u"}, {"a", "y"}));
  const PortGraph graph(root);
  CHECK(graph.connections().size() == 4);
  REQUIRE(graph.warnings().size() == 1);
  CHECK_THAT(graph.warnings()[0],
             Contains("x.ssd:1: ") && Contains("'a.y' to 's.u' is there already"));
  root.connections.back().segment.transformation.kind = core::Transformation::Kind::Linear;
  CHECK_THROWS_WITH(PortGraph(root), Contains("has two sources"));
}

TEST_CASE("ticks of a time-based clock, an input of its unit, leave its system by an output") {
  SystemNode root = tree();
  SystemNode& inner = *root.elements[1].system;
  const auto clock = [](const std::string& name, Flow flow) {
    Connector made = connector(name, flow);
    made.declared.type = ValueType::Clock;
    return made;
  };
  inner.connectors.push_back(clock("tick", GENERATE(Flow::Out, Flow::In)));
  inner.elements[0].connectors = {clock("tx", Flow::In)};
  inner.connections = {wired({"c", "tx"}, {"", "tick"})};
  root.elements[0].connectors = {clock("rx", Flow::In)};
  root.connections = {wired({"s", "tick"}, {"a", "rx"})};
  const PortGraph graph(root);
  using Ways = std::vector<std::vector<std::string>>;
  Ways ways;
  for (std::size_t i = 0; i < graph.ports().size(); ++i) {
    if (!graph.ports()[i].is_component()) continue;
    graph.follow(i, [&](const auto& way) { ways.push_back(names(graph, way)); });
  }
  const std::vector<std::string> out{"s.c.tx", "s.tick", "a.rx"}, in{"a.rx", "s.tick", "s.c.tx"};
  CHECK((ways == Ways{out} || ways == Ways{in}));
}

TEST_CASE("the error of two systems' clocks that both are inputs has the way out") {
  SystemNode root = tree();
  SystemNode other;
  other.connectors = {connector("u", Flow::In)};
  other.connectors[0].declared.type = ValueType::Clock;
  root.elements[0].system = std::make_unique<SystemNode>(std::move(other));
  root.connections = {wired({"a", "u"}, {"s", "u"})};
  CHECK_THROWS_WITH(PortGraph(root), Contains("a value goes to both") &&
                                         Contains("time-based clock") && Contains("kind output"));
}

TEST_CASE("a connection that leads nowhere is a warning with its place") {
  SystemNode root = tree();
  SystemNode& inner = *root.elements[1].system;
  root.connections.push_back(wired({"s", "y"}, {"a", "u"}));
  CHECK(PortGraph(root).warnings().empty());
  inner.connections = {wired({"c", "y"}, {"d", "u"})};
  const std::vector<std::string> warnings = PortGraph(root).warnings();
  REQUIRE(warnings.size() == 2);
  CHECK_THAT(warnings[0], Contains("x.ssd:1: the connector 's.u' is connected to nothing inside"));
  CHECK_THAT(warnings[1], Contains("x.ssd:1: the connector 's.y' has no source, so 'a.u' gets no "
                                   "value from it"));
}

TEST_CASE("two values cannot go to one connector of a system") {
  SystemNode root = tree();
  root.connections.push_back(wired({"a", "z"}, {"s", "u"}));
  CHECK_THROWS_WITH(PortGraph(root), Contains("x.ssd:1: 's.u' has two sources: 'a.z' here"));
}
