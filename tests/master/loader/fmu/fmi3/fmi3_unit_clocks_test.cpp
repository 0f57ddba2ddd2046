// Time-based clocks of a unit, inputs within its steps, and the number of its calls.
#include <limits>

#include "master/loader/fmu/fmi3/fmi3_unit.h"
#include "master/loader/fmu/fmu.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ClockInterval;
using core::Interval;
using core::ValueBlock;
using core::ValueType;

namespace {

struct ClocksFixture {
  explicit ClocksFixture(const std::string& name, importer::InstanceOptions options = {})
      : fmu(importer::Fmu::load(test_fmu(name))),
        unit(make_unit(fmu, "unit", std::move(options))) {}

  const core::Variable& variable(const std::string& name) const {
    return fmu->description()->variables[fmu->description()->find(name).value()];
  }
  void set(const std::string& name, const std::string& text) {
    const core::Variable& target = variable(name);
    unit->set(std::span(&target.reference, 1), core::parse(target, text));
  }
  void set_clock(const std::string& name) {
    ValueBlock tick(ValueType::Clock, 1);
    tick.numbers<bool>()[0] = true;
    unit->set(std::span(&variable(name).reference, 1), tick);
  }
  double real(const std::string& name) {
    ValueBlock block(ValueType::Float64, 1);
    unit->get(std::span(&variable(name).reference, 1), block);
    return block.numbers<double>()[0];
  }
  ClockInterval interval(const std::string& clock) {
    return clocks(*unit).clock_interval(variable(clock));
  }
  void start() {
    unit->enter_initialization({}, std::nullopt);
    unit->exit_initialization();
    unit->update_discrete_states();
    unit->enter_step_mode();
  }

  std::shared_ptr<importer::Fmu> fmu;
  std::unique_ptr<core::Unit> unit;
};

/// The extended raw unit, whose one clock has this kind and these attributes.
struct RawClock {
  RawClock(const std::string& behaviour, const std::string& attributes) {
    const fs::path folder = make_raw_fmu(scratch, "raw_extended");
    const std::string clock =
        "<Clock name=\"tick\" valueReference=\"1\" causality=\"input\" " + attributes + "/>\n";
    scratch.write("raw_extended/modelDescription.xml",
                  description_text("raw_extended", "hasEventMode=\"true\"", clock));
    fmu = importer::Fmu::load(folder);
    unit = make_unit(fmu, behaviour);
    unit->enter_initialization(Time(2s), std::nullopt);
  }
  const core::Variable& tick() const { return fmu->description()->variables[0]; }

  Scratch scratch;
  std::shared_ptr<importer::Fmu> fmu;
  std::unique_ptr<core::Unit> unit;
};

/// Sets x_other to 100 times the seconds since the beginning of the step, and counts.
struct Follower {
  explicit Follower(ClocksFixture& fixture) : f(fixture) {}
  void operator()(double seconds) const {
    ++*calls;
    f.set("x_other", std::to_string(100 * seconds));
  }
  ClocksFixture& f;
  std::shared_ptr<int> calls = std::make_shared<int>(0);
};

importer::InstanceOptions intermediate() {
  importer::InstanceOptions options;
  options.intermediate_update = true;
  return options;
}

}  // namespace

TEST_CASE("intervals are exact, with their qualifiers") {
  ClocksFixture f("clocks");
  f.set("interval", "0.0125");
  f.unit->enter_initialization({}, std::nullopt);
  CHECK(f.interval("fixed_by_unit").state == ClockInterval::State::Changed);
  CHECK(f.interval("fixed_by_unit").interval == Interval::from_fraction(1, 80));
  CHECK(f.interval("fixed_by_unit").state == ClockInterval::State::Unchanged);
  CHECK(clocks(*f.unit).clock_shift(f.variable("fixed_by_unit")) ==
        Interval::from_fraction(1, 2000));
  CHECK(f.interval("countdown").state == ClockInterval::State::NotYetKnown);
}

TEST_CASE("a unit without fractions gives decimals") {
  RawClock raw("regular", "intervalVariability=\"fixed\"");
  CHECK(clocks(*raw.unit).clock_interval(raw.tick()).interval == Interval::from_fraction(1, 4));
  CHECK(clocks(*raw.unit).clock_shift(raw.tick()) == Interval::from_fraction(1, 8));
  RawClock wise("wise", "intervalVariability=\"countdown\"");
  CHECK(clocks(*wise.unit).clock_interval(wise.tick()).state == ClockInterval::State::NotYetKnown);
}

TEST_CASE("what is not an interval names the clock, the function and the time") {
  const std::string fixed = "intervalVariability=\"fixed\"";
  RawClock backwards("backwards", fixed);
  CHECK_THAT(run_error([&] { clocks(*backwards.unit).clock_interval(backwards.tick()); }),
             Contains("unit 'backwards', variable 'tick', at 2 s: fmi3GetIntervalDecimal gave no "
                      "length of time: it is negative"));
  RawClock vague("vague", fixed);
  CHECK_THAT(run_error([&] { clocks(*vague.unit).clock_interval(vague.tick()); }),
             Contains("variable 'tick'") && Contains("it is not a number"));
  RawClock promising("promising", fixed + " supportsFraction=\"true\"");
  CHECK_THAT(run_error([&] { clocks(*promising.unit).clock_interval(promising.tick()); }),
             Contains("variable 'tick'") && Contains("does not export fmi3GetIntervalFraction"));
}

TEST_CASE("inputs within a step are set through the port") {
  ClocksFixture held("oscillator_mass");
  ClocksFixture following("oscillator_mass", intermediate());
  const Follower follower(following);
  inputs_within_step(*following.unit).set_input_update(follower);
  for (ClocksFixture* f : {&held, &following}) {
    f->set("largest_step", "0.05");
    f->start();
    CHECK(f->unit->step({{}, Time(100ms)}).reached == Time(100ms));
  }
  CHECK(*follower.calls == 7);
  CHECK(following.real("x_other") == Approx(10));
  CHECK(held.real("x_other") == 0);
  CHECK(following.real("x") > held.real("x") + 0.05);
  inputs_within_step(*following.unit).set_input_update({});
  CHECK(following.unit->step({Time(100ms), Time(200ms)}).reached == Time(200ms));
  CHECK(*follower.calls == 7);
}

TEST_CASE("inputs within a step are not requested without the option, nor of a unit without them") {
  ClocksFixture f("oscillator_mass");
  inputs_within_step(*f.unit).set_input_update([](double) { FAIL("it asked"); });
  f.start();
  CHECK(f.unit->step({{}, Time(10ms)}).reached == Time(10ms));
  CHECK(ClocksFixture("stepper", intermediate()).unit->capability<core::InputsWithinStep>() ==
        nullptr);
}

TEST_CASE("an exception of a callback within a step is thrown after it, and the unit goes on") {
  ClocksFixture f("oscillator_mass", intermediate());
  int asked = 0;
  inputs_within_step(*f.unit).set_input_update([&](double) {
    ++asked;
    throw std::out_of_range("no such instant");
  });
  f.start();
  CHECK_THROWS_AS(f.unit->step({{}, Time(10ms)}), std::out_of_range);
  CHECK(asked == 1);
  CHECK(f.real("x") != 0);
}

TEST_CASE("an input that the unit refuses within a step is the step's error") {
  ClocksFixture f("oscillator_mass", intermediate());
  inputs_within_step(*f.unit).set_input_update([&](double) { f.set("mass", "2"); });
  f.start();
  CHECK_THAT(run_error([&] {
               f.unit->step({{}, Time(10ms)});
             }),
             Contains("fmi3SetFloat64") && Contains("variable 'mass'"));
}

TEST_CASE("the calls of a unit's functions are counted") {
  ClocksFixture f("clocks");
  CHECK(diagnostics(*f.unit).calls() == 1);  // the instantiation
  f.start();                                 // four more
  CHECK(diagnostics(*f.unit).calls() == 5);
  f.unit->step({{}, Time(1ms)});
  f.unit->enter_event_mode();
  f.set_clock("constant");
  f.unit->update_discrete_states();
  f.interval("countdown");
  state(*f.unit).save_state();
  CHECK(diagnostics(*f.unit).calls() == 11);
}
