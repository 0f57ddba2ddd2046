#include "master/engine/run/exchange/exchange.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "master/base/state_archive.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;

namespace {

/// Arrays of three elements of several types.
std::shared_ptr<const UnitDescription> typed_arrays(Causality causality) {
  Describe describe("arrays");
  describe.add("words", ValueType::String, causality).size(3);
  describe.add("blobs", ValueType::Binary, causality).size(3);
  describe.add("flags", ValueType::Boolean, causality).size(3);
  describe.add("counts", ValueType::Int32, causality).size(3);
  describe.add("shorts", ValueType::Float32, causality).size(3);
  describe.add("reals", ValueType::Float64, causality).size(3);
  return describe.done();
}

template <class T>
std::vector<T> all(ScriptedUnit& unit, ValueReference reference) {
  const auto numbers = unit.block(reference).numbers<T>();
  return {numbers.begin(), numbers.end()};
}

/// Several outputs, two of them of one type and one an array.
std::shared_ptr<const UnitDescription> several_outputs() {
  return Describe("several")
      .output("x")
      .output("y")
      .size(2)
      .output("z")
      .add("word", ValueType::String, Causality::Output)
      .add("count", ValueType::Int32, Causality::Output)
      .done();
}

std::vector<std::byte> state_with(const System& system, const std::vector<VariableId>& observed,
                                  ScriptedUnit& unit) {
  Exchange exchange(system, observed);
  exchange.read_outputs(0, unit);
  StateArchive state;
  exchange.persist(state);
  return state.bytes();
}

}  // namespace

TEST_CASE("elements of every type are exchanged, converted, and the others keep their values") {
  ScriptedSystem f;
  ScriptedUnit& from = f.add("from", typed_arrays(Causality::Output));
  ScriptedUnit& to = f.add("to", typed_arrays(Causality::Input));
  f.wire("from", "words[3]", "to", "words[1]");
  f.wire("from", "blobs[2]", "to", "blobs[3]");
  f.wire("from", "flags[1]", "to", "flags[2]");
  f.wire("from", "flags[1]", "to", "counts[3]");
  f.wire("from", "counts[2]", "to", "counts[1]");
  f.wire("from", "counts[2]", "to", "reals[3]");
  f.declaration.connections.back().transformation = {.kind = Transformation::Kind::Linear,
                                                     .linear = {10, 1}};
  f.wire("from", "shorts[3]", "to", "shorts[2]");
  f.wire("from", "reals[1]", "to", "shorts[3]");
  f.wire("from", "shorts[1]", "to", "reals[1]");
  std::ranges::copy(std::vector<std::string>{"a", "b", "c"}, from.block(0).strings().begin());
  std::ranges::copy(std::vector<Binary>{{1}, {2}, {3}}, from.block(1).binaries().begin());
  from.block(2).numbers<bool>()[0] = true;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    from.block(3).numbers<std::int32_t>()[at] = 7 + i;
    from.block(4).numbers<float>()[at] = 0.5F + static_cast<float>(i);
    from.block(5).numbers<double>()[at] = 0.25 + i;
    to.block(0).strings()[at] = "start";
    to.block(1).binaries()[at] = {9};
    to.block(3).numbers<std::int32_t>()[at] = -1;
    to.block(4).numbers<float>()[at] = -2;
    to.block(5).numbers<double>()[at] = -3;
  }
  f.build(0.01, std::chrono::milliseconds(5)).run();
  const auto words = to.block(0).strings();
  CHECK(std::vector<std::string>(words.begin(), words.end()) ==
        std::vector<std::string>{"c", "start", "start"});
  const auto blobs = to.block(1).binaries();
  CHECK(std::vector<Binary>(blobs.begin(), blobs.end()) == std::vector<Binary>{{9}, {9}, {2}});
  CHECK(all<bool>(to, 2) == std::vector<bool>{false, true, false});
  CHECK(all<std::int32_t>(to, 3) == std::vector<std::int32_t>{8, -1, 1});
  CHECK(all<float>(to, 4) == std::vector<float>{-2, 2.5F, 0.25F});
  CHECK(all<double>(to, 5) == std::vector<double>{0.5, -3, 81});
}

TEST_CASE("an array is read once, however many of its elements are connected") {
  ScriptedSystem f;
  ScriptedUnit& from = f.add("from", Describe("a").output("y").size(3).depends_on({}).done());
  f.add("to", Describe("b").input("u").size(3).done());
  for (const char* indices : {"[1]", "[2]", "[3]"}) {
    f.wire("from", std::string("y") + indices, "to", std::string("u") + indices);
  }
  const System system(f.declaration);
  Exchange exchange(system, {});
  exchange.read_outputs(0, from);
  CHECK(from.gets == 1);
}

TEST_CASE("an output of the system may be an element of an array") {
  ScriptedSystem f;
  ScriptedUnit& from = f.add("from", Describe("a").output("y").size(3).depends_on({}).done());
  from.on_initialize = [](ScriptedUnit& unit) {
    for (std::size_t i = 0; i < 3; ++i) {
      unit.block(0).numbers<double>()[i] = static_cast<double>(i + 1);
    }
  };
  OutputDeclaration output{"from", "y[2]", {}};
  output.via.push_back({{"second", ValueType::Float64, {}, {}, false}, {}});
  f.declaration.outputs.push_back(output);
  const System system(f.declaration);
  REQUIRE(system.outputs().size() == 1);
  CHECK(system.outputs()[0].variable.dimensions.empty());
  f.build(0.01, std::chrono::milliseconds(5), {system.output_id(0)});
  struct Last : Observer {
    Signal signal;
    double value = 0;
    void on_start(std::span<const Signal> signals) override { signal = signals.front(); }
    void on_communication_point(Time) override {
      value = signal.block->numbers<double>()[signal.first];
    }
  } last;
  f.simulation->add_observer(last);
  f.simulation->run();
  CHECK(last.value == 2);
}

TEST_CASE("outputs of a state are found by their variables, and only new ones are read") {
  ScriptedSystem f;
  ScriptedUnit& a = f.add("a", several_outputs());
  const System system(f.declaration);
  const VariableId x{0, 0}, y{0, 1}, z{0, 2}, word{0, 3}, count{0, 4};
  a.block(0).numbers<double>()[0] = -0.0;
  a.block(1).numbers<double>()[1] = 0.1;
  a.block(2).numbers<double>()[0] = 3;
  a.block(3).strings()[0] = "before";
  const std::vector<std::byte> state = state_with(system, {x, y, word}, a);
  a.block(1).numbers<double>()[1] = 0.2;
  a.block(2).numbers<double>()[0] = 4;
  a.block(3).strings()[0] = "after";
  a.block(4).numbers<std::int32_t>()[0] = 5;
  SECTION("others are observed") {
    a.gets = 0;
    Exchange exchange(system, std::vector{y, z, word, count});
    StateArchive archive(state);
    exchange.persist(archive);
    archive.end();
    const auto news = exchange.new_outputs();
    CHECK(std::vector(news.begin(), news.end()) == std::vector{z, count});
    CHECK(a.gets == 0);
    exchange.read_new_outputs(0, a);
    CHECK(a.gets == 2);  // one for each type
    CHECK(exchange.value(y).numbers<double>()[1] == 0.1);
    CHECK(exchange.value(z).numbers<double>()[0] == 4);
    CHECK(exchange.value(word).strings()[0] == "before");
    CHECK(exchange.value(count).numbers<std::int32_t>()[0] == 5);
  }
  SECTION("the same are observed") {
    a.gets = 0;
    Exchange exchange(system, std::vector{x, y, word});
    StateArchive archive(state);
    exchange.persist(archive);
    archive.end();
    exchange.read_new_outputs(0, a);
    CHECK(a.gets == 0);
    CHECK(exchange.new_outputs().empty());
    CHECK(std::signbit(exchange.value(x).numbers<double>()[0]));
    StateArchive again;
    exchange.persist(again);
    CHECK(again.bytes() == state);
  }
}

TEST_CASE("a state whose outputs cannot be those of the system is refused") {
  ScriptedSystem f;
  const auto unit = Describe("unit").input("u").output("y").done();
  ScriptedUnit& a = f.add("a", unit);
  f.add("b", unit);
  const System apart(f.declaration);
  f.wire("a", "y", "b", "u");
  const System wired(f.declaration);
  const auto read = [&](const System& system, const std::vector<std::byte>& state) {
    Exchange exchange(system, {});
    StateArchive archive(state);
    exchange.persist(archive);
  };
  CHECK_THROWS_WITH(read(wired, state_with(apart, {}, a)),
                    Catch::Contains("does not have an output that is connected"));
  CHECK_THROWS_WITH(read(wired, state_with(apart, {{0, 1}, {1, 0}}, a)),
                    Catch::Contains("what was read is no output"));
  ScriptedSystem g;
  ScriptedUnit& wide = g.add("a", several_outputs());
  g.add("b", several_outputs());
  CHECK_THROWS_WITH(read(apart, state_with(System(g.declaration), {{0, 4}}, wide)),
                    Catch::Contains("a key that does not exist"));
}
