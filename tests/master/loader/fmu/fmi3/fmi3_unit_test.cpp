#include "master/loader/fmu/fmi3/fmi3_unit.h"

#include <limits>

#include <dlfcn.h>

#include "master/loader/fmu/fmu.h"
#include "tests/at.h"
#include "tests/counting_allocator.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ValueBlock;
using core::ValueType;

namespace {

using stride::tests::at;

/// An instance of a unit made for tests, with access by name.
class Fmi3Fixture {
 public:
  explicit Fmi3Fixture(const std::string& unit, importer::InstanceOptions options = {})
      : fmu_(importer::Fmu::load(test_fmu(unit))),
        unit_(make_unit(fmu_, "unit", std::move(options))) {}

  core::Unit& operator*() { return *unit_; }
  core::Unit* operator->() { return unit_.get(); }

  core::ValueReference reference(const std::string& name) const {
    const auto place = fmu_->description()->find(name);
    REQUIRE(place);
    return fmu_->description()->variables[*place].reference;
  }
  ValueBlock get(const std::string& name) {
    const auto& variable = fmu_->description()->variables[*fmu_->description()->find(name)];
    ValueBlock block(variable.type, variable.size);
    unit_->get(std::span(&variable.reference, 1), block);
    return block;
  }
  void set(const std::string& name, const ValueBlock& block) {
    const core::ValueReference r = reference(name);
    unit_->set(std::span(&r, 1), block);
  }
  /// The value from its text, as a scenario gives it.
  void set(const std::string& name, const std::string& text) {
    set(name, core::parse(fmu_->description()->variables[*fmu_->description()->find(name)], text));
  }
  template <class T>
  T number(const std::string& name) {
    return get(name).template numbers<T>()[0];
  }
  void initialize(Time start = {}) {
    unit_->enter_initialization(start, std::nullopt);
    unit_->exit_initialization();
    unit_->update_discrete_states();
    unit_->enter_step_mode();
  }

 private:
  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
};

constexpr const char* kKeepsStates = "hasEventMode=\"true\" canGetAndSetFMUState=\"true\"";

/// A raw unit, whose instance's name chooses what it does.
struct Raw {
  explicit Raw(const std::string& name, importer::InstanceOptions options = {},
               const std::string& library = "raw",
               const std::string& flags = "hasEventMode=\"true\"")
      : fmu(importer::Fmu::load(make_raw_fmu(scratch, library, flags))),
        unit(make_unit(fmu, name, std::move(options))) {
    unit->enter_initialization({}, Time(1s));
    unit->exit_initialization();
    unit->enter_step_mode();
  }
  template <class T>
  T global(const char* name) const {
    void* handle = dlopen(fmu->load_library()->path().c_str(), RTLD_NOW | RTLD_NOLOAD);
    REQUIRE(handle != nullptr);
    const T value = *static_cast<T*>(dlsym(handle, name));
    dlclose(handle);
    return value;
  }
  Scratch scratch;
  std::shared_ptr<importer::Fmu> fmu;
  std::unique_ptr<core::Unit> unit;
};

template <class T>
void check_numbers(Fmi3Fixture& unit, ValueType type, const std::string& name,
                   const std::vector<T>& values) {
  for (const T value : values) {
    CAPTURE(name, value);
    ValueBlock block(type, 1);
    block.numbers<T>()[0] = value;
    unit.set(name, block);
    CHECK(unit.number<T>(name + ".echo") == value);
  }
}

template <class T>
std::vector<T> extremes() {
  return {std::numeric_limits<T>::lowest(), T{0}, T{1}, std::numeric_limits<T>::max()};
}

}  // namespace

TEST_CASE("numbers of every type go in and come out unchanged") {
  Fmi3Fixture unit("types");
  unit->enter_initialization({}, std::nullopt);
  check_numbers<float>(unit, ValueType::Float32, "float32", extremes<float>());
  check_numbers<double>(unit, ValueType::Float64, "float64", extremes<double>());
  check_numbers<std::int8_t>(unit, ValueType::Int8, "int8", extremes<std::int8_t>());
  check_numbers<std::uint8_t>(unit, ValueType::UInt8, "uint8", extremes<std::uint8_t>());
  check_numbers<std::int16_t>(unit, ValueType::Int16, "int16", extremes<std::int16_t>());
  check_numbers<std::uint16_t>(unit, ValueType::UInt16, "uint16", extremes<std::uint16_t>());
  check_numbers<std::int32_t>(unit, ValueType::Int32, "int32", extremes<std::int32_t>());
  check_numbers<std::uint32_t>(unit, ValueType::UInt32, "uint32", extremes<std::uint32_t>());
  check_numbers<std::int64_t>(unit, ValueType::Int64, "int64", extremes<std::int64_t>());
  check_numbers<std::uint64_t>(unit, ValueType::UInt64, "uint64", extremes<std::uint64_t>());
  check_numbers<bool>(unit, ValueType::Boolean, "boolean", {true, false});
  check_numbers<std::int64_t>(unit, ValueType::Enumeration, "colour", {4, 2, 1});
}

TEST_CASE("strings and binary values are copied") {
  Fmi3Fixture unit("types");
  unit->enter_initialization({}, std::nullopt);
  for (const std::string& text : {std::string("grüße"), std::string(), std::string(5000, 'x')}) {
    ValueBlock block(ValueType::String, 1);
    block.strings()[0] = text;
    unit.set("string", block);
    CHECK(unit.get("string.echo").strings()[0] == text);
  }
  for (const core::Binary& bytes : {core::Binary{0, 255, 0}, core::Binary{}, core::Binary{7}}) {
    ValueBlock block(ValueType::Binary, 1);
    block.binaries()[0] = bytes;
    unit.set("binary", block);
    CHECK(unit.get("binary.echo").binaries()[0] == bytes);
  }
}

TEST_CASE("arrays and several variables go in one call, element by element") {
  Fmi3Fixture unit("types");
  unit->enter_initialization({}, std::nullopt);
  const core::ValueReference inputs[] = {unit.reference("float64"), unit.reference("matrix")};
  const core::ValueReference outputs[] = {unit.reference("matrix.echo"),
                                          unit.reference("float64.echo")};
  ValueBlock values(ValueType::Float64, 7);
  for (std::size_t i = 0; i < 7; ++i) values.numbers<double>()[i] = static_cast<double>(i) + 0.5;
  unit->set(inputs, values);
  ValueBlock echo(ValueType::Float64, 7);
  unit->get(outputs, echo);
  const std::vector<double> read(echo.numbers<double>().begin(), echo.numbers<double>().end());
  CHECK(read == std::vector<double>{1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 0.5});

  ValueBlock words(ValueType::String, 2);
  words.strings()[0] = "one";
  words.strings()[1] = "two";
  unit.set("words", words);
  CHECK(unit.get("words.echo") == words);
  ValueBlock blobs(ValueType::Binary, 2);
  blobs.binaries()[1] = {1, 2, 3};
  unit.set("blobs", blobs);
  CHECK(unit.get("blobs.echo") == blobs);
  ValueBlock flags(ValueType::Boolean, 3);
  flags.numbers<bool>()[1] = true;
  unit.set("flags", flags);
  CHECK(unit.get("flags.echo") == flags);
}

TEST_CASE("a message travels with its clock through Event Mode") {
  Fmi3Fixture unit("types");
  unit.initialize();
  unit->enter_event_mode();
  ValueBlock active(ValueType::Clock, 1);
  active.numbers<bool>()[0] = true;
  ValueBlock frame(ValueType::Binary, 1);
  frame.binaries()[0] = {0xca, 0xfe};
  unit.set("receive.clock", active);
  unit.set("receive.frame", frame);
  CHECK_FALSE(unit.number<bool>("send.clock"));
  CHECK(unit->update_discrete_states().discrete_states_need_update);
  CHECK(unit.number<bool>("send.clock"));
  CHECK(unit.get("send.frame") == frame);
  CHECK_FALSE(unit->update_discrete_states().discrete_states_need_update);
  CHECK_FALSE(unit.number<bool>("send.clock"));
  unit->enter_step_mode();
}

TEST_CASE("the loop of values, steps and events does not allocate after its first round") {
  Fmi3Fixture unit("types");
  unit.initialize();
  const core::ValueReference reals[] = {unit.reference("float64"), unit.reference("matrix")};
  const core::ValueReference texts[] = {unit.reference("words")};
  const core::ValueReference frame[] = {unit.reference("receive.frame")};
  const core::ValueReference clock[] = {unit.reference("receive.clock")};
  const core::ValueReference echoes[] = {unit.reference("send.frame")};
  ValueBlock numbers(ValueType::Float64, 7);
  ValueBlock words(ValueType::String, 2);
  words.strings()[0] = std::string(100, 'x');
  ValueBlock bytes(ValueType::Binary, 1);
  bytes.binaries()[0] = core::Binary(200, 7);
  ValueBlock ticks(ValueType::Clock, 1);
  ticks.numbers<bool>()[0] = true;
  Time time{};
  const auto round = [&] {
    unit->set(reals, numbers);
    unit->set(texts, words);
    unit->step({time, time + Duration(1ms)});
    time += 1ms;
    unit->get(reals, numbers);
    unit->get(texts, words);
    unit->enter_event_mode();
    unit->set(clock, ticks);
    unit->set(frame, bytes);
    unit->update_discrete_states();
    unit->get(echoes, bytes);
    unit->enter_step_mode();
  };
  round();
  const long before = allocations;
  for (int i = 0; i < 100; ++i) round();
  CHECK(allocations - before == 0);
  CHECK(before > 0);
}

TEST_CASE("the times and sizes of steps are converted from exact ones, each by itself", "[here]") {
  Raw raw("unit");
  Time time{};
  for (int i = 0; i < 1000; ++i) {
    const Time next = time + 333'333'333ns + Duration(i);
    const core::StepResult result = raw.unit->step({time, next});
    CHECK(result.reached == next);
    CHECK_FALSE(result.early_return);
    const auto point = raw.global<double>("raw_point");
    CHECK(point == to_seconds(time));
    CHECK(raw.global<double>("raw_size") == to_seconds(next - time));
    time = next;
  }
}

TEST_CASE("a step whose sum is rounded to one above the stop time is shorter by that", "[here]") {
  Raw raw("unit");
  raw.unit->enter_initialization({}, Time(300ms));
  raw.unit->exit_initialization();
  for (const Time from : {Time(0ms), Time(100ms), Time(200ms)}) {
    raw.unit->step({from, from + 100ms});
    CHECK((raw.global<double>("raw_size") == 0.1) == (from < Time(200ms)));
  }
  CHECK(raw.global<double>("raw_point") + raw.global<double>("raw_size") == 0.3);
}

TEST_CASE("no state from before the current communication point is restored", "[here]") {
  Raw raw("unit");
  raw.unit->step({{}, Time(1ms)});
  CHECK(raw.global<bool>("raw_no_restore"));
}

TEST_CASE("fmi3Discard is a rejected step") {
  Raw raw("discard");
  const core::StepResult result = raw.unit->step({Time(1s), Time(2s)});
  CHECK(result.rejected);
  CHECK(result.reached == Time(1s));
  Fmi3Fixture stepper("stepper");
  stepper.set("largest_step", "0.01");
  stepper.initialize();
  CHECK(stepper->step({{}, Time(20ms)}).rejected);
  CHECK_FALSE(stepper->step({{}, Time(10ms)}).rejected);
  CHECK(stepper.number<std::int32_t>("steps") == 1);
}

TEST_CASE("the reason of a rejected step is kept until the next rejection") {
  CHECK(diagnostics(*Raw("unit").unit).rejection_reason().empty());
  Raw silent("discard");
  silent.unit->step({{}, Time(1s)});
  CHECK(diagnostics(*silent.unit).rejection_reason().empty());
  Raw coarse("coarse", {}, "raw_extended");
  CHECK(coarse.unit->step({{}, Time(1s)}).rejected);
  CHECK(diagnostics(*coarse.unit).rejection_reason() == "the mesh is too coarse");
  CHECK_FALSE(coarse.unit->step({{}, Time(500ms)}).rejected);
  CHECK(diagnostics(*coarse.unit).rejection_reason() == "the mesh is too coarse");
}

TEST_CASE("fmi3Discard is an error for every function but fmi3DoStep", "[here]") {
  Raw raw("sets", {}, "raw_extended", kKeepsStates);
  const core::ValueReference any = 1;
  const ValueBlock value(ValueType::Float64, 1);
  CHECK_THAT(run_error([&] { raw.unit->set(std::span(&any, 1), value); }),
             Contains("fmi3SetFloat64 returned fmi3Discard: the value is out of range"));
  CHECK_THAT(run_error([&] {
               raw.unit->step({{}, Time(1ms)});
             }),
             Contains("cannot be called, because fmi3SetFloat64 has failed before"));
  raw.unit.reset();
  CHECK(raw.global<int>("raw_living") == 0);
}

TEST_CASE("events, next events and the end of the run are passed on") {
  Fmi3Fixture unit("stepper", {.early_return_allowed = true});
  unit.set("event_at", "0.015");
  unit.set("early_at", "0.0123");
  unit.set("tick_at", "0.03");
  unit.set("end_at", "0.04");
  unit->enter_initialization({}, Time(1s));
  unit->exit_initialization();
  const core::EventResult first = unit->update_discrete_states();
  CHECK(first.next_event_time == Time(15ms));
  CHECK_FALSE(first.discrete_states_need_update);
  unit->enter_step_mode();
  const core::StepResult early = unit->step({{}, Time(15ms)});
  CHECK(early.early_return);
  CHECK(early.event_handling_needed);
  CHECK(early.reached == at(0.0123));
  CHECK_FALSE(unit->step({early.reached, Time(15ms)}).early_return);
  unit->enter_event_mode();
  const core::EventResult second = unit->update_discrete_states();
  CHECK(second.discrete_states_need_update);
  CHECK_FALSE(second.next_event_time);
  unit->enter_step_mode();
  CHECK(unit->step({Time(15ms), Time(30ms)}).event_handling_needed);
  CHECK(unit->step({Time(30ms), Time(40ms)}).terminate_simulation);
  unit->terminate();
}

TEST_CASE("an instant that no simulation reaches is no next event") {
  Raw raw("unit");
  raw.unit->enter_event_mode();
  CHECK_FALSE(raw.unit->update_discrete_states().next_event_time);
}

TEST_CASE("a small drift of a unit's own time is tolerated") {
  Raw raw("drifts");
  CHECK(raw.unit->step({Time(1s), Time(2s)}).reached == Time(2s));
}

TEST_CASE("a unit's own time may differ from the end of the step, which the log says once") {
  std::vector<std::string> logged;
  const importer::LogSink log = [&](const std::string& unit, importer::Status status,
                                    const std::string&, const std::string& message) {
    CHECK(unit == "lies");
    CHECK(status == importer::Status::Warning);
    logged.push_back(message);
  };
  Raw fixed("lies", {.log = log}, "raw", "hasEventMode=\"true\" fixedInternalStepSize=\"0.5\"");
  const core::StepResult result = fixed.unit->step({{}, Time(1s)});
  CHECK(result.reached == Time(1s));
  CHECK_FALSE(result.early_return);
  CHECK(fixed.unit->step({Time(1s), Time(2s)}).reached == Time(2s));
  REQUIRE(logged.size() == 1);
  CHECK_THAT(logged[0], Contains("the step to 1 s ended at the unit's own time 0.5 s") &&
                            Contains("its fixedInternalStepSize is 0.5 s"));

  Raw plain("lies", {.log = log});
  plain.unit->step({{}, Time(1s)});
  REQUIRE(logged.size() == 2);
  CHECK_THAT(logged[1], !Contains("fixedInternalStepSize"));
  CHECK(Raw("lies").unit->step({{}, Time(1s)}).reached == Time(1s));
}

TEST_CASE("a time of a unit's own that is not a time is an error") {
  Raw endless("endless", {}, "raw_extended");
  CHECK_THAT(run_error([&] {
               endless.unit->step({{}, Time(1s)});
             }),
             Contains("lastSuccessfulTime is inf"));
}

TEST_CASE("a unit that returns early without leave is an error") {
  Raw eager("early");
  CHECK_THAT(run_error([&] { eager.unit->step({{}, Time(1s)}); }), Contains("was not allowed"));
  Raw allowed("early", {.early_return_allowed = true});
  CHECK(allowed.unit->step({{}, Time(1s)}).reached == Time(500ms));
}

TEST_CASE("fmi3Error is an error with function, time and the unit's own words") {
  Fmi3Fixture unit("thrower", {.where = {"system.ssd", 4}});
  unit.set("throw_at", "0.002");
  unit.initialize();
  unit->step({{}, Time(1ms)});
  const std::string error = run_error([&] { unit->step({Time(1ms), Time(2ms)}); });
  CHECK(error ==
        "system.ssd:4: unit 'unit', at 0.001 s: fmi3DoStep returned fmi3Error: the fuse has blown");
  CHECK_THAT(run_error([&] {
               unit->step({Time(2ms), Time(3ms)});
             }),
             Contains("cannot be called, because fmi3DoStep has failed before"));
  CHECK_NOTHROW(unit->terminate());
}

TEST_CASE("an exception that is not a std::exception does not cross the unit's border") {
  Fmi3Fixture unit("thrower");
  unit.set("odd", "true");
  unit.initialize();
  CHECK_THAT(run_error([&] {
               unit->step({{}, Time(1ms)});
             }),
             Contains("fmi3DoStep returned fmi3Error: the unit threw something"));
}

TEST_CASE("a silent error is an error") {
  Raw raw("error");
  CHECK_THAT(run_error([&] {
               raw.unit->step({{}, Time(1ms)});
             }),
             Contains("fmi3DoStep returned fmi3Error: the unit gives no reason"));
}

TEST_CASE("a status that FMI 3.0 does not have is an error that contains it", "[here]") {
  const auto [name, status] =
      GENERATE(table<std::string, std::string>({{"pending", "5"}, {"unheard", "77"}}));
  Raw raw(name);
  CHECK_THAT(run_error([&] {
               raw.unit->step({{}, Time(1ms)});
             }),
             Contains("fmi3DoStep returned " + status + ", a status that FMI 3.0 does not have"));
  raw.unit.reset();
  CHECK(raw.global<int>("raw_living") == 0);
}

TEST_CASE("after fmi3Error the instance is freed, after fmi3Fatal it is not touched again",
          "[here]") {
  Raw error("error");
  CHECK_THROWS_AS(error.unit->step({{}, Time(1ms)}), core::Error);
  CHECK(error.global<int>("raw_living") == 1);
  error.unit.reset();
  CHECK(error.global<int>("raw_living") == 0);

  Raw fatal("fatal");
  CHECK_THAT(run_error([&] {
               fatal.unit->step({{}, Time(1ms)});
             }),
             Contains("returned fmi3Fatal: the heap is gone") && Contains("hint: "));
  CHECK_NOTHROW(fatal.unit->terminate());
  fatal.unit.reset();
  CHECK(fatal.global<int>("raw_living") == 1);
}

TEST_CASE("after fmi3Fatal no other instance of the FMU is touched, and its library stays",
          "[here]") {
  Scratch scratch;
  auto fmu = importer::Fmu::load(make_raw_fmu(scratch, "raw"));
  const std::string path = fmu->load_library()->path();
  const auto again = importer::Fmu::load(scratch / "raw");  // the same library by another object
  auto fatal = make_unit(fmu, "fatal");
  auto same = make_unit(fmu, "same");
  auto other = make_unit(again, "other");
  CHECK_THROWS_AS(fatal->step({{}, Time(1ms)}), core::Error);
  for (core::Unit* unit : {same.get(), other.get()}) {
    CHECK_THAT(run_error([&] {
                 unit->step({{}, Time(1ms)});
               }),
               Contains("fmi3DoStep cannot be called, because an instance of the same FMU has "
                        "returned fmi3Fatal before"));
    CHECK_THROWS_AS(unit->step({{}, Time(1ms)}), core::ConsequentError);
    CHECK_NOTHROW(unit->terminate());
  }
  CHECK_THAT(run_error([&] { make_unit(fmu, "another"); }),
             Contains("unit 'another': fmi3InstantiateCoSimulation cannot be called"));
  fatal.reset();
  same.reset();
  other.reset();
  fmu.reset();
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD);
  REQUIRE(handle != nullptr);
  CHECK(*static_cast<int*>(dlsym(handle, "raw_living")) == 3);
  dlclose(handle);
}

TEST_CASE("a library whose instances do well is unloaded with the last of them", "[here]") {
  Scratch scratch;
  auto fmu = importer::Fmu::load(make_raw_fmu(scratch, "raw"));
  const std::string path = fmu->load_library()->path();
  auto unit = make_unit(fmu, "unit");
  fmu.reset();
  unit.reset();
  CHECK(dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD) == nullptr);
}

TEST_CASE("a saved state comes back any number of times, and is replaced by the next one") {
  Fmi3Fixture unit("stepper");
  unit.initialize();
  unit->step({{}, Time(10ms)});
  state(*unit).save_state();
  for (int i = 0; i < 3; ++i) {
    unit->step({Time(10ms), Time(30ms)});
    CHECK(unit.number<std::int32_t>("steps") == 2);
    CHECK(unit.number<double>("position") == Approx(0.06));
    state(*unit).restore_state();
    CHECK(unit.number<std::int32_t>("steps") == 1);
    CHECK(unit.number<double>("position") == Approx(0.02));
  }
  unit->step({Time(10ms), Time(20ms)});
  state(*unit).save_state();
  unit->step({Time(20ms), Time(30ms)});
  state(*unit).restore_state();
  CHECK(unit.number<std::int32_t>("steps") == 2);
  unit->step({Time(20ms), Time(30ms)});
  unit->terminate();
}

TEST_CASE("after a restore errors have the restored time") {
  Raw raw("sets", {}, "raw_extended", kKeepsStates);
  raw.unit->step({{}, Time(1s)});
  state(*raw.unit).save_state();
  raw.unit->step({Time(1s), Time(2s)});
  state(*raw.unit).restore_state();
  const core::ValueReference any = 1;
  const ValueBlock value(ValueType::Float64, 1);
  CHECK_THAT(run_error([&] { raw.unit->set(std::span(&any, 1), value); }),
             Contains("unit 'sets', at 1 s: "));
}

TEST_CASE("the memory of a state is used again, and freed with the instance", "[here]") {
  Raw raw("unit", {}, "raw_extended", kKeepsStates);
  for (int i = 0; i < 5; ++i) state(*raw.unit).save_state();
  CHECK(raw.global<int>("raw_states_made") == 1);
  CHECK(raw.global<int>("raw_states_living") == 1);
  raw.unit.reset();
  CHECK(raw.global<int>("raw_states_living") == 0);

  Raw fatal("fatal", {}, "raw_extended", kKeepsStates);
  state(*fatal.unit).save_state();
  CHECK_THROWS_AS(fatal.unit->step({{}, Time(1ms)}), core::Error);
  fatal.unit.reset();
  CHECK(fatal.global<int>("raw_states_living") == 1);
}

TEST_CASE("a state that cannot be saved or restored is an error") {
  Raw without("unit", {}, "raw", kKeepsStates);
  state(*without.unit).save_state();  // which logs a warning
  CHECK_THAT(run_error([&] { state(*without.unit).restore_state(); }),
             Contains("could not be saved: its library does not export fmi3GetFMUState") &&
                 Contains("<stride:StateSaving components=\"unit\" allowed=\"false\"/>"));
  Fmi3Fixture stateless("stateless");
  CHECK(stateless->capability<core::StateSaving>() == nullptr);
  Raw early("unit", {}, "raw_extended", kKeepsStates);
  CHECK_THAT(run_error([&] { state(*early.unit).restore_state(); }),
             Contains("no state of it has been"));
  Raw forgetful("forgetful", {}, "raw_extended", kKeepsStates);
  state(*forgetful.unit).save_state();
  CHECK_THAT(run_error([&] { state(*forgetful.unit).restore_state(); }),
             Contains("fmi3SetFMUState returned fmi3Discard"));
}

TEST_CASE("a warning is logged and the step is accepted") {
  std::vector<std::string> logged;
  Raw raw("warning", {.log = [&](const std::string& unit, importer::Status status,
                                 const std::string& category, const std::string& message) {
            logged.push_back(unit + "/" + std::to_string(static_cast<int>(status)) + "/" +
                             category + "/" + message);
          }});
  CHECK(raw.unit->step({{}, Time(1ms)}).reached == Time(1ms));
  CHECK(logged == std::vector<std::string>{"warning/1/logStatusWarning/it gets hot"});
}

TEST_CASE("what a unit logs in steps that it repeats is not logged again") {
  int logged = 0;
  Raw raw("warning", {.log = [&](auto&&...) { ++logged; }}, "raw", "canGetAndSetFMUState=\"true\"");
  diagnostics(*raw.unit).set_repeating(true);
  raw.unit->step({{}, Time(1ms)});
  CHECK(logged == 0);
  diagnostics(*raw.unit).set_repeating(false);
  raw.unit->step({Time(1ms), Time(2ms)});
  CHECK(logged == 1);
}

TEST_CASE("an exception of a log sink has no effect") {
  Raw raw("warning", {.log = [](auto&&...) { throw std::runtime_error("the disk is full"); }});
  CHECK_NOTHROW(raw.unit->step({{}, Time(1ms)}));
}

TEST_CASE("a unit that refuses to be instantiated gives its reason") {
  CHECK_THAT(run_error([] { Raw("refuses"); }),
             Contains("unit 'refuses': fmi3InstantiateCoSimulation failed: there is no licence"));
}

TEST_CASE("a wrong value is refused by the kit, with the variable's name") {
  Fmi3Fixture unit("types");
  unit.set("gain", "11");
  unit->enter_initialization({}, std::nullopt);
  CHECK_THAT(run_error([&] { unit->exit_initialization(); }),
             Contains("fmi3ExitInitializationMode returned fmi3Error: parameter 'gain' is 11, "
                      "expected at most 10"));
}

TEST_CASE("binary values at NULL are an error, not a crash") {
  Raw raw("unit");
  const core::ValueReference any = 1;
  ValueBlock block(ValueType::Binary, 1);
  CHECK_THAT(run_error([&] { raw.unit->get(std::span(&any, 1), block); }),
             Contains("3 bytes at the address NULL"));
}

TEST_CASE("a unit without resources gets none") {
  Raw raw("unit");
  const core::ValueReference any = 1;
  ValueBlock path(ValueType::String, 1);
  raw.unit->get(std::span(&any, 1), path);
  CHECK(path.strings()[0] == "NULL");

  fs::create_directory(raw.scratch / "raw/resources");
  const auto unit = make_unit(importer::Fmu::load(raw.scratch / "raw"), "unit");
  unit->get(std::span(&any, 1), path);
  CHECK(path.strings()[0] == (raw.scratch / "raw/resources").string() + "/");
}

TEST_CASE("the next event is not before the time that the unit gave") {
  Raw raw("thirds");
  raw.unit->enter_event_mode();
  const auto next = raw.unit->update_discrete_states().next_event_time;
  REQUIRE(next);
  CHECK(to_seconds(*next) >= 1.0 / 3);
  CHECK(to_seconds(*next - Duration(1)) < 1.0 / 3);
}

TEST_CASE("picoseconds that are the same double are one instant to the unit") {
  const Time point = at(8192.001);
  Raw raw("fine");
  Time from = point;
  while (to_seconds(from + Duration(1)) != to_seconds(from)) from += Duration(1);
  const core::StepResult result = raw.unit->step({from, from + Duration(1)});
  CHECK(result.reached == from + Duration(1));
}

TEST_CASE("an early return at the end of the step is a complete step") {
  Raw raw("arrives", {.early_return_allowed = true});
  Time end = at(8192.001);
  while (time_from_seconds(to_seconds(end)) == end) end += Duration(1);
  CHECK(raw.unit->step({end - 1ms, end}).reached == end);
}

TEST_CASE("a request of Event Mode by a unit without it is an error") {
  Raw raw("needs", {}, "raw", "");
  CHECK_THROWS_WITH(raw.unit->step({Time(), Time(1ms)}),
                    Contains("eventHandlingNeeded") && Contains("hasEventMode"));
}

TEST_CASE("structural parameters are set in Configuration Mode, before all others") {
  const auto fmu = importer::Fmu::load(test_fmu("resizable"));
  const auto unit = make_unit(fmu, "unit");
  const auto reference = [&](const char* name) {
    return fmu->description()->variables[*fmu->description()->find(name)].reference;
  };
  const std::vector n{reference("n")}, gain{reference("gain")}, u{reference("u")},
      y{reference("y")};
  core::ValueBlock three(core::ValueType::UInt64, 1);
  three.numbers<std::uint64_t>()[0] = 3;
  core::ValueBlock values(core::ValueType::Float64, 3);
  std::ranges::copy(std::vector{2.0, 3.0, 4.0}, values.numbers<double>().begin());
  configuration(*unit).enter_configuration_mode();
  unit->set(n, three);
  configuration(*unit).exit_configuration_mode();
  unit->set(gain, values);
  unit->enter_initialization({}, {});
  unit->set(u, values);
  core::ValueBlock result(core::ValueType::Float64, 3);
  unit->get(y, result);
  CHECK(std::ranges::equal(result.numbers<double>(), std::vector{4.0, 9.0, 16.0}));

  std::vector<double> sensitivity(3);
  derivatives(*unit).get_directional_derivative(y, u, std::vector{1.0, 0.5, -1.0}, sensitivity);
  CHECK(sensitivity == std::vector{2.0, 1.5, -4.0});
}

TEST_CASE("what a library does not export for structure and derivatives is named") {
  const Scratch scratch;
  const fs::path folder = make_raw_fmu(scratch, "raw");
  scratch.write("raw/modelDescription.xml",
                description_text("raw", "providesDirectionalDerivatives=\"true\"",
                                 "<UInt64 name=\"n\" valueReference=\"1\" start=\"1\" "
                                 "causality=\"structuralParameter\" variability=\"fixed\"/>\n"));
  const auto fmu = importer::Fmu::load(folder);
  const auto unit = make_unit(fmu, "unit");
  CHECK_THAT(run_error([&] { configuration(*unit).enter_configuration_mode(); }),
             Contains("does not export fmi3EnterConfigurationMode"));
  CHECK_THAT(run_error([&] { derivatives(*unit).get_directional_derivative({}, {}, {}, {}); }),
             Contains("does not export fmi3GetDirectionalDerivative"));
}

// ---- Messages in words ----

TEST_CASE("a unit gives the text of a message") {
  Fmi3Fixture unit("types");
  const core::ValueReference frame = unit.reference("receive.frame");
  CHECK(texts(*unit).describe_message(frame, {0x26, 0x27}) == "2 bytes in receive.frame");
  unit.initialize();
  CHECK(texts(*unit).describe_message(frame, core::Binary(1'000'000, 0x26)) ==
        "1000000 bytes in receive.frame");
  CHECK(texts(*unit).describe_message(frame, {}) == "");
  CHECK(texts(*unit).describe_message(frame, {0}) == "");
  const std::string longest = texts(*unit).describe_message(frame, {2});
  CHECK(longest.size() == importer::Fmi3Unit::kLongestDescription);
  CHECK(longest.substr(longest.size() - 2) == "é");
  CHECK_THAT(run_error([&] { texts(*unit).describe_message(unit.reference("float64"), {1}); }),
             Contains("strideDescribeMessage returned fmi3Error: ") && Contains("not Binary"));
}

TEST_CASE("a unit of another tool gives the text of a message") {
  const auto say = [](const char* behaviour, const core::Binary& value) {
    return texts(*Raw(behaviour, {}, "raw_extended").unit).describe_message(7, value);
  };
  CHECK(say("plain", {1, 2}) == "7: 2 bytes, somewhere");
  CHECK(say("plain", {}) == "7: 0 bytes, somewhere");
  CHECK(say("mute", {1}) == "");
  CHECK(Raw("plain").unit->capability<core::MessageText>() == nullptr);
  CHECK_THAT(
      run_error([&] { say("babbles", {1}); }),
      Contains("strideDescribeMessage reports that it has written 1025 bytes where 1024 fit"));
  CHECK_THAT(run_error([&] { say("refuses_it", {1}); }),
             Contains("strideDescribeMessage returned fmi3Error: no comment"));
}

TEST_CASE("the log of a missing message text is not the reason of a later failure") {
  Raw raw("mute", {}, "raw_extended");
  CHECK(texts(*raw.unit).describe_message(7, {1}) == "");
  raw.unit->step({Time(0s), Time(500ms)});
}
