// Several kept states, states as bytes, and the way back to the beginning.
#include "master/loader/fmu/fmu.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ValueType;

namespace {

/// An instance of fmi2_relaxation: x goes from 1 to its input u.
class Relaxation {
 public:
  Relaxation() : Relaxation(false) {}
  /// `serializes`: whether the description says that it can be serialised, which it cannot.
  explicit Relaxation(bool serializes) : fmu_(importer::Fmu::load(test_fmu("fmi2_relaxation"))) {
    auto description = std::make_shared<core::UnitDescription>(*fmu_->description());
    description->can_serialize_state = serializes;
    unit_ = make_unit(fmu_, "unit", {.description = std::move(description)});
  }

  core::Unit& operator*() { return *unit_; }
  core::Unit* operator->() { return unit_.get(); }
  void start() {
    now_ = {};
    unit_->enter_initialization(now_, std::nullopt);
    unit_->exit_initialization();
  }
  double step() {
    unit_->step({now_, now_ + 10ms});
    now_ += 10ms;
    return x();
  }
  void stand_at(Time time) { now_ = time; }
  double x() {
    core::ValueBlock block(ValueType::Float64, 1);
    unit_->get({&reference("x"), 1}, block);
    return block.numbers<double>()[0];
  }
  void set_u(double value) {
    core::ValueBlock block(ValueType::Float64, 1);
    block.numbers<double>()[0] = value;
    unit_->set({&reference("u"), 1}, block);
  }

 private:
  const core::ValueReference& reference(const std::string& name) const {
    const auto& description = *fmu_->description();
    return description.variables[description.find(name).value()].reference;
  }

  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
  Time now_{};
};

}  // namespace

TEST_CASE("several states are kept at once, each in its slot, and steps do not change them") {
  Relaxation unit;
  unit.start();
  const double first = unit.step();
  state(*unit).save_state();
  const double second = unit.step();
  state(*unit).select_state(3);
  state(*unit).save_state();
  const double third = unit.step();
  CHECK(third < second);
  CHECK(second < first);

  state(*unit).select_state(0);
  state(*unit).restore_state();
  unit.stand_at(Time(10ms));
  CHECK(unit.x() == first);
  CHECK(unit.step() == second);
  state(*unit).select_state(3);
  state(*unit).restore_state();
  CHECK(unit.x() == second);
  CHECK(unit.step() == third);
  state(*unit).select_state(1);
  CHECK_THAT(run_error([&] { state(*unit).restore_state(); }),
             Contains("no state of it has been saved"));
}

TEST_CASE("after a reset the unit is new: inputs wait for its initialization again") {
  Relaxation unit;
  unit.set_u(5);
  unit.start();
  const double rising = unit.step();
  CHECK(rising > 1);
  resetting(*unit).reset();
  unit.start();
  CHECK(unit.x() == 1);
  CHECK(unit.step() < 1);
  resetting(*unit).reset();
  unit.set_u(5);
  unit.start();
  CHECK(unit.step() == rising);
  unit->terminate();
  resetting(*unit).reset();
  unit.start();
  CHECK(unit.x() == 1);
}

TEST_CASE("a unit without the functions for it cannot be serialised") {
  CHECK(Relaxation()->capability<core::StateSerialization>() == nullptr);
  Relaxation unit(true);
  unit.start();
  CHECK_THAT(run_error([&] { serialization(*unit).serialize_state(); }),
             Contains("no state of it has been saved"));
  state(*unit).save_state();
  CHECK_THAT(run_error([&] { serialization(*unit).serialize_state(); }),
             Contains("its library does not export fmi2SerializedFMUstateSize") &&
                 Contains("canSerializeFMUstate"));
  CHECK_THAT(run_error([&] { serialization(*unit).deserialize_state({}); }),
             Contains("its library does not export fmi2DeSerializeFMUstate"));
}
