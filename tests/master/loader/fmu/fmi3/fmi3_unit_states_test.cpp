// Several kept states, states as bytes, and the way back to the beginning.
#include "master/loader/fmu/fmu.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ValueType;

namespace {

/// An instance of `stepper`, which counts its steps, at 0 s in Step Mode.
class Stepper {
 public:
  explicit Stepper(const std::string& fmu = "stepper")
      : fmu_(importer::Fmu::load(test_fmu(fmu))), unit_(make_unit(fmu_, "unit")) {}

  core::Unit& operator*() { return *unit_; }
  core::Unit* operator->() { return unit_.get(); }
  void start() {
    unit_->enter_initialization({}, std::nullopt);
    unit_->exit_initialization();
    unit_->update_discrete_states();
    unit_->enter_step_mode();
  }
  void step(int count, Time from = {}) {
    for (int i = 0; i < count; ++i) unit_->step({from + i * 10ms, from + (i + 1) * 10ms});
  }
  int steps() {
    const auto& description = *fmu_->description();
    core::ValueBlock block(ValueType::Int32, 1);
    unit_->get({&description.variables[*description.find("steps")].reference, 1}, block);
    return block.numbers<std::int32_t>()[0];
  }

 private:
  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
};

}  // namespace

TEST_CASE("several states are kept at once, each in its slot") {
  Stepper unit;
  unit.start();
  for (std::size_t slot : {0, 5, 2}) {
    unit.step(1, Time(unit.steps() * 10ms));
    state(*unit).select_state(slot);
    state(*unit).save_state();
  }
  const auto restored = [&](std::size_t slot) {
    state(*unit).select_state(slot);
    state(*unit).restore_state();
    return unit.steps();
  };
  CHECK(restored(0) == 1);
  CHECK(restored(2) == 3);
  CHECK(restored(5) == 2);
  CHECK(restored(0) == 1);
  state(*unit).select_state(7);
  CHECK_THAT(run_error([&] { state(*unit).restore_state(); }),
             Contains("no state of it has been saved"));
}

TEST_CASE("bytes of a state continue in another instance that was never started") {
  Stepper unit;
  unit.start();
  unit.step(3);
  state(*unit).save_state();
  const std::vector<std::uint8_t> bytes = serialization(*unit).serialize_state();
  Stepper other;
  serialization(*other).deserialize_state(bytes);
  state(*other).restore_state();
  CHECK(other.steps() == 3);
  other.step(1, Time(30ms));
  CHECK(other.steps() == 4);
  state(*other).save_state();
  CHECK(serialization(*other).serialize_state().size() == bytes.size());
}

TEST_CASE("bytes that are not a state, and a state that is not there, are errors, and no more") {
  Stepper unit;
  CHECK_THAT(run_error([&] { serialization(*unit).serialize_state(); }),
             Contains("no state of it has been saved"));
  CHECK_THAT(run_error([&] { serialization(*unit).deserialize_state({}); }),
             Contains("fmi3DeserializeFMUState returned fmi3Error"));
  unit.start();
  unit.step(1);
  CHECK(unit.steps() == 1);
}

TEST_CASE("after a reset the unit is new, and keeps its states") {
  Stepper unit;
  unit.start();
  unit.step(3);
  state(*unit).save_state();
  resetting(*unit).reset();
  unit.start();
  CHECK(unit.steps() == 0);
  unit.step(1);
  CHECK(unit.steps() == 1);
  state(*unit).restore_state();
  CHECK(unit.steps() == 3);
}

TEST_CASE("a failed unit can be reset, and a terminated one") {
  Stepper unit;
  CHECK_THROWS_AS(unit->exit_initialization(), core::Error);
  CHECK_THROWS_AS(unit->exit_initialization(), core::Error);
  resetting(*unit).reset();
  unit.start();
  unit.step(2);
  unit->terminate();
  resetting(*unit).reset();
  unit.start();
  CHECK(unit.steps() == 0);
}
