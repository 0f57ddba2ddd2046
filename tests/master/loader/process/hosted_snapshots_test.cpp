// Units that have no state, saved and restored as those that have one.
#include <algorithm>
#include <csignal>

#include <catch2/catch.hpp>

#include "tests/master/loader/process/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Contains;
using core::ValueType;

namespace {

/// In a process of its own, with snapshots if it has no state.
class Hosted : public Fixture {
 public:
  explicit Hosted(const std::string& unit, const fs::path& writable = {})
      : Fixture(unit, true, options(writable)) {}

  core::HostStatistics statistics() { return host_diagnostics(**this).host_statistics(); }
  std::uint64_t steps() { return get("steps").numbers<std::uint64_t>()[0]; }

 private:
  static isolation::HostOptions options(const fs::path& writable) {
    isolation::HostOptions options;
    options.takes_snapshots = true;
    if (!writable.empty()) options.writable.push_back(writable);
    return options;
  }
};

}  // namespace

TEST_CASE("a unit without a state is what it was at its snapshot, any number of times") {
  Hosted unit("rejecter_without_state");
  unit.start();
  unit.set("u", "2");
  unit.step(0, 0.5);
  state(*unit).save_state();
  for (int i = 1; i <= 100; ++i) {
    unit.step(0.5, 0.5 + 0.005 * i);
    CHECK(unit.number("y") == Approx(1 + 0.01 * i));
    state(*unit).restore_state();
    CHECK(unit.number("y") == 1);
    CHECK(unit.steps() == 1);
  }
  CHECK(unit.statistics().snapshots == 1);
  CHECK(unit.statistics().restores == 100);
  CHECK(unit.statistics().most_snapshots == 1);
  unit->terminate();
}

TEST_CASE("each slot keeps a snapshot of its own, and a later one takes its place") {
  Hosted unit("rejecter_without_state");
  unit.start();
  const auto steps_in = [&](std::size_t slot) {
    state(*unit).select_state(slot);
    state(*unit).restore_state();
    return unit.steps();
  };
  for (const std::size_t slot : {0, 5, 2}) {
    const auto steps = static_cast<double>(unit.steps());
    unit.step(steps, steps + 1);
    state(*unit).select_state(slot);
    state(*unit).save_state();
  }
  CHECK(steps_in(0) == 1);
  CHECK(steps_in(2) == 3);
  CHECK(steps_in(5) == 2);
  CHECK(steps_in(0) == 1);
  unit.step(1, 2);
  unit.step(2, 3);
  state(*unit).save_state();
  CHECK(steps_in(2) == 3);
  CHECK(steps_in(0) == 3);
  CHECK(unit.statistics().most_snapshots == 3);
}

TEST_CASE("steps with values go on behind a snapshot as before it") {
  Hosted unit("rejecter_without_state");
  unit.start();
  core::ValueBlock u(ValueType::Float64, 1), y(ValueType::Float64, 1);
  const core::BoundValues input({&unit.variable("u").reference, 1}, u),
      output({&unit.variable("y").reference, 1}, y);
  const core::StepValues values{{&input, 1}, {&output, 1}};
  state(*unit).save_state();
  for (double value : {1.0, 2.0, 3.0}) {
    u.numbers<double>()[0] = value;
    unit->step({Time(), time_from_seconds(0.5)}, values);
    CHECK(y.numbers<double>()[0] == value / 2);
    state(*unit).restore_state();
  }
}

TEST_CASE("a unit that has a state needs no snapshot") {
  Hosted unit("rejecter");
  unit.start();
  state(*unit).save_state();
  unit.step(0, 0.1);
  state(*unit).restore_state();
  CHECK(unit.steps() == 0);
  CHECK(unit.statistics().snapshots == 0);
}

TEST_CASE("a trace has each step once, whatever was taken back") {
  const bool flushes = GENERATE(false, true);
  const Scratch scratch;
  const fs::path file = scratch / "trace";
  {
    Hosted unit("tracer", file.parent_path());
    unit.start({{"file", file.string()}, {"flushes", flushes ? "1" : "0"}});
    for (int i = 0; i < 20; ++i) {
      state(*unit).save_state();
      unit.step(i, i + 0.75);
      state(*unit).restore_state();
      unit.step(i, i + 0.5);
      state(*unit).restore_state();
      unit.step(i, i + 1);
    }
    unit->terminate();
  }
  std::string expected;
  for (int i = 1; i <= 20; ++i) expected += std::to_string(i) + " 0\n";
  CHECK(read(file) == expected);
}

TEST_CASE("a unit with threads is refused, with its name, the time and what to do") {
  Hosted unit("threader");
  unit.start({{"has_thread", "1"}});
  unit.step(0, 0.25);
  CHECK_THROWS_WITH(state(*unit).save_state(),
                    Contains("unit 'u', at 0.25 s: the unit runs 2 threads, and a snapshot of its "
                             "process holds one only") &&
                        Contains("OMP_NUM_THREADS=1"));
  Hosted other("threader");
  other.start();
  state(*other).save_state();
  CHECK(other.statistics().snapshots == 1);
}

TEST_CASE("what was not saved cannot be restored, and more than a few are not kept") {
  Hosted unit("rejecter_without_state");
  unit.start();
  CHECK_THROWS_WITH(state(*unit).restore_state(),
                    Contains("unit 'u'") && Contains("nothing was saved"));
  state(*unit).select_state(100);
  CHECK_THROWS_WITH(state(*unit).save_state(), Contains("101 states"));
  unit.step(0, 0.1);
  CHECK(unit.steps() == 1);
}

TEST_CASE("functions are counted also where their effects were taken back") {
  Hosted unit("rejecter_without_state");
  unit.start();
  state(*unit).save_state();
  std::uint64_t before = diagnostics(*unit).calls();
  for (int i = 0; i < 10; ++i) {
    unit.step(0, 0.1);
    state(*unit).restore_state();
    CHECK(diagnostics(*unit).calls() > before);
    before = diagnostics(*unit).calls();
  }
}

TEST_CASE("a unit that was restored fails as any other") {
  Hosted unit("lying_exits_in_step");
  unit.start();
  state(*unit).save_state();
  state(*unit).restore_state();
  CHECK_THROWS_WITH(
      [&] {
        for (int i = 0; i < 1000; ++i) unit.step(0.001 * i, 0.001 * (i + 1));
      }(),
      Contains("unit 'u'") && Contains("ended its process with exit code"));
}

TEST_CASE("the statistics have the memory of the unit and of a snapshot") {
  Hosted unit("rejecter_without_state");
  unit.start();
  for (int i = 0; i < 5; ++i) {
    state(*unit).save_state();
    unit.step(i, i + 1);
  }
  CHECK(unit.statistics().most_memory > 1000000);
  CHECK(unit.statistics().most_snapshot_memory > 0);
  CHECK(unit.statistics().most_snapshot_memory < unit.statistics().most_memory);
}

TEST_CASE("a unit of FMI 2.0 without a state is taken back, too") {
  Hosted unit("fmi2_relaxation_without_state");
  unit.start();
  unit.set("u", "3");
  unit.step(0, 0.1);
  state(*unit).save_state();
  const double before = unit.number("x");
  for (int i = 0; i < 3; ++i) {
    unit.step(0.1, 0.2);
    CHECK(unit.number("x") > before);
    state(*unit).restore_state();
    CHECK(unit.number("x") == before);
  }
  CHECK(unit.statistics().restores == 3);
}

TEST_CASE("snapshots end with the unit, and nothing of them stays") {
  const Belongings before;
  {
    Hosted unit("rejecter_without_state");
    unit.start();
    for (const std::size_t slot : {0, 1, 2}) {
      state(*unit).select_state(slot);
      state(*unit).save_state();
      state(*unit).save_state();
    }
    state(*unit).restore_state();
  }
  CHECK(before == Belongings());
}

TEST_CASE("snapshots end with the supervisor") {
  Hosted unit("rejecter_without_state");
  unit.start();
  state(*unit).save_state();
  state(*unit).restore_state();
  const std::vector<pid_t> processes = children(Hosted::supervisor());
  CHECK(processes.size() >= 2);
  ::kill(Hosted::supervisor(), SIGKILL);
  CHECK(std::all_of(processes.begin(), processes.end(), has_ended));
  CHECK_THROWS_WITH(unit.step(0, 0.1), Contains("unit 'u'") && Contains("ended its supervisor"));
}

TEST_CASE("the end of a restored unit's process is an error with its cause") {
  Hosted unit("rejecter_without_state");
  unit.start();
  state(*unit).save_state();
  state(*unit).restore_state();
  // the snapshot is not the active process, so it is not missed before it is needed
  for (const pid_t process : children(Hosted::supervisor())) ::kill(process, SIGKILL);
  CHECK_THROWS_WITH(
      [&] {
        for (int i = 0; i < 1000; ++i) unit.step(0.001 * i, 0.001 * (i + 1));
      }(),
      Contains("unit 'u'") && Contains("SIGKILL"));
}
