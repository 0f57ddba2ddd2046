// What the decorator writes of the calls that a unit gets.
#include "master/observe/capture/captured_unit.h"

#include <catch2/catch.hpp>

#include "master/base/text/hex.h"
#include "tests/at.h"
#include "tests/master/base/archive/support.h"
#include "tests/master/engine/run/forwarding.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride;
using namespace stride::capture;
using namespace stride::tests;

namespace {

using stride::tests::at;

/// A captured unit with an input u (0), a clock (1), a message at it (2) and a parameter (3).
class Bench {
 public:
  Bench() {
    core::Describe describe("device");
    describe.input("u", "V")
        .add("clock", core::ValueType::Clock, core::Causality::Input)
        .add("message", core::ValueType::Binary, core::Causality::Input)
        .clocked_by(1)
        .add("gain", core::ValueType::Float64, core::Causality::Parameter);
    description_ = describe.event_mode().can_save_state().done();
    auto inner = std::make_unique<core::ScriptedUnit>(description_);
    unit = inner.get();
    file_.emplace(scratch_ / "x.csv", Origin{"part", "whole", description_.get()});
    index.follow(iterations);
    captured.emplace(std::move(inner), *description_, *file_, index);
  }

  void set(core::ValueReference reference, double value) {
    core::ValueBlock block(core::ValueType::Float64, 1);
    block.numbers<double>()[0] = value;
    captured->set({&reference, 1}, block);
  }
  void message(const core::Binary& bytes) {
    core::ValueBlock tick(core::ValueType::Clock, 1);
    tick.numbers<bool>()[0] = true;
    const core::ValueReference clock = 1;
    captured->set({&clock, 1}, tick);
    core::ValueBlock block(core::ValueType::Binary, 1);
    block.binaries()[0] = bytes;
    const core::ValueReference payload = 2;
    captured->set({&payload, 1}, block);
  }
  void step(double from, double to) { captured->step({at(from), at(to)}); }
  /// An event iteration, as the run counts them.
  void iterate() {
    ++iterations;
    captured->update_discrete_states();
  }
  void point(double time) {
    index.on_communication_point(at(time));
    captured->commit();
  }
  void start() {
    captured->enter_initialization({}, std::nullopt);
    captured->exit_initialization();
    iterate();
    captured->enter_step_mode();
    point(0);
  }

  /// The rows behind the head.
  std::string rows() {
    file_->close("completed");
    const std::string text = stride::tests::read(scratch_ / "x.csv");
    const std::string titles = "time,event,variable,value\n";
    return text.substr(text.find(titles) + titles.size());
  }
  std::string text() {
    file_->close("completed");
    return stride::tests::read(scratch_ / "x.csv");
  }

  core::ScriptedUnit* unit = nullptr;
  SuperDenseIndex index;
  std::uint64_t iterations = 0;
  std::optional<CapturedUnit> captured;

 private:
  Scratch scratch_;
  std::shared_ptr<const core::UnitDescription> description_;
  std::optional<StimuliFile> file_;
};

}  // namespace

TEST_CASE("the head has the component of the stimuli, and the values before the start") {
  Bench bench;
  bench.set(3, 2.5);
  idle(*bench.captured).enable_idle_skipping(std::chrono::milliseconds(500));
  bench.start();
  CHECK(bench.text() ==
        "stride stimuli,1\nunit,device\ncomponent,part\nsystem,whole\n"
        "input,u,Float64,continuous,V,,,0\n"
        "input,clock,Clock,discrete,,,\n"
        "input,message,Binary,discrete,,clock,,\n"
        "set,gain,2.5\nskip,0.5\n"
        "time,event,variable,value\n"
        "0,end,,\"completed\"\n");
}

TEST_CASE("initial values are recorded once, as they were at the end of the initialization") {
  Bench bench;
  bench.captured->enter_initialization({}, std::nullopt);
  bench.set(0, 1);
  bench.set(0, 2);
  bench.captured->exit_initialization();
  CHECK(bench.unit->number(0) == 2);
  bench.point(0);
  CHECK(bench.rows() == "0,,u,2\n0,end,,\"completed\"\n");
}

TEST_CASE("values are recorded where they were set, and only where their bits change") {
  Bench bench;
  bench.start();
  bench.set(0, 1);
  bench.step(0, 0.1);
  bench.set(0, 1);
  bench.step(0.1, 0.2);
  bench.set(0, 0.0);
  bench.step(0.2, 0.3);
  bench.set(0, -0.0);
  bench.step(0.3, 0.4);
  bench.point(0.4);
  CHECK(bench.rows() ==
        "0,,u,1\n0,step,,0.1\n0.1,step,,0.2\n0.2,,u,0\n0.2,step,,0.3\n0.3,,u,-0\n0.3,step,,0.4\n"
        "0.4,end,,\"completed\"\n");
}

TEST_CASE("a step that the unit ended early leads to where it was sent") {
  Bench bench;
  bench.start();
  bench.unit->on_step = [](core::ScriptedUnit&, Time, Time) {
    return core::StepResult{.early_return = true, .reached = at(0.07)};
  };
  bench.step(0, 0.1);
  bench.set(0, 3);
  bench.unit->on_step = [](core::ScriptedUnit&, Time, Time to) {
    return core::StepResult{.reached = to};
  };
  bench.step(0.07, 0.2);
  bench.point(0.2);
  CHECK(bench.rows() == "0,step,,0.1\n0.07,,u,3\n0.07,step,,0.2\n0.2,end,,\"completed\"\n");
}

TEST_CASE("what arrives in Event Mode has the number of its iteration in the run") {
  Bench bench;
  bench.start();
  bench.step(0, 0.1);
  bench.iterations += 2;  // of others, before a message comes here
  bench.captured->enter_event_mode();
  bench.message({1, 2});
  bench.iterate();
  bench.set(0, 5);
  bench.message({1, 2});  // the same bytes are another message
  bench.iterate();
  bench.captured->enter_step_mode();
  bench.point(0.1);
  CHECK(bench.rows() ==
        "0,step,,0.1\n0.1,2,clock,\n0.1,2,message,0102\n0.1,3,u,5\n0.1,3,clock,\n"
        "0.1,3,message,0102\n0.1,end,,\"completed\"\n");
}

TEST_CASE("the numbers go on where an instant is left and entered again") {
  Bench bench;
  bench.start();
  bench.step(0, 0.1);
  bench.captured->enter_event_mode();
  bench.message({1});
  bench.iterate();
  bench.captured->enter_step_mode();
  bench.point(0.1);
  bench.captured->enter_event_mode();
  bench.message({2});
  bench.iterate();
  bench.captured->enter_step_mode();
  bench.point(0.1);
  CHECK(bench.rows() ==
        "0,step,,0.1\n0.1,0,clock,\n0.1,0,message,01\n0.1,1,clock,\n0.1,1,message,02\n"
        "0.1,end,,\"completed\"\n");
}

TEST_CASE("a rejected step has not been, an undone one is taken back") {
  Bench bench;
  bench.start();
  bench.set(0, 1);
  state(*bench.captured).save_state();
  bench.unit->on_step = [](core::ScriptedUnit&, Time from, Time) {
    return core::StepResult{.rejected = true, .reached = from};
  };
  bench.step(0, 0.4);
  bench.unit->on_step = [](core::ScriptedUnit&, Time, Time to) {
    return core::StepResult{.reached = to};
  };
  bench.step(0, 0.2);
  state(*bench.captured).restore_state();
  bench.step(0, 0.1);
  bench.point(0.1);
  state(*bench.captured).save_state();
  bench.set(0, 2);
  bench.step(0.1, 0.2);
  state(*bench.captured).restore_state();
  bench.set(0, 2);
  bench.step(0.1, 0.15);
  bench.point(0.15);
  CHECK(bench.rows() == "0,,u,1\n0,step,,0.1\n0.1,,u,2\n0.1,step,,0.15\n0.15,end,,\"completed\"\n");
}

TEST_CASE("what has not been reached by all is not in the file") {
  Bench bench;
  bench.start();
  bench.step(0, 0.1);
  bench.point(0.1);
  bench.set(0, 7);
  bench.step(0.1, 0.2);
  CHECK(bench.rows() == "0,step,,0.1\n0.1,end,,\"completed\"\n");
}

TEST_CASE("the unit itself gets each call") {
  Bench bench;
  bench.start();
  bench.set(0, 4);
  CHECK(bench.unit->number(0) == 4);
  const core::ValueReference u = 0;
  core::ValueBlock block(core::ValueType::Float64, 1);
  bench.captured->get({&u, 1}, block);
  CHECK(block.numbers<double>()[0] == 4);
  bench.unit->on_idle_until = [](core::ScriptedUnit&) { return at(3); };
  CHECK(idle(*bench.captured).idle_until() == at(3));
  bench.unit->on_describe = [](core::ScriptedUnit&, core::ValueReference variable,
                               const core::Binary& value) {
    return fmt::format("{} of {}", core::to_hex(value), variable);
  };
  CHECK(texts(*bench.captured).describe_message(2, {0x26}) == "26 of 2");
  bench.captured->terminate();
  CHECK(bench.unit->calls == std::vector<std::string>{"enter_initialization", "exit_initialization",
                                                      "update_discrete_states", "enter_step_mode",
                                                      "describe_message", "terminate"});
}

TEST_CASE("nothing of the unit is hidden but what cannot be taken back from the file") {
  const Scratch scratch;
  const auto description = core::Describe("device").event_mode().can_save_state().done();
  StimuliFile file(scratch / "x.csv", Origin{"part", "whole", description.get()});
  std::uint64_t iterations = 1;
  SuperDenseIndex index;
  index.follow(iterations);
  CompleteUnit::Calls calls;
  CapturedUnit captured(std::make_unique<CompleteUnit>(calls), *description, file, index);
  check_capabilities(
      captured, {core::StateSerialization::kId, core::Resetting::kId, core::ConcurrentSteps::kId});
  check_idle_promises(captured, calls);
  check_functions(captured, calls);
  check_state_saving(captured, calls);
  CHECK_THROWS_AS(state(captured).select_state(1), std::logic_error);
}

TEST_CASE("a captured unit has no capability that the unit lacks") {
  const Scratch scratch;
  const auto description = core::Describe("device").done();
  StimuliFile file(scratch / "x.csv", Origin{"part", "whole", description.get()});
  const SuperDenseIndex index;
  CapturedUnit captured(std::make_unique<PlainUnit>(), *description, file, index);
  CHECK(capability_numbers(captured).empty());
}
