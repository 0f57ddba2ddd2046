// Arrays that are wired element by element lead to the results of as many scalars, bit by bit.
#include <cmath>
#include <cstring>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/engine/run/loops/evaluation_order.h"
#include "tests/master/engine/run/scripted_system.h"
#include "tests/test_units/counted_random.h"

using namespace stride;
using namespace stride::core;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

constexpr Duration kArrayStep = 2ms;
constexpr double kArrayStop = 0.1;
constexpr Duration kJump = 7ms;

/// What the units of a system are, whether their connectors are arrays or scalars.
struct VectorUnit {
  std::size_t size;
  bool is_direct;   ///< outputs depend on inputs
  bool has_events;  ///< a state jumps every 7 ms
  bool rejects;     ///< steps that lead beyond a multiple of 5 ms
};

/// From an element of one unit to an element of another.
struct ElementWire {
  std::size_t from_unit, from, to_unit, to;
};

struct VectorSystem {
  std::vector<VectorUnit> units;
  std::vector<ElementWire> wires;
};

/// Each unit has inputs u, outputs y and states x, as many of each; `scalars`: one variable each.
class VectorModel {
 public:
  VectorModel(VectorUnit unit, bool scalars) : unit_(unit), scalars_(scalars) {}

  std::shared_ptr<const UnitDescription> description() const {
    Describe describe("vector");
    add(describe, "u", Causality::Input);
    add(describe, "y", Causality::Output);
    add(describe, "x", Causality::Local);
    describe.add("next", ValueType::Int64, Causality::Local);
    describe.add("now", ValueType::Int64, Causality::Local);
    describe.can_save_state().promises_idle();
    if (unit_.has_events) describe.event_mode();
    if (!unit_.rejects) describe.never_rejects();
    return describe.done();
  }

  void script(ScriptedUnit& unit) const {
    for (std::size_t i = 0; i < unit_.size; ++i) {
      at(unit, 0, i) = 0.25 + 0.5 * static_cast<double>(i);
      at(unit, 2, i) = static_cast<double>(i) - 1;
    }
    picoseconds(unit, kNext) = kJump.count();
    const VectorModel model = *this;
    unit.on_initialize = [model](ScriptedUnit& u) { model.write_outputs(u); };
    unit.on_read_in_event_mode = unit.on_initialize;
    unit.on_step = [model](ScriptedUnit& u, Time from, Time to) { return model.step(u, from, to); };
    unit.on_idle_until = [model](ScriptedUnit& u) {
      return Time(Duration(model.picoseconds(u, kNow))) + 10ms;
    };
    unit.on_event = [model](ScriptedUnit& u) { return model.event(u); };
  }

 private:
  void add(Describe& describe, const std::string& name, Causality causality) const {
    for (std::size_t i = 0; i < (scalars_ ? unit_.size : 1); ++i) {
      describe.add(scalars_ ? fmt::format("{}[{}]", name, i + 1) : name, ValueType::Float64,
                   causality);
      if (!scalars_) describe.size(unit_.size);
      if (causality == Causality::Input) describe.deadband(1e-3);
      if (causality != Causality::Output) continue;
      std::vector<ValueReference> inputs;
      for (std::size_t k = 0; unit_.is_direct && k < (scalars_ ? unit_.size : 1); ++k) {
        inputs.push_back(static_cast<ValueReference>(k));
      }
      describe.depends_on(inputs).depends_initially_on(inputs);
    }
  }

  /// `list`: 0 for u, 1 for y, 2 for x.
  double& at(ScriptedUnit& unit, std::size_t list, std::size_t i) const {
    if (scalars_) return unit.number(static_cast<ValueReference>(list * unit_.size + i));
    return unit.block(static_cast<ValueReference>(list)).numbers<double>()[i];
  }
  static constexpr std::size_t kNext = 0, kNow = 1;
  std::int64_t& picoseconds(ScriptedUnit& unit, std::size_t variable) const {
    const std::size_t place = 3 * (scalars_ ? unit_.size : 1) + variable;
    return unit.block(static_cast<ValueReference>(place)).numbers<std::int64_t>()[0];
  }

  void write_outputs(ScriptedUnit& unit) const {
    double direct = 0;
    for (std::size_t i = 0; unit_.is_direct && i < unit_.size; ++i) {
      direct += 0.1 * std::sin(at(unit, 0, i));
    }
    for (std::size_t i = 0; i < unit_.size; ++i) at(unit, 1, i) = at(unit, 2, i) + direct;
  }

  StepResult step(ScriptedUnit& unit, Time from, Time to) const {
    StepResult result = reached(to);
    const Time border = from - from.time_since_epoch() % 5ms + 5ms;
    if (unit_.rejects && to > border) {
      result.rejected = true;
      result.reached = border;
      return result;
    }
    const double h = to_seconds(to - from);
    for (std::size_t i = 0; i < unit_.size; ++i) {
      at(unit, 2, i) += h * (10 * at(unit, 0, i) - 3 * at(unit, 2, i));
    }
    write_outputs(unit);
    picoseconds(unit, kNow) = to.time_since_epoch().count();
    return result;
  }

  EventResult event(ScriptedUnit& unit) const {
    EventResult result;
    if (picoseconds(unit, kNow) >= picoseconds(unit, kNext)) {
      at(unit, 2, 0) *= 0.5;
      picoseconds(unit, kNext) += kJump.count();
    }
    write_outputs(unit);
    result.next_event_time = Time(Duration(picoseconds(unit, kNext)));
    return result;
  }

  VectorUnit unit_;
  bool scalars_;
};

VectorSystem random_vectors(unsigned seed, bool has_direct) {
  std::uint64_t count = 0;
  const auto below = [&](std::uint64_t limit) { return random_bits(seed, count++) % limit; };
  VectorSystem system;
  const std::size_t units = 2 + below(3);
  for (std::size_t i = 0; i < units; ++i) {
    system.units.push_back(
        {1 + below(4), has_direct && below(2) == 0, below(3) == 0, below(4) == 0});
  }
  for (std::size_t to = 0; to < units; ++to) {
    for (std::size_t k = 0; k < system.units[to].size; ++k) {
      if (below(4) == 0) continue;  // keeps its start value
      const std::size_t from = below(units);
      system.wires.push_back({from, below(system.units[from].size), to, k});
    }
  }
  return system;
}

/// Which ends are arrays: of the others the elements are scalars.
enum class Ends { Arrays, Scalars, Mixed };

void assemble(ScriptedSystem& f, const VectorSystem& system, Ends ends) {
  const auto is_scalar = [&](std::size_t unit) {
    return ends == Ends::Scalars || (ends == Ends::Mixed && unit % 2 == 0);
  };
  for (std::size_t i = 0; i < system.units.size(); ++i) {
    const VectorModel model(system.units[i], is_scalar(i));
    model.script(f.add(fmt::format("unit{}", i), model.description()));
  }
  for (const ElementWire& wire : system.wires) {
    f.wire(fmt::format("unit{}", wire.from_unit), fmt::format("y[{}]", wire.from + 1),
           fmt::format("unit{}", wire.to_unit), fmt::format("u[{}]", wire.to + 1));
  }
}

/// The bits of all outputs at all communication points.
struct OutputBits : Observer {
  std::vector<double> values;
  std::uint64_t suspensions = 0;
  std::vector<Time> times;
  std::vector<Signal> signals;
  const System* system = nullptr;

  void on_start(std::span<const Signal> started) override {
    signals.assign(started.begin(), started.end());
  }
  void on_communication_point(Time time) override {
    times.push_back(time);
    for (const Signal& signal : signals) {
      for (std::size_t i = 0; i < system->variable(signal.id).size; ++i) {
        values.push_back(signal.block->numbers<double>()[signal.first + i]);
      }
    }
  }
};

OutputBits results_of(ScriptedSystem& f) {
  OutputBits bits;
  const System described(f.declaration);
  std::vector<VariableId> outputs;
  for (std::size_t c = 0; c < described.components().size(); ++c) {
    const auto& variables = described.components()[c].description->variables;
    for (std::size_t v = 0; v < variables.size(); ++v) {
      if (variables[v].causality == Causality::Output) outputs.push_back({c, v});
    }
  }
  f.build(kArrayStop, kArrayStep, outputs);
  bits.system = f.system.get();
  f.simulation->add_observer(bits);
  f.simulation->run();
  for (const UnitStatistics& unit : f.simulation->statistics().units) {
    bits.suspensions += unit.suspensions;
  }
  return bits;
}

OutputBits results_of(const VectorSystem& system, Ends ends, const RunOptions& options) {
  ScriptedSystem f;
  assemble(f, system, ends);
  f.options = options;
  return results_of(f);
}

void check_equal(const OutputBits& results, const OutputBits& expected) {
  CHECK(results.times == expected.times);
  CHECK(results.suspensions == expected.suspensions);
  const bool is_same_size = results.values.size() == expected.values.size();
  REQUIRE(is_same_size);
  REQUIRE(!expected.values.empty());
  const bool is_same = std::memcmp(results.values.data(), expected.values.data(),
                                   expected.values.size() * sizeof(double)) == 0;
  CHECK(is_same);
}

void check_all_ends(const VectorSystem& system, const RunOptions& options) {
  const OutputBits scalars = results_of(system, Ends::Scalars, options);
  check_equal(results_of(system, Ends::Arrays, options), scalars);
  check_equal(results_of(system, Ends::Mixed, options), scalars);
}

}  // namespace

TEST_CASE("arrays wired by elements give the results of scalars, with any coupling and inputs") {
  RunOptions options;
  options.measure_time = false;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const VectorSystem system = random_vectors(seed, seed % 2 == 0);
    for (const Coupling coupling : kCouplings) {
      for (const Extrapolation extrapolation : kExtrapolations) {
        INFO("seed " << seed << ", " << name(coupling) << ", " << name(extrapolation));
        options.coupling = coupling;
        options.extrapolation = extrapolation;
        check_all_ends(system, options);
      }
    }
  }
}

TEST_CASE("arrays wired by elements give the results of scalars with controlled errors") {
  RunOptions options;
  options.measure_time = false;
  options.extrapolation = Extrapolation::Linear;
  options.step.policy = &kErrorControlledSteps;
  options.step.relative_tolerance = options.step.absolute_tolerance = 1e-3;
  for (unsigned seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    const bool has_direct = seed % 2 == 0;  // which passes on jumps within a step
    VectorSystem system = random_vectors(seed, has_direct);
    for (VectorUnit& unit : system.units) unit.has_events &= !has_direct;
    check_all_ends(system, options);
  }
}

TEST_CASE("the deadbands of arrays wired by elements are those of scalars") {
  RunOptions options;
  options.measure_time = false;
  std::uint64_t suspensions = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    VectorSystem system = random_vectors(seed, false);
    for (VectorUnit& unit : system.units) unit.rejects = false;
    options.idle.max_skip.assign(system.units.size(), 1s);
    check_all_ends(system, options);
    suspensions += results_of(system, Ends::Arrays, options).suspensions;
  }
  CHECK(suspensions > 100);
}

TEST_CASE("the random arrays are rolled back, have events and loops") {
  std::size_t loops = 0, rejections = 0, events = 0;
  for (unsigned seed = 0; seed < 40; seed += 2) {
    ScriptedSystem f;
    assemble(f, random_vectors(seed, true), Ends::Arrays);
    results_of(f);
    for (const EvaluationBlock& block : evaluation_order(*f.system, Phase::Initialization)) {
      loops += block.is_loop();
    }
    for (const UnitStatistics& unit : f.simulation->statistics().units) {
      rejections += unit.rejections;
      events += unit.events;
    }
  }
  CHECK(loops > 3);
  CHECK(rejections > 100);
  CHECK(events > 100);
}

TEST_CASE("a whole array gives scalars what single connections give") {
  VectorSystem system{{{3, false, false, false}, {3, true, false, false}}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    system.wires.push_back({0, i, 1, i});
    system.wires.push_back({1, i, 0, i});
  }
  const OutputBits expected = results_of(system, Ends::Scalars, {});
  system.wires.clear();
  for (const Ends ends : {Ends::Arrays, Ends::Mixed, Ends::Scalars}) {
    ScriptedSystem f;
    assemble(f, system, ends);
    f.wire("unit0", "y", "unit1", "u");
    f.wire("unit1", "y", "unit0", "u");
    check_equal(results_of(f), expected);
  }
}
