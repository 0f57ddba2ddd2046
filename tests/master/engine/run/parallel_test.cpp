// Threads change the speed of a run and nothing else.
#include <atomic>
#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <thread>

#include <catch2/catch.hpp>

#include "tests/master/engine/run/row_unit.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using Catch::Matchers::Contains;
using namespace std::chrono_literals;

namespace {

Time at(Duration since) { return Time(since); }

ThreadOptions forced(std::size_t threads) { return {threads, {}, true}; }

/// The bits of all values at all communication points, and all counts.
struct Trace : Observer {
  std::vector<std::uint64_t> words;
  std::vector<Signal> signals;
  std::set<std::thread::id> threads;
  std::uint64_t rollbacks = 0;

  void on_start(std::span<const Signal> all) override { signals.assign(all.begin(), all.end()); }
  void on_communication_point(Time time) override {
    threads.insert(std::this_thread::get_id());
    words.push_back(static_cast<std::uint64_t>(time.time_since_epoch().count()));
    for (const Signal& signal : signals) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &signal.block->numbers<double>()[signal.first], sizeof bits);
      words.push_back(bits);
    }
  }
  bool watches_activities() const override { return true; }
  void on_activity(const Activity& activity) override {
    threads.insert(std::this_thread::get_id());
    words.insert(words.end(),
                 {activity.component, static_cast<std::uint64_t>(activity.kind),
                  static_cast<std::uint64_t>(activity.from.time_since_epoch().count()),
                  static_cast<std::uint64_t>(activity.until.time_since_epoch().count())});
  }
  void add(const RunStatistics& run) {
    words.insert(words.end(), {run.communication_steps, run.event_iterations});
    for (const UnitStatistics& unit : run.units) {
      rollbacks += unit.rollbacks;
      words.insert(words.end(), {unit.steps, unit.early_returns, unit.rejections, unit.rollbacks,
                                 unit.saves, unit.events});
    }
  }
};

/// Not by measured costs, so that two runs save and repeat alike.
const StateSavingOptions kStateSaving{.most_steps = 5, .always = true};

/// y' = u - sin(y), in one explicit step: other steps and other inputs give other bits.
void advance(ScriptedUnit& unit, Duration size) {
  unit.number(1) += to_seconds(size) * (unit.number(0) - std::sin(unit.number(1)) + 1);
}

/// A unit that stops at some instants with an event, or accepts no step above a size that depends
/// on where it begins. A rejected step leaves no trace, and what it accepts it accepts in parts.
struct Behaviour {
  std::set<Time> stops;
  unsigned rejects = 0;  ///< the seed of the sizes; 0: it accepts each
  std::shared_ptr<bool> has_event = std::make_shared<bool>();

  StepResult operator()(ScriptedUnit& unit, Time from, Time to) const {
    if (rejects != 0) {
      std::minstd_rand random(rejects + static_cast<unsigned>(from.time_since_epoch().count()));
      random.discard(3);
      if (to - from > 150us + Duration(1us) * (random() % 2000)) {
        return {.rejected = true, .reached = from};
      }
    }
    const auto stop = stops.upper_bound(from);
    const bool stops_early = stop != stops.end() && *stop < to;
    const Time reached = stops_early ? *stop : to;
    advance(unit, reached - from);
    *has_event = stop != stops.end() && *stop <= to;
    return {.early_return = stops_early, .event_handling_needed = *has_event, .reached = reached};
  }
};

/// Two to nine units of all roles, each fed by another one.
void make_random_system(ScriptedSystem& system, unsigned seed) {
  std::mt19937 random(seed);
  const auto chance = [&](unsigned percent) { return random() % 100 < percent; };
  const std::size_t count = 2 + random() % 8;
  bool has_final_stopper = false;
  for (std::size_t i = 0; i < count; ++i) {
    Describe describe = Describe("random").input("u").output("y").event_mode();
    Behaviour behaviour;
    const bool can_roll_back = chance(70);
    const bool stops = chance(50) && (can_roll_back || !has_final_stopper);
    if (can_roll_back) describe.can_save_state();
    if (stops) {
      describe.may_return_early();
      has_final_stopper |= !can_roll_back;
      for (int k = 0; k < 12; ++k) behaviour.stops.insert(at(Duration(1us) * (random() % 20'000)));
    }
    if (can_roll_back && chance(30)) {
      behaviour.rejects = 1 + random() % 1000;
    } else {
      describe.never_rejects();
    }
    auto& unit = system.add("u" + std::to_string(i), describe.done());
    unit.number(1) = static_cast<double>(random() % 1000) / 1000;
    unit.on_step = behaviour;
    unit.on_event = [has_event = behaviour.has_event](ScriptedUnit& self) {
      if (std::exchange(*has_event, false)) self.number(1) *= -0.5;
      return EventResult{};
    };
  }
  for (std::size_t i = 0; i < count; ++i) {
    system.wire("u" + std::to_string(random() % count), "y", "u" + std::to_string(i), "u");
  }
}

std::vector<VariableId> all_outputs(const ScriptedSystem& system) {
  std::vector<VariableId> outputs;
  for (std::size_t i = 0; i < system.instances.size(); ++i) outputs.push_back({i, 1});
  return outputs;
}

/// `concurrent`: the bits of those that step elsewhere.
Trace run_random(unsigned seed, ThreadOptions threads, unsigned concurrent = 0) {
  ScriptedSystem system;
  make_random_system(system, seed);
  system.options.state_saving = kStateSaving;
  for (ScriptedUnit* unit : system.instances) {
    unit->is_concurrent = concurrent % 2 == 1;
    concurrent /= 2;
  }
  system.options.extrapolation = kExtrapolations[seed % kExtrapolations.size()];
  system.options.threads = std::move(threads);
  Trace trace;
  system.build(0.02, 1ms, all_outputs(system)).add_observer(trace);
  system.simulation->run();
  trace.add(system.simulation->statistics());
  return trace;
}

/// Long enough for threads to be worthwhile.
void work() {
  const auto end = std::chrono::steady_clock::now() + 100us;
  while (std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

struct RunInRows {
  Trace trace;
  int rows = 0;  ///< that have stepped
  std::uint64_t parallel_steps = 0;
};

/// A ring of units that step in a row, and whose states are saved, since each may stop.
RunInRows run_in_rows(ThreadOptions threads) {
  ScriptedSystem system;
  RunInRows run;
  std::vector<RowUnit*> in_row;
  const std::vector<std::string> names{"a", "b", "c", "d"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    in_row.push_back(&system.add<RowUnit>(names[i], Describe("row")
                                                        .input("u")
                                                        .output("y")
                                                        .can_save_state()
                                                        .may_return_early()
                                                        .never_rejects()
                                                        .done()));
    Behaviour behaviour;
    for (int k = 0; k < 5; ++k) behaviour.stops.insert(at((80 * k + 20 * i) * 1ms + 300us));
    in_row.back()->on_step = [behaviour](ScriptedUnit& unit, Time from, Time to) {
      work();
      StepResult result = behaviour(unit, from, to);
      result.event_handling_needed = false;
      return result;
    };
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    system.wire(names[i], "y", names[(i + 1) % names.size()], "u");
  }
  system.options.state_saving = kStateSaving;
  system.options.measure_time = false;  // else most steps are measured, each by itself
  system.options.threads = std::move(threads);
  system.build(0.4, 1ms, all_outputs(system)).add_observer(run.trace);
  system.simulation->run();
  run.trace.add(system.simulation->statistics());
  for (const RowUnit* unit : in_row) run.rows += unit->rows;
  run.parallel_steps = system.simulation->statistics().parallel_steps;
  return run;
}

auto plain() { return Describe("plain").input("u").output("y").can_save_state().never_rejects(); }

StepResult pass_on(ScriptedUnit& unit, Time from, Time to) {
  advance(unit, to - from);
  return reached(to);
}

[[noreturn]] void fail_as(const std::string& name, Time time) {
  fail_run({{}, name, {}, time}, "it broke");
}

}  // namespace

TEST_CASE("random systems give the same bits and the same counts on any number of threads") {
  std::size_t with_rollbacks = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Trace serial = run_random(seed, {});
    INFO("seed " << seed);
    CHECK(run_random(seed, forced(2)).words == serial.words);
    CHECK(run_random(seed, forced(4)).words == serial.words);
    CHECK(run_random(seed, {4, {}, false}).words == serial.words);
    CHECK(run_random(seed, {3, {0, 1}, true}).words == serial.words);
    with_rollbacks += serial.rollbacks > 10 ? 1 : 0;
  }
  CHECK(with_rollbacks > 15);
}

TEST_CASE("random systems give the same bits and the same counts wherever units step") {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Trace serial = run_random(seed, {});
    const unsigned some = std::mt19937(seed)();
    INFO("seed " << seed);
    CHECK(run_random(seed, {}, ~0U).words == serial.words);
    CHECK(run_random(seed, {}, some).words == serial.words);
    CHECK(run_random(seed, forced(2), some).words == serial.words);
    CHECK(run_random(seed, {3, {0, 1}, true}, ~0U).words == serial.words);
  }
}

TEST_CASE("units that step in rows and, for a time, on threads give the same bits and counts") {
  const Trace expected = run_in_rows({}).trace;
  CHECK(expected.rollbacks > 10);
  bool have_changed = false;
  for (int attempt = 0; attempt < 50 && !have_changed; ++attempt) {  // a race takes two processors
    const RunInRows raced = run_in_rows({4, {}, false});
    CHECK(raced.trace.words == expected.words);
    have_changed = raced.rows > 0 && raced.parallel_steps > 0;
  }
  CHECK((have_changed || std::thread::hardware_concurrency() < 2));
}

TEST_CASE("with Gauss-Seidel or an error-controlled step the bits are the same, too") {
  const auto run = [](Coupling coupling, ThreadOptions threads, unsigned concurrent = 0) {
    ScriptedSystem system;
    for (const char* name : {"a", "b", "c"}) {
      auto& unit = system.add(
          name,
          Describe("moving").input("u").output("y").can_save_state().may_return_early().done());
      unit.is_concurrent = (concurrent >> system.units.size()) % 2 == 1;
      unit.on_step = Behaviour{{at(1500us), at(7ms)}, 17};
      unit.number(1) = *name;
    }
    system.wire("a", "y", "b", "u");
    system.wire("b", "y", "c", "u");
    system.wire("c", "y", "a", "u");
    system.options.coupling = coupling;
    system.options.step.policy = &kErrorControlledSteps;
    system.options.state_saving = kStateSaving;
    system.options.threads = std::move(threads);
    Trace trace;
    system.build(0.5, 1ms, all_outputs(system)).add_observer(trace);
    system.simulation->run();
    const auto& statistics = system.simulation->statistics();
    CHECK((statistics.parallel_steps > 0) ==
          (coupling == Coupling::Jacobi && system.options.threads.always));
    trace.add(statistics);
    trace.words.push_back(statistics.undone_steps);
    return trace.words;
  };
  for (const Coupling coupling : kCouplings) {
    CHECK(run(coupling, forced(3)) == run(coupling, {}));
    CHECK(run(coupling, forced(2)) == run(coupling, {}));
    for (unsigned concurrent = 2; concurrent < 16; concurrent += 2) {
      CHECK(run(coupling, {}, concurrent) == run(coupling, {}));
      CHECK(run(coupling, forced(2), concurrent) == run(coupling, {}));
    }
  }
}

TEST_CASE("the units of a stage step at the same time") {
  ScriptedSystem system;
  std::atomic<int> arrived = 0;
  std::atomic<bool> met = true;
  for (const char* name : {"a", "b"}) {
    system.add(name, plain().done()).on_step = [&](ScriptedUnit&, Time from, Time to) {
      // each waits until the other has begun the same step
      ++arrived;
      const int wanted = 2 * static_cast<int>((from.time_since_epoch() / 1ms) + 1);
      const auto limit = std::chrono::steady_clock::now() + 30s;
      while (arrived < wanted && met) {
        if (std::chrono::steady_clock::now() > limit) met = false;
        std::this_thread::yield();
      }
      return reached(to);
    };
  }
  system.options.threads = forced(2);
  system.build(0.02, 1ms).run();
  CHECK(met);
  CHECK(system.simulation->statistics().parallel_steps == 20);
}

TEST_CASE("observers and all but the steps stay on the thread that runs the simulation") {
  ScriptedSystem system;
  std::vector<std::set<std::thread::id>> stepped(4);
  std::set<std::thread::id> others;
  for (std::size_t i = 0; i < 4; ++i) {
    auto& unit = system.add("u" + std::to_string(i), plain().event_mode().done());
    unit.on_step = [&stepped, i](ScriptedUnit&, Time, Time to) {
      stepped[i].insert(std::this_thread::get_id());
      return reached(to);
    };
    unit.on_event = [&](ScriptedUnit&) {
      others.insert(std::this_thread::get_id());
      return EventResult{};
    };
  }
  system.options.threads = {4, {1, 3}, true};
  Trace trace;
  system.build(0.05, 1ms).add_observer(trace);
  system.simulation->run();
  const std::set self{std::this_thread::get_id()};
  CHECK(trace.threads == self);
  CHECK(others == self);
  CHECK(stepped[1] == self);  // bound to it
  CHECK(stepped[3] == self);
  CHECK(stepped[0] != self);
  CHECK(stepped[2] != self);
  CHECK(stepped[0] != stepped[2]);
}

TEST_CASE(
    "of several failures the first in the step order is thrown, after all threads have finished") {
  const std::size_t threads = GENERATE(1, 2, 4);
  ScriptedSystem system;
  std::atomic<int> running = 0;
  for (const char* name : {"a", "b", "c", "d"}) {
    system.add(name, plain().done()).on_step = [&, name](ScriptedUnit& unit, Time from, Time to) {
      ++running;
      if (*name == 'd') std::this_thread::sleep_for(1ms);
      --running;
      if (from >= at(5ms) && *name != 'a') fail_as(name, from);
      return pass_on(unit, from, to);
    };
  }
  system.options.threads = forced(threads);
  CHECK_THAT(failure(system.build(1, 1ms)), Contains("unit 'b', at 0.005 s"));
  CHECK(running == 0);
  const auto& statistics = system.simulation->statistics();
  CHECK(statistics.units[0].steps == 6);  // counted as far as the step order came
  for (std::size_t i : {1, 2, 3}) CHECK(statistics.units[i].steps == 5);
}

TEST_CASE("a failure that another unit's failure has caused is not the reported one") {
  ScriptedSystem system;
  std::atomic<bool> condemned = false;
  system.add("victim", plain().done()).on_step = [&](ScriptedUnit&, Time, Time) -> StepResult {
    while (!condemned) std::this_thread::yield();
    throw ConsequentError(Error::Kind::Run, {{}, "victim", {}, {}}, "cannot be called");
  };
  system.add("culprit", plain().done()).on_step = [&](ScriptedUnit&, Time from,
                                                      Time) -> StepResult {
    condemned = true;
    fail_as("culprit", from);
  };
  system.options.threads = forced(2);
  CHECK_THAT(failure(system.build(1, 1ms)), Contains("unit 'culprit', at 0 s: it broke"));
}

TEST_CASE("all units follow a stop in a stage, and later stages step to it only") {
  const std::size_t threads = GENERATE(1, 2);
  ScriptedSystem system;
  std::vector<Time> asked;
  system.add("last", Describe("last").output("y").never_rejects().done()).on_step =
      [&](ScriptedUnit&, Time, Time to) {
        asked.push_back(to);
        return reached(to);
      };
  for (const auto stop : {300us, 200us}) {
    system.add("s" + std::to_string(stop.count()), plain().may_return_early().done()).on_step =
        Behaviour{{at(stop)}};
  }
  system.options.threads = forced(threads);
  system.build(0.001, 1ms).run();
  CHECK(asked == std::vector<Time>{at(200us), at(300us), at(1ms)});
  const auto& statistics = system.simulation->statistics();
  CHECK(statistics.units[1].early_returns == 2);  // at 0.3 ms, undone; and again
  CHECK(statistics.units[1].rollbacks == 1);
  CHECK(statistics.units[2].early_returns == 1);
  CHECK(statistics.units[2].rollbacks == 1);
}

TEST_CASE("threads that do not pay are not used, and those that do change nothing") {
  const auto run = [](std::size_t threads, int work) {
    ScriptedSystem system;
    for (const char* name : {"a", "b", "c"}) {
      system.add(name, plain().done()).on_step = [work](ScriptedUnit& unit, Time from, Time to) {
        for (int i = 0; i < work; ++i) advance(unit, (to - from) / work);
        return reached(to);
      };
    }
    system.wire("a", "y", "b", "u");
    system.wire("b", "y", "c", "u");
    system.wire("c", "y", "a", "u");
    system.options.threads.count = threads;
    Trace trace;
    system.build(0.3, 1ms, all_outputs(system)).add_observer(trace);
    system.simulation->run();
    trace.add(system.simulation->statistics());
    return trace.words;
  };
  for (const int work : {1, 2000}) CHECK(run(2, work) == run(1, work));
}
