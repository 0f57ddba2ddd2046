// Units that step in rows, and communication steps that are made in stretches: the same bytes,
// counts and failures as where each is made by itself.
#include <array>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/error_of.h"
#include "tests/master/loader/fmu/support.h"
#include "tests/property/random_interventions.h"
#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

const unsigned kRowsSystems = kSanitized ? 20 : 200;
constexpr Duration kRowsStep = 1ms;
constexpr Time kRowsStop{200ms};

/// All that is counted, without the wall-clock times.
std::array<std::uint64_t, 9> all_counts(const core::UnitStatistics& unit) {
  return {unit.steps,  unit.early_returns, unit.rejections,         unit.rollbacks, unit.saves,
          unit.events, unit.messages_sent, unit.unannounced_events, unit.calls};
}

/// Of a run, or the error that ends it.
struct RunOutcome {
  std::string error;
  Results results;
};

/// How steps are made, and up to when.
struct Manner {
  bool in_rows, in_stretches;
  Time stop = kRowsStop;
};

RunOutcome run_in(const Assembly& system, const Manner& manner) {
  core::RunOptions options = fixed_steps(kRowsStep, manner.stop);
  options.steps_in_rows = manner.in_rows;
  options.steps_in_stretches = manner.in_stretches;
  options.interventions = random_interventions(system, 7);
  options.measure_time = false;  // else most of the first steps are measured, each by itself
  RunOutcome ending;
  ending.error = error_of([&] { ending.results = run(system, options); });
  return ending;
}

RunOutcome check_same_singly(const Assembly& singly, const Assembly& other, const Manner& manner) {
  const RunOutcome expected = run_in(singly, {false, false, manner.stop});
  const RunOutcome ending = run_in(other, manner);
  CHECK(ending.error == expected.error);
  check_same_bytes(ending.results, expected.results);
  const core::RunStatistics &counted = ending.results.statistics,
                            &wanted = expected.results.statistics;

  CHECK(counted.communication_steps == wanted.communication_steps);
  CHECK(counted.event_iterations == wanted.event_iterations);
  CHECK(counted.end == wanted.end);
  for (const auto& [name, unit] : expected.results.units) {
    INFO(name);
    CHECK(all_counts(ending.results.units.at(name)) == all_counts(unit));
  }
  return expected;
}

/// 2 to 15 units in random order. Most of them can be in a row, unless their states are saved since
/// another one may stop. Others have events, or do something special.
class RowMixture {
 public:
  RowMixture(unsigned seed, std::shared_ptr<importer::Fmu> raw)
      : random_(seed), raw_(std::move(raw)) {
    const std::size_t size = 2 + below(14);
    for (std::size_t i = 0; i < size; ++i) add_unit(fmt::format("u{}", i));
    for (const std::string& input : inputs_) {
      if (below(5) > 0) assembly_.wire(outputs_[below(outputs_.size())], input);
    }
  }

  const Assembly& assembly() const { return assembly_; }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void add_unit(const std::string& name) {
    switch (outputs_.empty() ? 0 : below(8)) {
      case 0:
      case 1:
      case 2:
        assembly_.add(name, relay_);
        return connect(name, "u", "y");
      case 3:
      case 4:
        assembly_.add(name, "linear",
                      {{"damping", "1"}, {"frequency", fmt::format("{}", below(9))}});
        return connect(name, "u", "x");
      case 5:
        assembly_.add(name, "bouncing_ball");
        outputs_.push_back(name + ".h");
        return;
      case 6:
        if (!has_special_) add_special();
        return;
      default:
        assembly_.add(name, below(2) == 0 ? "early_without_state" : "early",
                      {{"instants", "0.0105 0.02 0.03 0.04 0.05 0.0605 0.07 0.08"}});
        return connect(name, "", "y");
    }
  }
  /// A raw unit does what its name says, from the first step on or when 100 of its calls are over.
  void add_special() {
    constexpr std::array kNames{"needs", "arrives", "drifts", "error",
                                "ends",  "discard", "fatal",  "plain"};
    const std::string name = kNames[below(kNames.size())];
    assembly_.add(below(2) == 0 ? name : fmt::format("{}@{}", name, 110 + below(60)), raw_);
    has_special_ = true;
  }
  void connect(const std::string& name, const std::string& input, const std::string& output) {
    if (!input.empty()) inputs_.push_back(name + "." + input);
    outputs_.push_back(name + "." + output);
  }

  std::mt19937 random_;
  std::shared_ptr<importer::Fmu> raw_;
  std::shared_ptr<importer::Fmu> relay_ = importer::Fmu::load(test_fmu("relay"));
  Assembly assembly_;
  std::vector<std::string> inputs_, outputs_;
  bool has_special_ = false;
};

/// 3 to 14 units, most of which are saved and step in rows; of the others some reject steps, stop
/// in them or have events, so that all are taken back often.
Assembly restless_rows(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const auto relay = importer::Fmu::load(test_fmu("relay_with_state"));
  Assembly system;
  std::vector<std::string> inputs, outputs;
  const std::size_t size = 3 + below(12);
  for (std::size_t i = 0; i < size; ++i) {
    const std::string name = fmt::format("u{}", i);
    const std::size_t kind = i == 1 ? 6 : below(8);
    if (kind < 3) {
      system.add(name, relay);
    } else if (kind < 6) {
      system.add(name, "linear", {{"frequency", fmt::format("{}", below(90))}});
    } else if (kind == 6) {
      system.add(
          name, "rejecter",
          {{"seed", fmt::format("{}", seed + i)}, {"shortest", "1e-4"}, {"longest", "3e-3"}});
    } else {
      system.add(name, "early",
                 {{"instants", "0.0105 0.02 0.0305 0.0311 0.05 0.0605 0.07 0.08"},
                  {"wants_events", below(2) == 0 ? "1" : "0"}});
    }
    inputs.push_back(name + ".u");
    outputs.push_back(name + (3 <= kind && kind < 6 ? ".x" : ".y"));
  }
  for (const std::string& input : inputs) {
    if (below(6) > 0) system.wire(outputs[below(outputs.size())], input);
  }
  return below(3) == 0 ? system.add("ball", "bouncing_ball", {{"start_height", "0.001"}}) : system;
}

/// With a state saved before `most_steps` steps of a unit.
Results run_restless(const Assembly& system, bool in_rows, std::size_t most_steps) {
  core::RunOptions options = fixed_steps(kRowsStep, kRowsStop);
  options.steps_in_rows = options.steps_in_stretches = in_rows;
  options.state_saving.most_steps = most_steps;
  return run(system, options);
}

/// Of all units.
std::uint64_t sum(const Results& results, std::uint64_t core::UnitStatistics::*count) {
  std::uint64_t all = 0;
  for (const auto& [name, unit] : results.units) all += unit.*count;
  return all;
}

fs::path raw_fmu(const Scratch& scratch) {
  return make_raw_fmu(scratch, "raw",
                      "hasEventMode=\"true\" canHandleVariableCommunicationStepSize=\"true\"");
}

}  // namespace

TEST_CASE("rows and stretches change neither results nor counts of random systems") {
  for (unsigned seed = 0; seed < kRowsSystems / 4; ++seed) {
    Assembly system = random_system(seed, seed % 3 == 0 ? Wiring::EventsOnly : Wiring::Continuous);
    if (seed % 2 == 1) system = system.with_strict_own_steps(seed);
    INFO("seed " << seed << "\n" << system.text());
    check_same_singly(system, system,
                      {seed % 4 != 3, true, Time(seed % 2 == 0 ? 200ms : 199700us)});
  }
}

TEST_CASE("rows change nothing where most units are in rows, nor how a unit fails among them") {
  unsigned failures = 0;
  std::uint64_t events = 0;
  for (unsigned seed = 0; seed < kRowsSystems; ++seed) {
    // not shared, since a unit that fails fatally spoils its library
    const Scratch scratch, other_scratch;
    const RowMixture singly(seed, importer::Fmu::load(raw_fmu(scratch)));
    const RowMixture other(seed, importer::Fmu::load(raw_fmu(other_scratch)));
    INFO("seed " << seed << "\n" << singly.assembly().text());
    const RunOutcome ending =
        check_same_singly(singly.assembly(), other.assembly(), {seed % 4 != 3, seed % 4 != 2});
    failures += ending.error != "(no error)";
    events += ending.results.statistics.event_iterations;
  }
  CHECK(failures > kRowsSystems / 20);
  CHECK(failures < kRowsSystems / 2);
  CHECK(events > kRowsSystems);
}

TEST_CASE("units that are taken back go on from where their rows were, bit for bit") {
  std::uint64_t rollbacks = 0, repeated = 0;
  for (unsigned seed = 0; seed < kRowsSystems; ++seed) {
    const Assembly system = restless_rows(seed);
    INFO("seed " << seed << "\n" << system.text());
    const Results each = run_restless(system, false, 1);
    for (const std::size_t most_steps : {2, 5, 100}) {
      INFO("up to " << most_steps << " steps behind a saved state");
      const Results singly = run_restless(system, false, most_steps);
      const Results in_rows = run_restless(system, true, most_steps);
      check_same_bytes(singly, each);
      check_same_bytes(in_rows, each);
      for (const auto& [name, unit] : in_rows.units) {
        INFO(name);
        CHECK(all_counts(unit) == all_counts(singly.units.at(name)));
        CHECK(unit.repeated_steps == singly.units.at(name).repeated_steps);
        CHECK_FALSE(unit.inexact_repetition);
      }
      rollbacks += sum(in_rows, &core::UnitStatistics::rollbacks);
      repeated += sum(in_rows, &core::UnitStatistics::repeated_steps);
    }
  }
  CHECK(rollbacks > 500 * kRowsSystems);
  CHECK(repeated > 200 * kRowsSystems);
}
