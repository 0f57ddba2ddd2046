// Units that have no state, saved and restored as those that have one.
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>

#include <catch2/catch.hpp>

#include "master/core/error.h"
#include "master/fmi/fmu.h"
#include "master/host/hosted_unit.h"
#include "tests/master/fmi/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Contains;
using core::ValueType;

namespace {

/// An instance in a process of its own, with snapshots if it has no state.
class Hosted {
 public:
  explicit Hosted(const std::string& unit, const fs::path& writable = {})
      : fmu_(fmi::Fmu::load(test_fmu(unit))) {
    host::HostOptions options;
    options.takes_snapshots = true;
    if (!writable.empty()) options.writable.push_back(writable);
    unit_ = host::instantiate(fmu_, "u", {.early_return_allowed = true}, options);
  }

  core::Unit* operator->() { return unit_.get(); }
  core::HostStatistics statistics() const { return unit_->host_statistics().value(); }

  Hosted& start() {
    unit_->enter_initialization({}, std::nullopt);
    unit_->exit_initialization();
    if (fmu_->description()->has_event_mode) {
      unit_->update_discrete_states();
      unit_->enter_step_mode();
    }
    return *this;
  }
  core::StepResult step(Time from, Time to) { return unit_->step({from, to}); }

  template <class T>
  T get(const std::string& name) {
    core::ValueBlock block(type_of(name), 1);
    unit_->get({&reference(name), 1}, block);
    return block.numbers<T>()[0];
  }
  template <class T>
  void set(const std::string& name, T value) {
    core::ValueBlock block(type_of(name), 1);
    if constexpr (std::is_same_v<T, std::string>) {
      block.strings()[0] = value;
    } else {
      block.numbers<T>()[0] = value;
    }
    unit_->set({&reference(name), 1}, block);
  }
  const core::ValueReference& reference(const std::string& name) const {
    return variable(name).reference;
  }

 private:
  const core::Variable& variable(const std::string& name) const {
    const auto& description = *fmu_->description();
    return description.variables.at(description.find(name).value());
  }
  ValueType type_of(const std::string& name) const { return variable(name).type; }

  std::shared_ptr<fmi::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
};

Time at(double seconds) { return time_from_seconds(seconds); }

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("a unit without a state is what it was at its snapshot, any number of times") {
  Hosted unit("rejecter_without_state");
  unit.start().set("u", 2.0);
  unit.step(at(0), at(0.5));
  unit->save_state();
  for (int i = 1; i <= 100; ++i) {
    unit.step(at(0.5), at(0.5 + 0.005 * i));
    CHECK(unit.get<double>("y") == Approx(1 + 0.01 * i));
    unit->restore_state();
    CHECK(unit.get<double>("y") == 1);
    CHECK(unit.get<std::uint64_t>("steps") == 1);
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
    unit->select_state(slot);
    unit->restore_state();
    return unit.get<std::uint64_t>("steps");
  };
  for (const std::size_t slot : {0, 5, 2}) {
    const auto steps = static_cast<double>(unit.get<std::uint64_t>("steps"));
    unit.step(at(steps), at(steps + 1));
    unit->select_state(slot);
    unit->save_state();
  }
  CHECK(steps_in(0) == 1);
  CHECK(steps_in(2) == 3);
  CHECK(steps_in(5) == 2);
  CHECK(steps_in(0) == 1);
  unit.step(at(1), at(2));
  unit.step(at(2), at(3));
  unit->save_state();
  CHECK(steps_in(2) == 3);
  CHECK(steps_in(0) == 3);
  CHECK(unit.statistics().most_snapshots == 3);
}

TEST_CASE("steps with values go on behind a snapshot as before it") {
  Hosted unit("rejecter_without_state");
  unit.start();
  core::ValueBlock u(ValueType::Float64, 1), y(ValueType::Float64, 1);
  const core::BoundValues input({&unit.reference("u"), 1}, u), output({&unit.reference("y"), 1}, y);
  const core::StepValues values{{&input, 1}, {&output, 1}};
  unit->save_state();
  for (double value : {1.0, 2.0, 3.0}) {
    u.numbers<double>()[0] = value;
    unit->step({at(0), at(0.5)}, values);
    CHECK(y.numbers<double>()[0] == value / 2);
    unit->restore_state();
  }
}

TEST_CASE("a unit that has a state needs no snapshot") {
  Hosted unit("rejecter");
  unit.start();
  unit->save_state();
  unit.step(at(0), at(0.1));
  unit->restore_state();
  CHECK(unit.get<std::uint64_t>("steps") == 0);
  CHECK(unit.statistics().snapshots == 0);
}

TEST_CASE("a trace has each step once, whatever was taken back") {
  const bool flushes = GENERATE(false, true);
  const Scratch scratch;
  const fs::path file = scratch / "trace";
  {
    Hosted unit("tracer", file.parent_path());
    unit.set("file", file.string());
    unit.set("flushes", flushes);
    unit.start();
    for (int i = 0; i < 20; ++i) {
      unit->save_state();
      unit.step(at(i), at(i + 0.75));
      unit->restore_state();
      unit.step(at(i), at(i + 0.5));
      unit->restore_state();
      unit.step(at(i), at(i + 1));
    }
    unit->terminate();
  }
  std::string expected;
  for (int i = 1; i <= 20; ++i) expected += std::to_string(i) + " 0\n";
  CHECK(text_of(file) == expected);
}

TEST_CASE("a unit with threads is refused, with its name, the time and what to do") {
  Hosted unit("threader");
  unit.set("has_thread", true);
  unit.start();
  unit.step(at(0), at(0.25));
  CHECK_THROWS_WITH(unit->save_state(),
                    Contains("unit 'u', at 0.25 s: the unit runs 2 threads, and a snapshot of its "
                             "process holds one only") &&
                        Contains("OMP_NUM_THREADS=1"));
  Hosted other("threader");
  other.start();
  other->save_state();
  CHECK(other.statistics().snapshots == 1);
}

TEST_CASE("what was not saved cannot be restored, and more than a few are not kept") {
  Hosted unit("rejecter_without_state");
  unit.start();
  CHECK_THROWS_WITH(unit->restore_state(), Contains("unit 'u'") && Contains("nothing was saved"));
  unit->select_state(100);
  CHECK_THROWS_WITH(unit->save_state(), Contains("101 states"));
  unit.step(at(0), at(0.1));
  CHECK(unit.get<std::uint64_t>("steps") == 1);
}

TEST_CASE("functions are counted also where their effects were taken back") {
  Hosted unit("rejecter_without_state");
  unit.start();
  unit->save_state();
  std::uint64_t before = unit->calls();
  for (int i = 0; i < 10; ++i) {
    unit.step(at(0), at(0.1));
    unit->restore_state();
    CHECK(unit->calls() > before);
    before = unit->calls();
  }
}

TEST_CASE("a unit that was restored fails as any other") {
  Hosted unit("lying_exits_in_step");
  unit.start();
  unit->save_state();
  unit->restore_state();
  CHECK_THROWS_WITH(
      [&] {
        for (int i = 0; i < 1000; ++i) unit.step(Time(i * 1ms), Time((i + 1) * 1ms));
      }(),
      Contains("unit 'u'") && Contains("ended its process with exit code"));
}

TEST_CASE("memory is told: the unit's, and what a snapshot keeps") {
  Hosted unit("rejecter_without_state");
  unit.start();
  for (int i = 0; i < 5; ++i) {
    unit->save_state();
    unit.step(at(i), at(i + 1));
  }
  CHECK(unit.statistics().most_memory > 1000000);
  CHECK(unit.statistics().most_snapshot_memory > 0);
  CHECK(unit.statistics().most_snapshot_memory < unit.statistics().most_memory);
}
