#include "master/algorithm/exchange/exchange.h"

#include <catch2/catch.hpp>

#include "tests/master/algorithm/scripted_system.h"

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
