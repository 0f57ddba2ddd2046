#include "master/engine/run/loops/evaluation_order.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride::core;

namespace {

/// One input, 0, and one output, 1.
Describe io() { return Describe("io").input("u").output("y"); }
Describe direct() { return io().depends_on({0}).event_mode(); }
Describe delayed() { return io().depends_on({}).event_mode(); }

struct Net {
  SystemDeclaration declaration;

  Net& add(const std::string& name, Describe description) {
    declaration.components.push_back({name, description.done(), {}, {}});
    return *this;
  }
  /// "a.y", "b.u"
  Net& wire(const std::string& from, const std::string& to) {
    const std::size_t a = from.find('.');
    const std::size_t b = to.find('.');
    declaration.connections.push_back(
        {from.substr(0, a), from.substr(a + 1), to.substr(0, b), to.substr(b + 1), false, {}});
    return *this;
  }
  /// The blocks, "a.y|b.y,b.z|[c.y>d.y]", in brackets the steps of a loop.
  std::string order(Phase phase = Phase::Initialization) const {
    const System system(declaration);
    std::string text;
    for (const EvaluationBlock& block : evaluation_order(system, phase)) {
      std::string steps;
      for (const OutputGroup& group : block.groups) {
        std::string outputs;
        for (const VariableId id : group.outputs) {
          CHECK(id.component == group.component);
          outputs += (outputs.empty() ? "" : ",") + system.full_name(id);
        }
        steps += (steps.empty() ? "" : ">") + outputs;
      }
      text += (text.empty() ? "" : "|") + (block.is_loop() ? "[" + steps + "]" : steps);
    }
    return text;
  }
  std::vector<EvaluationBlock> loops(Phase phase = Phase::Initialization) const {
    std::vector<EvaluationBlock> loops;
    for (EvaluationBlock& block : evaluation_order(System(declaration), phase)) {
      if (block.is_loop()) loops.push_back(std::move(block));
    }
    return loops;
  }
  std::string tearing_variables(const EvaluationBlock& loop) const {
    const System system(declaration);
    std::string text;
    for (const TearingVariable& variable : loop.tearing_variables) {
      std::string inputs;
      for (const ElementRange& input : variable.inputs) {
        inputs += (inputs.empty() ? "" : "=") + system.range_name(input);
      }
      text += (text.empty() ? "" : ",") + inputs;
    }
    return text;
  }
};

}  // namespace

TEST_CASE("a chain is evaluated from its beginning, whatever the order of the file") {
  const Net net = Net()
                      .add("c", direct())
                      .add("b", direct())
                      .add("a", direct())
                      .wire("a.y", "b.u")
                      .wire("b.y", "c.u")
                      .wire("c.y", "a.u");
  Net chain = net;
  chain.declaration.connections.pop_back();
  CHECK(chain.order() == "a.y|b.y");
  CHECK(net.loops().size() == 1);
}

TEST_CASE("what depends on nothing breaks a loop") {
  Net net;
  net.add("a", direct()).add("b", delayed()).wire("a.y", "b.u").wire("b.y", "a.u");
  CHECK(net.order() == "b.y|a.y");
}

TEST_CASE("without a declaration an output depends on all inputs") {
  Net net;
  net.add("a", io()).add("b", direct()).wire("a.y", "b.u").wire("b.y", "a.u");
  const auto loops = net.loops();
  REQUIRE(loops.size() == 1);
  CHECK(loops[0].paths == std::vector<std::string>{"a.u -> a.y -> b.u -> b.y -> a.u"});
  CHECK(net.tearing_variables(loops[0]) == "a.u");
  CHECK(loops[0].undeclared == std::vector<std::size_t>{0});
  CHECK(undeclared_text(System(net.declaration), loops[0]) == "unit 'a' declares no dependencies");
}

TEST_CASE("a declared loop names no undeclared unit, though others declare nothing") {
  Net net;
  net.add("a", Describe("a").input("u").output("y").depends_on({0}).input("v").output("z"));
  net.add("b", direct()).wire("a.y", "b.u").wire("b.y", "a.u").add("c", direct());
  net.wire("a.z", "c.u").wire("c.y", "a.v");
  const auto loops = net.loops();
  REQUIRE(loops.size() == 2);
  CHECK(loops[0].undeclared.empty());
  CHECK(loops[1].undeclared == std::vector<std::size_t>{0});
}

TEST_CASE("initial unknowns take precedence at the start, and what is exact depends on nothing") {
  Net net;
  net.add("a", io().depends_on({0}).depends_initially_on({}).event_mode())
      .add("b", direct())
      .wire("a.y", "b.u")
      .wire("b.y", "a.u");
  CHECK(net.order() == "a.y|b.y");
  CHECK(net.loops(Phase::Events).size() == 1);
  Net exact;
  exact.add("a", direct().exact()).add("b", direct()).wire("a.y", "b.u").wire("b.y", "a.u");
  CHECK(exact.order() == "a.y|b.y");
  CHECK(exact.loops(Phase::Events).size() == 1);
}

TEST_CASE("a unit without Event Mode keeps its outputs at events") {
  Net net;
  net.add("a", io().depends_on({0})).add("b", direct()).wire("a.y", "b.u").wire("b.y", "a.u");
  CHECK(net.loops().size() == 1);
  CHECK(net.order(Phase::Events) == "a.y|b.y");
}

TEST_CASE("outputs of a unit are read at once where that is possible") {
  const auto ports = Describe("ports").input("u").output("x").depends_on({}).output("y");
  Net net;
  net.add("a", ports)
      .add("b", direct())
      .wire("b.y", "a.u")
      .add("c", Describe("c").input("u").input("v"));
  net.wire("a.x", "c.u").wire("a.y", "c.v");
  CHECK(net.order() == "b.y|a.x,a.y");
  net.declaration.connections[1].from_connector = "y";
  net.declaration.connections[2].from_connector = "x";
  CHECK(net.order() == "b.y|a.x,a.y");
  net.wire("a.x", "b.u");
  CHECK(net.order() == "a.x|b.y|a.y");
}

TEST_CASE("a loop is torn at few inputs; those of one source count once") {
  const auto hub = Describe("hub").input("u").input("v").output("y");
  Net net;
  net.add("a", hub).add("b", direct()).add("c", direct());
  net.wire("a.y", "b.u").wire("a.y", "c.u").wire("b.y", "a.u").wire("c.y", "a.v");
  const auto loops = net.loops();
  REQUIRE(loops.size() == 1);
  CHECK(net.tearing_variables(loops[0]).size() <= std::string("a.u,a.v").size());
  CHECK(loops[0].paths.size() == 2);
  CHECK(path_text(loops[0]).find(", and ") != std::string::npos);
}

TEST_CASE("many paths are not all printed") {
  Describe many("many");
  for (int i = 0; i < 20; ++i) many.input("u" + std::to_string(i));
  for (int i = 0; i < 20; ++i) many.output("y" + std::to_string(i));
  Net net;
  net.add("a", many).add("b", many);
  for (int i = 0; i < 20; ++i) {
    net.wire("a.y" + std::to_string(i), "b.u" + std::to_string(i));
    net.wire("b.y" + std::to_string(i), "a.u" + std::to_string(i));
  }
  const auto loops = net.loops();
  REQUIRE(loops.size() == 1);
  CHECK(loops[0].tearing_variables.size() == 20);
  CHECK(loops[0].paths.size() + loops[0].unnamed_paths == 20);
  CHECK(loops[0].paths.size() == 8);
}

TEST_CASE("an output that feeds its own unit is a loop") {
  Net net;
  net.add("a", direct()).wire("a.y", "a.u");
  REQUIRE(net.loops().size() == 1);
  CHECK(net.loops()[0].paths == std::vector<std::string>{"a.u -> a.y -> a.u"});
}

TEST_CASE("loops are in the order of their dependencies") {
  const auto two = Describe("two").input("u").input("v").output("y");
  Net net;
  net.add("d", two).add("e", direct()).wire("d.y", "e.u").wire("e.y", "d.u");
  net.add("a", direct()).add("b", direct()).wire("a.y", "b.u").wire("b.y", "a.u");
  net.add("m", direct()).wire("b.y", "m.u").wire("m.y", "d.v");
  CHECK(net.order() == "[a.y>b.y]|m.y|[d.y>e.y]");
}

TEST_CASE("messages take no part") {
  const auto messenger = Describe("messenger")
                             .add("in.clock", ValueType::Clock, Causality::Input)
                             .add("in", ValueType::Binary, Causality::Input)
                             .clocked_by(0)
                             .add("out.clock", ValueType::Clock, Causality::Output)
                             .add("out", ValueType::Binary, Causality::Output)
                             .clocked_by(2);
  Net net;
  net.add("a", messenger).add("b", messenger);
  for (const auto& [from, to] : {std::pair{"a", "b"}, {"b", "a"}}) {
    net.wire(std::string(from) + ".out", std::string(to) + ".in");
    net.wire(std::string(from) + ".out.clock", std::string(to) + ".in.clock");
  }
  const System system(net.declaration);
  CHECK(evaluation_order(system, Phase::Initialization).empty());
}
