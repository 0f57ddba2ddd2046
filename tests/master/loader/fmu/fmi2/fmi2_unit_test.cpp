#include "master/loader/fmu/fmi2/fmi2_unit.h"

#include <cmath>
#include <csignal>

#include <dlfcn.h>

#include "master/loader/fmu/fmu.h"
#include "tests/at.h"
#include "tests/counting_allocator.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using core::ValueBlock;
using core::ValueReference;
using core::ValueType;

namespace {

struct Line {
  std::string unit, category, message;
  importer::Status status;
};

/// An instance of one of the FMI 2.0 units, and what it logs.
class Fmi2Fixture {
 public:
  explicit Fmi2Fixture(const std::string& name, importer::InstanceOptions options = {})
      : Fmi2Fixture(importer::Fmu::load(test_fmu(name)), std::move(options)) {}
  explicit Fmi2Fixture(std::shared_ptr<importer::Fmu> fmu, importer::InstanceOptions options = {})
      : fmu_(std::move(fmu)) {
    if (!options.log) {
      options.log = [this](const std::string& unit, importer::Status status,
                           const std::string& category, const std::string& message) {
        lines.push_back({unit, category, message, status});
      };
    }
    unit_ = make_unit(fmu_, "u1", std::move(options));
  }

  core::Unit& operator*() { return *unit_; }
  core::Unit* operator->() { return unit_.get(); }

  ValueReference reference(const std::string& name) const {
    const auto& description = *fmu_->description();
    return description.variables[description.find(name).value()].reference;
  }
  void set(const std::string& name, const ValueBlock& values) {
    const ValueReference r = reference(name);
    unit_->set({&r, 1}, values);
  }
  template <class T>
  void set(ValueType type, const std::string& name, T value) {
    ValueBlock block(type, 1);
    block.numbers<T>()[0] = value;
    set(name, block);
  }
  void set(const std::string& name, double value) { set(ValueType::Float64, name, value); }
  void set_flag(const std::string& name) { set(ValueType::Boolean, name, true); }
  void set_number(const std::string& name, std::int32_t value) {
    set(ValueType::Int32, name, value);
  }
  ValueBlock get(ValueType type, const std::string& name) {
    const ValueReference r = reference(name);
    ValueBlock block(type, 1);
    unit_->get({&r, 1}, block);
    return block;
  }
  double get(const std::string& name) { return get(ValueType::Float64, name).numbers<double>()[0]; }

  Fmi2Fixture& start(Time time = {}) {
    unit_->enter_initialization(time, time + 10s);
    unit_->exit_initialization();
    return *this;
  }
  core::StepResult step(Time from, Time to) { return unit_->step({from, to}); }

  template <class T>
  T global(const char* name) const {
    return *static_cast<T*>(symbol(name));
  }
  void* symbol(const char* name) const {
    void* handle = dlopen(fmu_->load_library()->path().c_str(), RTLD_NOW | RTLD_NOLOAD);
    REQUIRE(handle != nullptr);
    void* const address = dlsym(handle, name);
    dlclose(handle);
    REQUIRE(address != nullptr);
    return address;
  }
  void free() { unit_.reset(); }

  std::vector<Line> lines;

 private:
  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
};

using stride::tests::at;

}  // namespace

// ---- Life ----

TEST_CASE("an FMI 2.0 unit goes through its life cycle", "[here]") {
  Fmi2Fixture unit("fmi2_relaxation");
  CHECK(unit.global<int>("fmi2_living_units") == 1);
  unit.set("k", 3);
  unit.set("x", 5);
  unit.set("u", 1);
  unit.start(Time(1s));
  CHECK(unit.get("x") == 5);
  const core::StepResult result = unit.step(Time(1s), at(1.5));
  CHECK(result.reached_without_request(at(1.5)));
  CHECK(unit.global<double>("fmi2_step_begin") == 1);
  CHECK(unit.global<double>("fmi2_step_size") == 0.5);
  CHECK(unit.global<fmi2Boolean>("fmi2_no_restore") == fmi2True);
  CHECK(unit.get("x") == Approx(1 + 4 * std::exp(-1.5)).epsilon(1e-14));
  CHECK(diagnostics(*unit).calls() == 11);
  CHECK_NOTHROW(unit->terminate());
}

TEST_CASE("instances and states are freed", "[here]") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_relaxation"));
  Fmi2Fixture keeper(fmu);
  {
    Fmi2Fixture unit(fmu);
    unit.start();
    unit.step({}, Time(1s));
    state(*unit).save_state();
    CHECK(unit.global<int>("fmi2_living_units") == 2);
    CHECK(unit.global<int>("fmi2_living_states") == 2);
  }
  CHECK(keeper.global<int>("fmi2_living_units") == 1);
  CHECK(keeper.global<int>("fmi2_living_states") == 0);
}

TEST_CASE("start values of inputs wait for Initialization Mode") {
  Fmi2Fixture unit("fmi2_types");
  ValueBlock text(ValueType::String, 1);
  text.strings()[0] = "hello";
  CHECK_NOTHROW(unit.set("real", 0.5));  // the unit refuses it at this time
  CHECK_NOTHROW(unit.set("string", text));
  CHECK_NOTHROW(unit.set("gain", 4));
  unit.start();
  CHECK(unit.get("real.echo") == 2);
  CHECK(unit.get(ValueType::String, "string.echo").strings()[0] == "hello");
}

TEST_CASE("the error of a failed instantiation has the message of an FMI 2.0 unit") {
  const Scratch scratch;
  const importer::UnpackedFmu unpacked(test_fmu("fmi2_types"));
  fs::copy(unpacked.folder(), scratch / "unit", fs::copy_options::recursive);
  std::string text = read(scratch / "unit/modelDescription.xml");
  const std::string guid = "{fmi2_types}";
  text.replace(text.find(guid), guid.size(), "{another}");
  scratch.write("unit/modelDescription.xml", text);
  const auto fmu = importer::Fmu::load(scratch / "unit");
  CHECK_THAT(run_error([&] {
               make_unit(fmu, "u1", {.where = {"system.ssd", 7}});
             }),
             Contains("system.ssd:7: unit 'u1': fmi2Instantiate failed: the GUID is {another}"));
}

TEST_CASE("the resources are named by a URI") {
  Fmi2Fixture unit("fmi2_types");
  unit.start();
  const std::string uri = unit.get(ValueType::String, "resources").strings()[0];
  CHECK_THAT(uri,
             Catch::Matchers::StartsWith("file:///") && Catch::Matchers::EndsWith("/resources"));
}

TEST_CASE("there is no Event Mode") {
  Fmi2Fixture unit("fmi2_types");
  unit.start();
  CHECK_THAT(run_error([&] { unit->enter_event_mode(); }), Contains("has no Event Mode"));
  CHECK_THAT(run_error([&] { unit->update_discrete_states(); }), Contains("has no Event Mode"));
  CHECK_THAT(run_error([&] { unit->enter_step_mode(); }), Contains("has no Event Mode"));
}

TEST_CASE("an FMI 2.0 unit that allows one instance gets one", "[here]") {
  Fmi2Fixture first("fmi2_grumbler");
  CHECK_THAT(input_error([] { Fmi2Fixture second("fmi2_grumbler"); }),
             Contains("can be instantiated only once per process"));
}

// ---- Values ----

TEST_CASE("values of all types of FMI 2.0 go in and out, whatever value references they share") {
  Fmi2Fixture unit("fmi2_types");
  unit.start();
  ValueBlock text(ValueType::String, 1);
  text.strings()[0] = "grüß Gott";
  unit.set("real", -0.25);
  unit.set("string", text);
  unit.set<std::int32_t>(ValueType::Int32, "integer", -7);
  unit.set<std::int64_t>(ValueType::Enumeration, "mode", 5);
  unit.set<bool>(ValueType::Boolean, "boolean", true);
  unit.step({}, Time(1s));
  CHECK(unit.get("real.echo") == -0.75);
  CHECK(unit.get(ValueType::String, "string.echo") == text);
  CHECK(unit.get(ValueType::Int32, "integer.echo").numbers<std::int32_t>()[0] == -7);
  CHECK(unit.get(ValueType::Enumeration, "mode.echo").numbers<std::int64_t>()[0] == 5);
  CHECK(unit.get(ValueType::Boolean, "boolean.echo").numbers<bool>()[0]);
}

TEST_CASE("aliases have the same value") {
  Fmi2Fixture unit("fmi2_types");
  unit.set("gain", 7);
  unit.start();
  CHECK(unit.get("gain.out") == 7);
  CHECK(unit.get("gain.local") == 7);
}

TEST_CASE("directional derivatives of an FMI 2.0 unit") {
  Fmi2Fixture unit("fmi2_types");
  unit.set("gain", 7);
  unit.start();
  const std::vector knowns{unit.reference("gain"), unit.reference("real")};
  const std::vector unknowns{unit.reference("real.echo")};
  double sensitivity = 0;
  derivatives(*unit).get_directional_derivative(unknowns, knowns, std::vector{1.0, 0.5},
                                                {&sensitivity, 1});
  CHECK(sensitivity == 3.5);
}

TEST_CASE("an enumeration of FMI 2.0 has 32 bits") {
  Fmi2Fixture unit("fmi2_types");
  unit.start();
  const std::int64_t value = GENERATE(std::int64_t{1} << 31, -(std::int64_t{1} << 31) - 1);
  CHECK_THAT(run_error([&] { unit.set<std::int64_t>(ValueType::Enumeration, "mode", value); }),
             Contains("does not fit into an Enumeration of FMI 2.0"));
}

TEST_CASE("after the first exchange an FMI 2.0 unit is stepped without allocating") {
  Fmi2Fixture unit("fmi2_types");
  unit.start();
  const std::vector<ValueReference> reals = {unit.reference("real")};
  const std::vector<ValueReference> flags = {unit.reference("boolean")};
  const std::vector<ValueReference> modes = {unit.reference("mode")};
  const std::vector<ValueReference> texts = {unit.reference("string")};
  const std::vector<ValueReference> outputs = {unit.reference("real.echo"),
                                               unit.reference("gain.out")};
  ValueBlock real(ValueType::Float64, 1), flag(ValueType::Boolean, 1);
  ValueBlock mode(ValueType::Enumeration, 1), text(ValueType::String, 1);
  ValueBlock output(ValueType::Float64, 2);
  text.strings()[0] = std::string(60, 'x');
  const core::BoundValues inputs[] = {{reals, real}, {flags, flag}, {modes, mode}, {texts, text}};
  const core::BoundValues read[] = {{outputs, output}};
  const auto step = [&](int k) {
    return unit->step({Time(k * 1ms), Time((k + 1) * 1ms)}, {inputs, read});
  };
  CHECK(step(0).reached_without_request(Time(1ms)));
  const auto before = allocations.load();
  for (int k = 1; k < 100; ++k) step(k);
  CHECK(allocations.load() == before);
  CHECK(output.numbers<double>()[1] == 3);
}

// ---- Steps ----

TEST_CASE("instants that are one double are one to the unit") {
  Fmi2Fixture unit("fmi2_relaxation");
  unit.start();
  const Time late(std::chrono::seconds(9'000'000));
  CHECK(unit.step(late, late + Duration(1)).reached_without_request(late + Duration(1)));
  CHECK(unit.global<double>("fmi2_step_size") == 0);
}

TEST_CASE(
    "a step that ends early is undone where the state was saved, with the time that was reached") {
  Fmi2Fixture unit("fmi2_turner");
  unit.start();
  const core::StepResult result = unit.step({}, Time(1s));
  CHECK(result.rejected);
  CHECK(result.reached == at(0.25));
  CHECK(diagnostics(*unit).rejection_reason() == "there is a turn at 0.25 s");
  CHECK(unit.get("y") == 0);
  CHECK(unit.step({}, at(0.25)).reached_without_request(at(0.25)));
  CHECK(unit.get("y") == 0.25);
  CHECK(unit.step(at(0.25), Time(1s)).reached_without_request(Time(1s)));
  CHECK(unit.get("y") == Approx(-0.5));
}

TEST_CASE("the inputs of a step that is undone stay set") {
  Fmi2Fixture unit("fmi2_turner");
  unit.start();
  state(*unit).save_state();
  for (int i = 0; i < 3; ++i) CHECK(unit.step({}, Time(1s)).rejected);
  state(*unit).restore_state();
  CHECK(unit.step({}, Time(1s)).reached == at(0.25));
  CHECK(unit.get("y") == 0);
}

TEST_CASE("a state that was just saved for core is not saved again", "[here]") {
  Fmi2Fixture unit("fmi2_turner");
  unit.start();
  const int before = unit.global<int>("fmi2_saved_states");
  state(*unit).save_state();
  CHECK(unit.step({}, Time(1s)).rejected);
  CHECK(unit.get("y") == 0);
  CHECK(unit.step({}, at(0.125)).reached_without_request(at(0.125)));
  CHECK(unit.global<int>("fmi2_saved_states") == before + 1);
  unit.step(at(0.125), at(0.2));
  CHECK(unit.global<int>("fmi2_saved_states") == before + 2);
  state(*unit).restore_state();
  CHECK(unit.step({}, Time(1s)).rejected);
  CHECK(unit.global<int>("fmi2_saved_states") == before + 2);
  CHECK(unit.get("y") == 0);
}

TEST_CASE("a step is undone although the time that was reached is unknown") {
  Fmi2Fixture unit("fmi2_turner");
  unit.set_flag("mute");
  unit.start();
  const core::StepResult result = unit.step({}, Time(1s));
  CHECK(result.rejected);
  CHECK(result.reached == Time{});
  CHECK(diagnostics(*unit).rejection_reason() == "there is a turn at 0.25 s");
  CHECK(unit.step({}, at(0.125)).reached_without_request(at(0.125)));
}

TEST_CASE("a unit without a state stays at the time that it reached, with one warning") {
  Fmi2Fixture unit("fmi2_turner_without_state");
  unit.start();
  const core::StepResult result = unit.step({}, Time(1s));
  CHECK((result.early_return && !result.rejected && !result.terminate_simulation));
  CHECK(result.reached == at(0.25));
  CHECK(unit.get("y") == 0.25);
  std::vector<Line> warnings;
  for (const Line& line : unit.lines) {
    if (line.status == importer::Status::Warning) warnings.push_back(line);
  }
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0].message, Contains("the step to 1 s ended at 0.25 s (fmi2Discard)") &&
                                      Contains("canGetAndSetFMUstate"));
}

TEST_CASE("a unit without a state must report the time that it reached") {
  const bool is_mute = GENERATE(true, false);
  Fmi2Fixture unit("fmi2_turner_without_state");
  unit.set_flag(is_mute ? "mute" : "stays");
  unit.start();
  CHECK_THAT(
      run_error([&] { unit.step({}, Time(1s)); }),
      Contains("unit 'u1', at 0 s: fmi2DoStep returned fmi2Discard in the step to 1 s") &&
          Contains(is_mute ? "does not report how far it came" : "came no further than where") &&
          Contains("message of the unit: there is a turn at 0.25 s") &&
          Contains("hint: try a smaller step"));
}

TEST_CASE("a unit may end the simulation within a step") {
  const bool has_state = GENERATE(true, false);
  Fmi2Fixture unit(has_state ? "fmi2_turner" : "fmi2_turner_without_state");
  unit.set_flag("ends");
  unit.start();
  const core::StepResult result = unit.step({}, Time(1s));
  CHECK((result.terminate_simulation && result.early_return && !result.rejected));
  CHECK(result.reached == at(0.25));
  CHECK(unit.get("y") == 0.25);
  CHECK_NOTHROW(unit->terminate());
}

TEST_CASE("a unit that ends the simulation at an unknown time") {
  const bool has_state = GENERATE(true, false);
  Fmi2Fixture unit(has_state ? "fmi2_turner" : "fmi2_turner_without_state");
  unit.set_flag("ends");
  unit.set_flag("mute");
  unit.start();
  if (!has_state) {
    CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }), Contains("does not report when"));
    return;
  }
  const core::StepResult result = unit.step({}, Time(1s));
  CHECK((result.terminate_simulation && result.early_return));
  CHECK(result.reached == Time{});
  CHECK(unit.get("y") == 0);
}

// ---- Steps that are pending ----

TEST_CASE("a pending step ends by a callback, or by a poll") {
  const int how = GENERATE(0, 1, 3);
  const bool has_state = GENERATE(true, false);
  CAPTURE(how, has_state);
  Fmi2Fixture unit(has_state ? "fmi2_sleeper" : "fmi2_sleeper_without_state");
  unit.set_number("how", how);
  unit.start();
  for (int k = 0; k < 20; ++k) {
    const Time from(k * 50ms), to((k + 1) * 50ms);
    CHECK(unit.step(from, to).reached_without_request(to));
    CHECK(unit.get("y") == Approx(to_seconds(to)));
  }
  CHECK_NOTHROW(unit->terminate());
}

TEST_CASE("the status of a pending step is that of the step") {
  const int how = GENERATE(0, 1, 3);
  CAPTURE(how);
  Fmi2Fixture discards("fmi2_sleeper");
  discards.set_number("how", how);
  discards.set_number("result", fmi2Discard);
  discards.start();
  const core::StepResult result = discards.step({}, Time(1s));
  CHECK(result.rejected);
  CHECK(result.reached == at(0.5));
  CHECK(diagnostics(*discards).rejection_reason() == "the night was short");
  CHECK(discards.get("y") == 0);

  Fmi2Fixture fails("fmi2_sleeper");
  fails.set_number("how", how);
  fails.set_number("result", fmi2Error);
  fails.start();
  CHECK_THAT(run_error([&] { fails.step({}, Time(1s)); }),
             Contains("fmi2DoStep returned fmi2Error: the night was short"));
}

TEST_CASE("a pending step that nothing can end is an error") {
  Fmi2Fixture unit("fmi2_sleeper_without_status");
  unit.set_number("how", 2);
  unit.start();
  CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }),
             Contains("returned fmi2Pending, which a unit without canRunAsynchronuously may not"));
}

TEST_CASE("a step that takes long is logged once, with the unit's own text", "[here]") {
  std::vector<std::string> told;
  std::function<void()> release;
  Fmi2Fixture unit("fmi2_sleeper", {.warn_after = 0ms,
                                    .log = [&](const std::string&, importer::Status status,
                                               const std::string&, const std::string& message) {
                                      CHECK(status == importer::Status::Warning);
                                      told.push_back(message);
                                      release();
                                    }});
  const auto wake = reinterpret_cast<void (*)()>(unit.symbol("sleeper_release"));
  release = wake;
  unit.set_number("how", 2);
  unit.start();
  CHECK(unit.step({}, Time(1s)).reached_without_request(Time(1s)));
  REQUIRE(told.size() == 1);
  CHECK_THAT(told[0],
             Contains("has not finished its step from 0 s yet (fmi2Pending); message of the unit: "
                      "asleep; stride waits for it"));
}

TEST_CASE("a step that is pending ends when the run is interrupted", "[here]") {
  volatile std::sig_atomic_t interrupted = 0;
  Fmi2Fixture unit("fmi2_sleeper", {.interrupted = &interrupted, .warn_after = 0ms, .log = {}});
  unit.set_number("how", 2);
  unit.start();
  interrupted = 1;
  CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }),
             Contains("interrupted before the unit had finished its step from 0 s"));
}

// ---- Inputs within a step ----

TEST_CASE("a unit that interpolates is given the derivatives of its inputs") {
  Fmi2Fixture unit("fmi2_integrator");
  unit.start();
  const ValueReference u = unit.reference("u");
  Time begin{};
  const auto input = [](double t) { return 1 + 2 * t + 3 * t * t; };
  inputs_within_step(*unit).set_input_update([&](double seconds) {
    ValueBlock block(ValueType::Float64, 1);
    block.numbers<double>()[0] = input(to_seconds(begin) + seconds);
    unit->set({&u, 1}, block);
  });
  for (const double end : {0.1, 0.35, 1.0}) {
    unit.set("u", input(to_seconds(begin)));
    CHECK(unit.step(begin, at(end)).reached_without_request(at(end)));
    begin = at(end);
  }
  CHECK(unit.get("x") == Approx(1 + 1 + 1).epsilon(1e-13));
}

TEST_CASE("what an input update throws, step() throws") {
  Fmi2Fixture unit("fmi2_integrator");
  unit.start();
  inputs_within_step(*unit).set_input_update(
      [](double) { throw std::runtime_error("no inputs today"); });
  CHECK_THROWS_WITH(unit.step({}, Time(1s)), "no inputs today");
  inputs_within_step(*unit).set_input_update({});
  unit.set("u", 2);
  unit.step({}, Time(1s));
  CHECK(unit.get("x") == 2);
}

// ---- Failures ----

TEST_CASE("a failure of an FMI 2.0 unit gives its message, with numbers and names") {
  Fmi2Fixture unit("fmi2_grumbler");
  unit.set_number("mood", 3);
  unit.start(Time(2s));
  CHECK_THAT(run_error([&] { unit.step(Time(2s), Time(3s)); }),
             Contains("unit 'u1', at 2 s: fmi2DoStep returned fmi2Error: mood of 3 in channel #4, "
                      "not #r99#"));
  CHECK_THAT(run_error([&] { unit.get("tank.level"); }),
             Contains("fmi2GetReal cannot be called, because fmi2DoStep has failed before"));
  CHECK_NOTHROW(unit->terminate());
}

TEST_CASE("a failure without a word, with a long one and with one that must not be formatted") {
  const auto [mood, expected] = GENERATE(table<int, std::string>(
      {{5, "the unit gives no reason"}, {6, std::string(999, ' ') + "6"}, {7, "100%n"}}));
  Fmi2Fixture unit("fmi2_grumbler");
  unit.set_number("mood", mood);
  unit.start();
  CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }), Contains("fmi2Error: " + expected));
}

TEST_CASE("a status that FMI 2.0 does not have is an error that contains it") {
  Fmi2Fixture unit("fmi2_grumbler");
  unit.set_number("mood", 77);
  unit.start();
  CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }),
             Contains("fmi2DoStep returned 77, a status that FMI 2.0 does not have"));
}

TEST_CASE("a warning of an FMI 2.0 unit is logged and the step is accepted") {
  Fmi2Fixture unit("fmi2_grumbler");
  unit.set_number("mood", 1);
  unit.start();
  CHECK(unit.step({}, Time(1s)).reached_without_request(Time(1s)));
  REQUIRE(unit.lines.size() == 1);
  CHECK(unit.lines[0].unit == "u1");
  CHECK(unit.lines[0].status == importer::Status::Warning);
  CHECK(unit.lines[0].category == "logStatus");
  CHECK(unit.lines[0].message == "tank.level is 0.5 m, 50 %");
}

TEST_CASE("a message is the unit's, whatever it gives for its environment and on which thread") {
  const int mood = GENERATE(8, 9, 10, 11);
  Fmi2Fixture unit("fmi2_grumbler");
  unit.set_number("mood", mood);
  unit.start();
  CHECK(unit.step({}, Time(1s)).reached_without_request(Time(1s)));
  REQUIRE(unit.lines.size() == (mood == 9 ? 2 : 1));
  CHECK(unit.lines[0].unit == "u1");
  CHECK(unit.lines[0].category == (mood == 9 ? "" : "logStatus"));
  CHECK_THAT(unit.lines[0].message, StartsWith("it gets hot"));
  if (mood == 9) CHECK(unit.lines[1].message.empty());
}

TEST_CASE("the reason of a failure is in the error only, and logged where the call does not fail") {
  Fmi2Fixture unit("fmi2_grumbler");
  const bool fails = GENERATE(false, true);
  unit.set_number("mood", fails ? 13 : 12);
  unit.start();
  if (fails) {
    CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }),
               Contains("fmi2DoStep returned fmi2Error: it gets hot"));
    CHECK(unit.lines.empty());
  } else {
    CHECK(unit.step({}, Time(1s)).reached_without_request(Time(1s)));
    REQUIRE(unit.lines.size() == 1);
    CHECK(unit.lines[0].status == importer::Status::Error);
    CHECK(unit.lines[0].message == "fmi2DoStep: it gets hot");
  }
}

TEST_CASE("a message of a unit that is gone is lost, and no more", "[here]") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_relaxation"));
  Fmi2Fixture unit(fmu);
  const auto callbacks = unit.global<fmi2CallbackFunctions>("fmi2_callbacks");
  unit.free();
  callbacks.logger(callbacks.componentEnvironment, "u1", fmi2Warning, "logStatus", "%s", "late");
  callbacks.logger(nullptr, nullptr, fmi2Warning, nullptr, nullptr);
  CHECK(unit.lines.empty());
}

TEST_CASE("a unit gets functions for its memory, and stepFinished where it may need it", "[here]") {
  Fmi2Fixture unit(importer::Fmu::load(test_fmu("fmi2_relaxation")));
  const auto callbacks = unit.global<fmi2CallbackFunctions>("fmi2_callbacks");
  CHECK(callbacks.stepFinished == nullptr);
  void* const memory = callbacks.allocateMemory(3, 5);
  CHECK(std::string(static_cast<const char*>(memory), 15) == std::string(15, '\0'));
  callbacks.freeMemory(memory);
  Fmi2Fixture asynchronous(importer::Fmu::load(test_fmu("fmi2_sleeper")));
  CHECK(asynchronous.global<fmi2CallbackFunctions>("fmi2_callbacks").stepFinished != nullptr);
}

TEST_CASE("the relative tolerance is the one of the unit's default experiment", "[here]") {
  const auto tolerance = [](const char* name) {
    Fmi2Fixture unit(name);
    unit.start();
    return unit.global<double>("fmi2_tolerance");
  };
  CHECK(tolerance("fmi2_relaxation") == 1e-6);
  CHECK(tolerance("fmi2_grumbler") == 0);
}

TEST_CASE("a call that the unit does not allow is a failure") {
  Fmi2Fixture unit("fmi2_relaxation");
  unit.start();
  CHECK_THAT(run_error([&] { unit.set("k", 1); }),
             Contains("fmi2SetReal returned fmi2Error: fmi2SetReal is not allowed in mode 2"));
}

// Last, since nothing of this library can be called after it.
TEST_CASE("after fmi2Fatal nothing of the library is called", "[here]") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_grumbler"));
  Fmi2Fixture unit(fmu);
  unit.set_number("mood", 4);
  unit.start();
  CHECK_THAT(run_error([&] { unit.step({}, Time(1s)); }),
             Contains("fmi2DoStep returned fmi2Fatal: the heap is gone") &&
                 Contains("may have damaged this process"));
  const int* const living = static_cast<int*>(unit.symbol("fmi2_living_units"));
  unit.free();
  CHECK(*living == 1);
  CHECK_THAT(run_error([&] { Fmi2Fixture another(fmu); }),
             Contains("fmi2Instantiate cannot be called") && Contains("returned fmi2Fatal before"));
}
