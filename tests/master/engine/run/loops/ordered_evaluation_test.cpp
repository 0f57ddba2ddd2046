#include "master/engine/run/loops/ordered_evaluation.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

struct InitialSystem : ScriptedSystem {
  std::unique_ptr<RunContext> context;

  void run() {
    system = std::make_unique<System>(declaration);
    context = std::make_unique<RunContext>(*system, std::move(units), options);
    for (auto& unit : context->units) unit->enter_initialization({}, {});
    for (ScriptedUnit* unit : instances) unit->gets = 0;
    set_initial_values(*context, Time{});
  }
  std::string failure() {
    try {
      run();
    } catch (const Error& error) {
      CHECK(error.kind() == Error::Kind::Run);
      return error.what();
    }
    return "none";
  }
  /// A unit with one input, 0, and one output, 1, that is f(u).
  ScriptedUnit& follower(const std::string& name, std::function<double(double)> f) {
    ScriptedUnit& unit =
        add(name, Describe("follower").input("u").output("y").depends_on({0}).done());
    unit.on_initialize = [f](ScriptedUnit& self) { self.number(1) = f(self.number(0)); };
    return unit;
  }
  void ring(const std::string& a, const std::string& b) {
    wire(a, "y", b, "u");
    wire(b, "y", a, "u");
  }
};

double plus_one(double u) { return u + 1; }

}  // namespace

TEST_CASE("in a chain each output is read once, whatever the order of the file") {
  InitialSystem f;
  constexpr int kUnits = 50;
  std::vector<ScriptedUnit*> units;
  for (int i = 0; i < kUnits; ++i) units.push_back(&f.follower("n" + std::to_string(i), plus_one));
  for (int i = 0; i + 1 < kUnits; ++i) {
    f.wire("n" + std::to_string(i + 1), "y", "n" + std::to_string(i), "u");
  }
  f.run();
  CHECK(units[0]->number(0) == kUnits - 1);
  CHECK(units[0]->gets == 0);  // its output is not connected
  for (int i = 1; i < kUnits; ++i) CHECK(units[static_cast<std::size_t>(i)]->gets == 1);
}

TEST_CASE("an input that is not known yet is not written, nor an output read that depends on it") {
  InitialSystem f;
  auto& b = f.follower("b", [](double u) { return 1 / u; });
  auto& a = f.follower("a", [](double) { return 4.0; });
  f.follower("c", plus_one);
  f.wire("a", "y", "b", "u");
  f.wire("b", "y", "c", "u");
  b.number(0) = 1;
  std::vector<double> seen;
  b.on_initialize = [&](ScriptedUnit& unit) {
    seen.push_back(unit.number(0));
    unit.number(1) = 1 / unit.number(0);
  };
  f.run();
  CHECK(seen == std::vector<double>{4});
  CHECK(a.gets == 1);
}

TEST_CASE("linear loops have the values of the closed form") {
  const double slope = GENERATE(0.4, -0.9, -3.0, 40.0, -1e5);
  InitialSystem f;
  auto& a = f.follower("a", [&](double u) { return slope * u + 4; });
  auto& b = f.follower("b", [](double u) { return 2 * u - 1; });
  f.ring("a", "b");
  f.run();
  // u = 2 (slope u + 4) - 1
  CHECK(a.number(0) == Approx(7 / (1 - 2 * slope)).epsilon(1e-12));
  CHECK(b.number(0) == Approx(slope * a.number(0) + 4).epsilon(1e-12));
}

TEST_CASE("a loop is solved before what follows from it, and after what it follows from") {
  InitialSystem f;
  auto& sink = f.follower("sink", plus_one);
  auto& a = f.add("a", Describe("a").input("u").input("v").output("y").depends_on({0, 1}).done());
  auto& b = f.follower("b", [](double u) { return u / 2; });
  f.follower("source", [](double) { return 3.0; });
  a.on_initialize = [](ScriptedUnit& unit) { unit.number(2) = unit.number(0) + unit.number(1); };
  f.ring("a", "b");
  f.wire("source", "y", "a", "v");
  f.wire("a", "y", "sink", "u");
  f.run();
  CHECK(b.number(0) == Approx(6).epsilon(1e-13));
  CHECK(sink.number(0) == Approx(6).epsilon(1e-13));
}

TEST_CASE("the solution nearest to the start value of the input is found") {
  const auto [guess, expected] = GENERATE(std::pair{0.5, 1.0}, std::pair{10.0, 4.0});
  InitialSystem f;
  auto& a = f.follower("a", [](double u) { return (u * u + 4) / 5; });  // 1 and 4
  auto& b = f.follower("b", [](double u) { return u; });
  f.ring("a", "b");
  a.number(0) = guess;
  f.run();
  CHECK(b.number(1) == Approx(expected).epsilon(1e-12));
}

TEST_CASE("arrays and units of measurement in a loop") {
  InitialSystem f;
  const BaseUnitOfMeasure metre{{0, 1}, 1, 0};
  const BaseUnitOfMeasure millimetre{{0, 1}, 1e-3, 0};
  auto& a = f.add("a", Describe("a")
                           .unit("m", metre)
                           .add("u", ValueType::Float64, Causality::Input, "m")
                           .size(2)
                           .add("y", ValueType::Float64, Causality::Output, "m")
                           .size(2)
                           .depends_on({0})
                           .done());
  auto& b = f.add("b", Describe("b")
                           .unit("mm", millimetre)
                           .add("u", ValueType::Float64, Causality::Input, "mm")
                           .size(2)
                           .add("y", ValueType::Float64, Causality::Output, "mm")
                           .size(2)
                           .depends_on({0})
                           .done());
  f.ring("a", "b");
  a.on_initialize = [](ScriptedUnit& unit) {  // (y0, y1) = (u1 - 1, 2 u0)
    const auto u = unit.block(0).numbers<double>();
    const auto y = unit.block(1).numbers<double>();
    y[0] = u[1] - 1;
    y[1] = 2 * u[0];
  };
  b.on_initialize = [](ScriptedUnit& unit) {  // 3 times
    for (std::size_t i = 0; i < 2; ++i) {
      unit.block(1).numbers<double>()[i] = 3 * unit.block(0).numbers<double>()[i];
    }
  };
  f.run();
  // in metres u0 = 3 (u1 - 1), u1 = 6 u0
  CHECK(a.block(0).numbers<double>()[0] == Approx(3.0 / 17).epsilon(1e-12));
  CHECK(a.block(0).numbers<double>()[1] == Approx(18.0 / 17).epsilon(1e-12));
  CHECK(b.block(0).numbers<double>()[1] == Approx(6000.0 / 17).epsilon(1e-12));
}

TEST_CASE("a loop of single-precision numbers") {
  InitialSystem f;
  const auto description = Describe("single")
                               .add("u", ValueType::Float32, Causality::Input)
                               .add("y", ValueType::Float32, Causality::Output)
                               .depends_on({0})
                               .done();
  auto& a = f.add("a", description);
  auto& b = f.add("b", description);
  f.ring("a", "b");
  a.on_initialize = [](ScriptedUnit& unit) {
    unit.block(1).numbers<float>()[0] = 2 - 5 * unit.block(0).numbers<float>()[0];
  };
  b.on_initialize = [](ScriptedUnit& unit) {
    unit.block(1).numbers<float>()[0] = unit.block(0).numbers<float>()[0];
  };
  f.run();
  CHECK(a.block(0).numbers<float>()[0] == Approx(1.0 / 3).epsilon(1e-6));
}

TEST_CASE("a dependency that is not declared and does not exist costs no search") {
  InitialSystem f;
  const auto undeclared =
      Describe("undeclared").input("u").output("constant").output("follows").done();
  auto& a = f.add("a", undeclared);
  auto& b = f.add("b", undeclared);
  const auto initialize = [](ScriptedUnit& unit) {
    unit.number(1) = 5;
    unit.number(2) = 2 * unit.number(0);
  };
  a.on_initialize = b.on_initialize = initialize;
  f.wire("a", "constant", "b", "u");
  f.wire("b", "follows", "a", "u");
  f.run();
  CHECK(a.number(0) == 10);
  CHECK(a.number(2) == 20);
  CHECK(a.gets + b.gets <= 5);  // one of them for the value that the search would begin with
}

TEST_CASE("a long path that only looks like a loop converges step by step") {
  InitialSystem f;
  constexpr ValueReference kPorts = 6;
  Describe ports("ports");
  for (ValueReference i = 0; i < kPorts; ++i) ports.input("u" + std::to_string(i));
  for (ValueReference i = 0; i < kPorts; ++i) ports.output("y" + std::to_string(i));
  auto& a = f.add("a", ports.done());
  auto& b = f.add("b", ports.done());
  for (ValueReference i = 0; i < kPorts; ++i) {
    const std::string port = std::to_string(i);
    f.wire("a", "y" + port, "b", "u" + port);
    if (i + 1 < kPorts) f.wire("b", "y" + port, "a", "u" + std::to_string(i + 1));
  }
  a.on_initialize = b.on_initialize = [](ScriptedUnit& unit) {
    for (ValueReference i = 0; i < kPorts; ++i) unit.number(kPorts + i) = unit.number(i) * 2 + 1;
  };
  f.run();
  CHECK(b.number(kPorts - 1) == 2047);
  CHECK(a.gets < 20);
}

TEST_CASE("a Boolean loop converges, or is an error with its path and values") {
  const bool inverts = GENERATE(false, true);
  InitialSystem f;
  const auto description = Describe("switch")
                               .add("u", ValueType::Boolean, Causality::Input)
                               .add("y", ValueType::Boolean, Causality::Output)
                               .depends_on({0})
                               .done();
  auto& a = f.add("a", description);
  auto& b = f.add("b", description);
  f.ring("a", "b");
  a.on_initialize = [&](ScriptedUnit& unit) { unit.clock(1) = unit.clock(0) != inverts; };
  b.on_initialize = [](ScriptedUnit& unit) { unit.clock(1) = unit.clock(0) || true; };
  f.run();
  CHECK(b.clock(0) != inverts);

  InitialSystem g;
  auto& c = g.add("c", description);
  auto& d = g.add("d", description);
  g.ring("c", "d");
  c.on_initialize = [](ScriptedUnit& unit) { unit.clock(1) = !unit.clock(0); };
  d.on_initialize = [](ScriptedUnit& unit) { unit.clock(1) = unit.clock(0); };
  CHECK_THAT(g.failure(), Contains("c.u -> c.y -> d.u -> d.y -> c.u") && Contains("with c.u = ") &&
                              !Contains("residual"));
}

TEST_CASE("a String in a loop") {
  InitialSystem f;
  const auto description = Describe("text")
                               .add("u", ValueType::String, Causality::Input)
                               .add("y", ValueType::String, Causality::Output)
                               .depends_on({0})
                               .done();
  auto& a = f.add("a", description);
  auto& b = f.add("b", description);
  f.ring("a", "b");
  const auto grow = [](ScriptedUnit& unit) {
    const std::string& u = unit.block(0).strings()[0];
    unit.block(1).strings()[0] = u.size() < 7 ? u + "ab" : u;
  };
  a.on_initialize = b.on_initialize = grow;
  f.run();
  CHECK(a.block(0).strings()[0] == "abababab");
}

TEST_CASE("numbers and a switch in one loop") {
  // y = slope u + 1 with a slope that a switch chooses: -4 below zero, else -2; the switch is u < 0
  InitialSystem f;
  auto& a = f.add("a", Describe("a")
                           .input("u")
                           .add("steep", ValueType::Boolean, Causality::Input)
                           .output("y")
                           .depends_on({0, 1})
                           .done());
  auto& b = f.add("b", Describe("b")
                           .input("u")
                           .output("y")
                           .depends_on({0})
                           .add("negative", ValueType::Boolean, Causality::Output)
                           .depends_on({0})
                           .done());
  f.ring("a", "b");
  f.wire("b", "negative", "a", "steep");
  a.clock(1) = true;
  a.on_initialize = [](ScriptedUnit& unit) {
    unit.number(2) = (unit.clock(1) ? -4 : -2) * unit.number(0) + 1;
  };
  b.on_initialize = [](ScriptedUnit& unit) {
    unit.number(1) = unit.number(0);
    unit.clock(2) = unit.number(0) < 0;
  };
  f.run();
  CHECK(a.number(0) == Approx(1.0 / 3).epsilon(1e-12));
  CHECK_FALSE(a.clock(1));
}

TEST_CASE("the error has the whole path, the values, and how to break the loop") {
  InitialSystem f;
  f.follower("a", plus_one);
  f.follower("b", [](double u) { return u; });
  f.ring("a", "b");
  const std::string text = f.failure();
  CHECK_THAT(text, Contains("at 0 s") && Contains("a.u -> a.y -> b.u -> b.y -> a.u") &&
                       Contains("evaluations") && Contains("with a.u = 0 the loop returns 1") &&
                       Contains("residual of 1") && Contains("breaks the loop"));
  CHECK_THAT(text, !Contains("declare"));
}

TEST_CASE("NaN on the way to the initial values is not an error") {
  InitialSystem f;
  auto& a = f.add("a", Describe("a").input("u").output("x").output("y").done());
  auto& b = f.add("b", Describe("b").input("u").input("v").output("y").output("z").done());
  f.wire("a", "x", "b", "u");
  f.wire("b", "y", "a", "u");
  f.wire("a", "y", "b", "v");
  a.on_initialize = [](ScriptedUnit& unit) {
    unit.number(1) = 5;
    unit.number(2) = std::sqrt(unit.number(0) - 1);
  };
  b.on_initialize = [](ScriptedUnit& unit) {
    unit.number(2) = 2 * unit.number(0);
    unit.number(3) = unit.number(1);
  };
  f.run();
  CHECK(b.number(1) == 3);
}

TEST_CASE("a connected output that is NaN is named") {
  InitialSystem f;
  auto& a = f.follower("a", [](double) { return std::nan(""); });
  f.follower("b", plus_one);
  f.wire("a", "y", "b", "u");
  CHECK_THAT(f.failure(), Contains("unit 'a', variable 'y', at 0 s") && Contains("NaN"));
  CHECK(a.gets == 1);
}

namespace {

/// y = C u + d with as many inputs as outputs, and some of its dependencies declared.
struct LinearUnit {
  std::vector<std::vector<double>> gains;
  std::vector<double> offsets;

  LinearUnit(std::mt19937& generator, std::size_t ports) {
    std::uniform_real_distribution<double> number(-1, 1);
    for (std::size_t i = 0; i < ports; ++i) {
      offsets.push_back(number(generator));
      auto& row = gains.emplace_back();
      for (std::size_t k = 0; k < ports; ++k) {
        const bool depends = generator() % 3 == 0;
        row.push_back(depends ? 0.9 * number(generator) / static_cast<double>(ports) : 0);
      }
    }
  }
  std::shared_ptr<const UnitDescription> description(std::mt19937& generator) const {
    Describe description("linear");
    for (std::size_t i = 0; i < gains.size(); ++i) description.input("u" + std::to_string(i));
    for (std::size_t i = 0; i < gains.size(); ++i) {
      description.output("y" + std::to_string(i));
      if (generator() % 4 == 0) continue;
      std::vector<ValueReference> inputs;
      for (std::size_t k = 0; k < gains.size(); ++k) {
        if (gains[i][k] != 0) inputs.push_back(static_cast<ValueReference>(k));
      }
      description.depends_on(inputs);
    }
    return description.done();
  }
  double output(std::size_t i, std::span<const double> inputs) const {
    double sum = offsets[i];
    for (std::size_t k = 0; k < inputs.size(); ++k) sum += gains[i][k] * inputs[k];
    return sum;
  }
};

}  // namespace

TEST_CASE("random systems have the values that endless iteration would give") {
  std::mt19937 generator(42);
  for (int round = 0; round < 200; ++round) {
    const std::size_t count = 2 + generator() % 5;
    const std::size_t ports = 1 + generator() % 4;
    InitialSystem f;
    std::vector<LinearUnit> units;
    for (std::size_t i = 0; i < count; ++i) units.emplace_back(generator, ports);
    for (std::size_t i = 0; i < count; ++i) {
      const LinearUnit& unit = units[i];
      f.add("n" + std::to_string(i), unit.description(generator)).on_initialize =
          [&unit, ports](ScriptedUnit& self) {
            std::vector<double> inputs;
            for (ValueReference k = 0; k < ports; ++k) inputs.push_back(self.number(k));
            for (std::size_t k = 0; k < ports; ++k) {
              self.number(static_cast<ValueReference>(ports + k)) = unit.output(k, inputs);
            }
          };
    }
    std::vector<std::size_t> source(count * ports);  // of each input, an output
    for (std::size_t i = 0; i < source.size(); ++i) {
      source[i] = generator() % source.size();
      f.wire("n" + std::to_string(source[i] / ports), "y" + std::to_string(source[i] % ports),
             "n" + std::to_string(i / ports), "u" + std::to_string(i % ports));
    }
    f.run();
    std::vector<double> expected(source.size());
    for (int sweep = 0; sweep < 1000; ++sweep) {
      for (std::size_t i = 0; i < source.size(); ++i) {
        const std::size_t from = source[i] / ports;
        expected[i] =
            units[from].output(source[i] % ports, std::span(expected).subspan(from * ports, ports));
      }
    }
    for (std::size_t i = 0; i < source.size(); ++i) {
      INFO("round " << round << ", input " << i);
      CHECK(f.instances[i / ports]->number(static_cast<ValueReference>(i % ports)) ==
            Approx(expected[i]).epsilon(1e-12).margin(1e-14));
    }
  }
}
