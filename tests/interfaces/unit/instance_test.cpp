// The unit kit seen through its C entry points.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include <catch2/catch.hpp>

#include <stride/time.h>
#include <stride/unit/step.h>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"
#include "tests/interfaces/unit/saved_state.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

InstanceChoices early_return() {
  InstanceChoices choices;
  choices.early_return = true;
  return choices;
}

/// A copy of resources that a test may change.
class Resources {
 public:
  Resources() {
    std::string name = (std::filesystem::temp_directory_path() / "stride-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
    std::ofstream(path_ / "note.txt") << "a note\n";
  }
  ~Resources() { std::filesystem::remove_all(path_); }
  Resources(const Resources&) = delete;
  Resources& operator=(const Resources&) = delete;

  std::string path() const { return path_.string() + "/"; }
  void remove_note() const { std::filesystem::remove(path_ / "note.txt"); }

 private:
  std::filesystem::path path_;
};

}  // namespace

// ---- Instantiation ----

TEST_CASE("a wrong token is refused, with both tokens") {
  const UnitLibrary library(unit_library("types"));
  InstanceChoices choices;
  choices.token = "somebody else's";
  const UnitInstance unit(library, choices);
  CHECK(unit.handle == nullptr);
  CHECK_THAT(unit.last_message(), Contains("fmi3InstantiateCoSimulation: ") &&
                                      Contains("'somebody else's', this unit's is 'stride-"));
}

TEST_CASE("a constructor that throws makes no instance and no description") {
  const UnitLibrary library(unit_library("stateless"));
  CHECK_THROWS_WITH(library.describe("/absent/"), Contains("note.txt is missing"));
  std::string message;
  const fmi3Instance handle = library.InstantiateCoSimulation(
      "unit", "token", nullptr, false, false, true, false, nullptr, 0, &message,
      [](fmi3InstanceEnvironment to, fmi3Status status, fmi3String, fmi3String text) {
        *static_cast<std::string*>(to) = std::to_string(status) + text;
      },
      nullptr);
  CHECK(handle == nullptr);
  CHECK(message == "3fmi3InstantiateCoSimulation: its resource note.txt is missing");
}

TEST_CASE("the other interface types are refused with a reason") {
  const UnitLibrary library(unit_library("types"));
  std::string message;
  const fmi3LogMessageCallback log = [](fmi3InstanceEnvironment to, fmi3Status, fmi3String,
                                        fmi3String text) { *static_cast<std::string*>(to) = text; };
  CHECK(library.InstantiateModelExchange("unit", "token", nullptr, false, false, &message, log) ==
        nullptr);
  CHECK_THAT(message, Contains("belongs to Model Exchange"));
  CHECK(library.InstantiateScheduledExecution("unit", "token", nullptr, false, false, &message, log,
                                              nullptr, nullptr, nullptr) == nullptr);
  CHECK_THAT(message, Contains("belongs to Scheduled Execution"));
}

TEST_CASE("what a Co-Simulation unit does not have answers with an error and a message") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  const fmi3ValueReference r = 1;
  double x = 0;
  bool flag = false;
  std::size_t n = 0;
  void* const u = unit.handle;
  const std::pair<const char*, fmi3Status> answers[] = {
      {"fmi3EnterContinuousTimeMode", fmi.EnterContinuousTimeMode(u)},
      {"fmi3CompletedIntegratorStep", fmi.CompletedIntegratorStep(u, true, &flag, &flag)},
      {"fmi3SetTime", fmi.SetTime(u, 1)},
      {"fmi3SetContinuousStates", fmi.SetContinuousStates(u, &x, 1)},
      {"fmi3GetContinuousStateDerivatives", fmi.GetContinuousStateDerivatives(u, &x, 1)},
      {"fmi3GetEventIndicators", fmi.GetEventIndicators(u, &x, 1)},
      {"fmi3GetContinuousStates", fmi.GetContinuousStates(u, &x, 1)},
      {"fmi3GetNominalsOfContinuousStates", fmi.GetNominalsOfContinuousStates(u, &x, 1)},
      {"fmi3GetNumberOfEventIndicators", fmi.GetNumberOfEventIndicators(u, &n)},
      {"fmi3GetNumberOfContinuousStates", fmi.GetNumberOfContinuousStates(u, &n)},
      {"fmi3ActivateModelPartition", fmi.ActivateModelPartition(u, 1, 0)},
      {"fmi3GetDirectionalDerivative", fmi.GetDirectionalDerivative(u, &r, 1, &r, 1, &x, 1, &x, 1)},
      {"fmi3GetNumberOfVariableDependencies", fmi.GetNumberOfVariableDependencies(u, 1, &n)},
      {"fmi3EnterConfigurationMode", fmi.EnterConfigurationMode(u)},
      {"fmi3EvaluateDiscreteStates", fmi.EvaluateDiscreteStates(u)},
  };
  REQUIRE(unit.messages.size() == std::size(answers));
  for (std::size_t i = 0; i < std::size(answers); ++i) {
    CAPTURE(answers[i].first);
    CHECK(answers[i].second == fmi3Error);
    CHECK_THAT(unit.messages[i], Catch::Matchers::StartsWith(std::string(answers[i].first) + ": "));
  }
  CHECK(unit.initialize() == fmi3OK);
}

TEST_CASE("a NULL instance is an error, not a crash") {
  const UnitLibrary fmi(unit_library("types"));
  CHECK(fmi.Terminate(nullptr) == fmi3Error);
  CHECK(fmi.EnterContinuousTimeMode(nullptr) == fmi3Error);
  CHECK_NOTHROW(fmi.FreeInstance(nullptr));
}

// ---- Failures of the unit ----

TEST_CASE("an exception becomes fmi3Error, and the instance can be reset") {
  const UnitLibrary library(unit_library("thrower"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.step(0, 0.1) == fmi3Error);
  CHECK(unit.last_message() == "fmi3DoStep: the fuse has blown");
  CHECK(unit.step(0, 0.1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("not allowed in Terminated"));
  CHECK(library.Reset(unit.handle) == fmi3OK);
  REQUIRE(unit.set_real("throw_at", 1) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.integer("steps") == 1);
}

TEST_CASE("a reset whose constructor throws leaves an instance that can be read and freed") {
  const Resources resources;
  const UnitLibrary library(unit_library("stateless"));
  InstanceChoices choices;
  choices.resources = resources.path();
  UnitInstance unit(library, choices);
  REQUIRE(unit.initialize() == fmi3OK);
  const fmi3ValueReference note = unit.reference("note");
  resources.remove_note();
  CHECK(library.Reset(unit.handle) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("note.txt is missing"));
  fmi3String text = nullptr;
  CHECK(library.GetString(unit.handle, &note, 1, &text, 1) == fmi3Error);
  fmi3FMUState state = nullptr;
  CHECK(library.GetFMUState(unit.handle, &state) == fmi3Error);
}

TEST_CASE("what goes wrong while an error is reported does not cross") {
  SECTION("in a call that is not allowed") {
    const UnitLibrary library(unit_library("types"));
    UnitInstance unit(library);
    unit.log_throws = true;
    fmi3Status status = fmi3OK;
    CHECK_NOTHROW(status = library.EnterStepMode(unit.handle));
    CHECK(status == fmi3Error);
    CHECK_NOTHROW(status = library.EnterContinuousTimeMode(unit.handle));
    CHECK(status == fmi3Error);
  }
  SECTION("where the unit has failed") {
    const UnitLibrary library(unit_library("thrower"));
    UnitInstance unit(library);
    REQUIRE(unit.start_steps() == fmi3OK);
    unit.log_throws = true;
    fmi3Status status = fmi3OK;
    CHECK_NOTHROW(status = unit.step(0, 0.1));
    CHECK(status == fmi3Error);
    unit.log_throws = false;
    CHECK(unit.step(0, 0.1) == fmi3Error);
    CHECK_THAT(unit.last_message(), Contains("not allowed in Terminated"));
  }
  SECTION("where no instance is made") {
    const UnitLibrary library(unit_library("types"));
    const fmi3LogMessageCallback log = [](fmi3InstanceEnvironment, fmi3Status, fmi3String,
                                          fmi3String) { throw std::runtime_error("full"); };
    const auto instantiate = [&] {
      return library.InstantiateModelExchange("unit", "", nullptr, false, false, nullptr, log);
    };
    CHECK_NOTHROW(instantiate());
  }
}

TEST_CASE("a misuse does not end the unit") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(library.ExitInitializationMode(unit.handle) == fmi3Error);
  CHECK(unit.set_real("time", 1) == fmi3Error);
  CHECK(unit.step(0, 0.1) == fmi3OK);
}

// ---- Log ----

TEST_CASE("without logging only errors are logged") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_boolean("logs", true) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.messages.empty());
  CHECK(unit.step(7, 0.1) == fmi3Error);
  CHECK(unit.message_categories == std::vector<std::string>{"logStatusError"});
}

TEST_CASE("with logging all categories are logged but those that are switched off") {
  const UnitLibrary library(unit_library("stepper"));
  InstanceChoices choices;
  choices.logging = true;
  UnitInstance unit(library, choices);
  REQUIRE(unit.set_boolean("logs", true) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  auto log_of_step = [&, point = 0]() mutable {
    unit.message_categories.clear();
    REQUIRE(unit.step(point++, 1) == fmi3OK);
    return unit.message_categories;
  };
  using Categories = std::vector<std::string>;
  CHECK(log_of_step() == Categories{"logEvents", "logStatusWarning"});
  CHECK(unit.message_statuses == std::vector<fmi3Status>{fmi3OK, fmi3Warning});

  const fmi3String events[] = {"logEvents"};
  CHECK(library.SetDebugLogging(unit.handle, false, 1, events) == fmi3OK);
  CHECK(log_of_step() == Categories{"logStatusWarning"});
  CHECK(library.SetDebugLogging(unit.handle, false, 0, nullptr) == fmi3OK);
  CHECK(log_of_step().empty());
  CHECK(library.SetDebugLogging(unit.handle, true, 1, events) == fmi3OK);
  CHECK(log_of_step() == Categories{"logEvents"});
  CHECK(library.SetDebugLogging(unit.handle, true, 0, nullptr) == fmi3OK);
  CHECK(log_of_step().size() == 2);

  const fmi3String half_known[] = {"logEvents", "logGossip"};
  CHECK(library.SetDebugLogging(unit.handle, false, 2, half_known) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("there is no log category 'logGossip', only "
                                           "logStatusError, logStatusWarning, logEvents"));
  CHECK(log_of_step().size() == 2);
}

// ---- Values ----

TEST_CASE("a parameter outside of its range is refused when the initialization ends") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("gain", -0.5) == fmi3OK);
  CHECK(unit.initialize() == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("parameter 'gain' is -0.5, expected at least 0"));
}

TEST_CASE("an array is set and read as a whole, in row-major order") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  const fmi3ValueReference in = unit.reference("matrix");
  const fmi3ValueReference out = unit.reference("matrix.echo");
  REQUIRE(fmi.EnterInitializationMode(unit.handle, false, 0, 0, false, 0) == fmi3OK);
  double values[6] = {};
  REQUIRE(fmi.GetFloat64(unit.handle, &out, 1, values, 6) == fmi3OK);
  CHECK((values[0] == 1 && values[5] == 6));
  values[4] = 42;
  REQUIRE(fmi.SetFloat64(unit.handle, &in, 1, values, 6) == fmi3OK);
  double echo[6] = {};
  REQUIRE(fmi.GetFloat64(unit.handle, &out, 1, echo, 6) == fmi3OK);
  CHECK(std::memcmp(values, echo, sizeof values) == 0);
  CHECK(fmi.GetFloat64(unit.handle, &out, 1, echo, 5) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("nValues is too small"));
  double more[7] = {};
  CHECK(fmi.GetFloat64(unit.handle, &out, 1, more, 7) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("nValues is too large"));
}

TEST_CASE("an enumeration travels as Int64, and no other type does") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  const fmi3ValueReference in = unit.reference("colour");
  const fmi3ValueReference out = unit.reference("colour.echo");
  REQUIRE(fmi.EnterInitializationMode(unit.handle, false, 0, 0, false, 0) == fmi3OK);
  fmi3Int64 value = 4;
  REQUIRE(fmi.SetInt64(unit.handle, &in, 1, &value, 1) == fmi3OK);
  value = 0;
  REQUIRE(fmi.GetInt64(unit.handle, &out, 1, &value, 1) == fmi3OK);
  CHECK(value == 4);
  fmi3Int32 narrow = 0;
  CHECK(fmi.GetInt32(unit.handle, &out, 1, &narrow, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(),
             Contains("variable 'colour.echo' is of the type Enumeration, not Int32"));
}

TEST_CASE("references that lead nowhere and variables that cannot be set are named") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  const fmi3ValueReference nowhere = 9999;
  double value = 0;
  CHECK(fmi.GetFloat64(unit.handle, &nowhere, 1, &value, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("no variable with the value reference 9999"));
  CHECK(unit.set_real("float64.echo", 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("variable 'float64.echo' cannot be set"));
  CHECK(unit.set_real("time", 1) == fmi3Error);
}

TEST_CASE("a refused set changes nothing") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  REQUIRE(fmi.EnterInitializationMode(unit.handle, false, 0, 0, false, 0) == fmi3OK);
  REQUIRE(unit.set_real("float64", 1) == fmi3OK);
  const double values[] = {2, 3};
  const fmi3ValueReference half_wrong[] = {unit.reference("float64"), 9999};
  CHECK(fmi.SetFloat64(unit.handle, half_wrong, 2, values, 2) == fmi3Error);
  const fmi3ValueReference right[] = {unit.reference("float64")};
  CHECK(fmi.SetFloat64(unit.handle, right, 1, values, 2) == fmi3Error);
  CHECK(unit.real("float64") == 1);
  CHECK(unit.real("float64.echo") == 1);
}

namespace {

/// Sets the value alone, and reads it alone and along with its echo after a step.
template <class T, class Setter, class Getter>
void check_echo(UnitInstance& unit, Setter* set, Getter* get, const std::string& name, T value) {
  CAPTURE(name);
  const fmi3ValueReference both[] = {unit.reference(name), unit.reference(name + ".echo")};
  CHECK(set(unit.handle, both, 1, &value, 1) == fmi3OK);
  T alone{};
  CHECK(get(unit.handle, both, 1, &alone, 1) == fmi3OK);
  CHECK(alone == value);
  REQUIRE(unit.step(unit.real("time"), 0.5) == fmi3OK);
  T together[2] = {};
  CHECK(get(unit.handle, both, 2, together, 2) == fmi3OK);
  CHECK(get(unit.handle, both + 1, 1, &alone, 1) == fmi3OK);
  CHECK(together[0] == value);
  CHECK(together[1] == value);
  CHECK(alone == value);
}

/// The message of fmi3SetFloat64 or fmi3GetFloat64 for this variable and so many values.
std::string refusal(UnitInstance& unit, bool is_set, fmi3ValueReference variable,
                    std::size_t size) {
  double values[] = {1, 2};
  const fmi3Status status = is_set ? unit.fmi.SetFloat64(unit.handle, &variable, 1, values, size)
                                   : unit.fmi.GetFloat64(unit.handle, &variable, 1, values, size);
  CHECK(status == fmi3Error);
  return unit.last_message();
}

}  // namespace

TEST_CASE("in Step Mode a number is the same alone and with others") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  REQUIRE(unit.start_steps() == fmi3OK);
  check_echo<float>(unit, fmi.SetFloat32, fmi.GetFloat32, "float32", 0.5F);
  check_echo<double>(unit, fmi.SetFloat64, fmi.GetFloat64, "float64", 1e-300);
  check_echo<std::int8_t>(unit, fmi.SetInt8, fmi.GetInt8, "int8", -128);
  check_echo<std::uint8_t>(unit, fmi.SetUInt8, fmi.GetUInt8, "uint8", 255);
  check_echo<std::int16_t>(unit, fmi.SetInt16, fmi.GetInt16, "int16", -32768);
  check_echo<std::uint16_t>(unit, fmi.SetUInt16, fmi.GetUInt16, "uint16", 65535);
  check_echo<std::int32_t>(unit, fmi.SetInt32, fmi.GetInt32, "int32", -7);
  check_echo<std::uint32_t>(unit, fmi.SetUInt32, fmi.GetUInt32, "uint32", 7);
  check_echo<std::int64_t>(unit, fmi.SetInt64, fmi.GetInt64, "int64", -(1LL << 62));
  check_echo<std::uint64_t>(unit, fmi.SetUInt64, fmi.GetUInt64, "uint64", 1ULL << 63);
  check_echo<bool>(unit, fmi.SetBoolean, fmi.GetBoolean, "boolean", true);
  check_echo<std::int64_t>(unit, fmi.SetInt64, fmi.GetInt64, "colour", 4);
}

TEST_CASE("in Step Mode a refused call names its reason, and changes nothing") {
  const UnitLibrary fmi(unit_library("types"));
  UnitInstance unit(fmi);
  REQUIRE(unit.start_steps() == fmi3OK);
  for (const bool is_set : {false, true}) {
    CAPTURE(is_set);
    CHECK_THAT(refusal(unit, is_set, 9999, 1), Contains("no variable with the value reference"));
    CHECK_THAT(refusal(unit, is_set, unit.reference("float32"), 1),
               Contains("variable 'float32' is of the type Float32, not Float64"));
    CHECK_THAT(refusal(unit, is_set, unit.reference("colour"), 1),
               Contains("variable 'colour' is of the type Enumeration, not Float64"));
    CHECK_THAT(refusal(unit, is_set, unit.reference("float64"), 0), Contains("too small"));
    CHECK_THAT(refusal(unit, is_set, unit.reference("float64"), 2), Contains("too large"));
    CHECK_THAT(refusal(unit, is_set, unit.reference("matrix"), 1), Contains("too small"));
  }
  CHECK_THAT(refusal(unit, true, unit.reference("float64.echo"), 1),
             Contains("variable 'float64.echo' cannot be set in Step Mode"));
  CHECK(unit.real("float64") == 0);
  CHECK(unit.real("float64.echo") == 0);
}

TEST_CASE("the independent variable is the time") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps(0.5) == fmi3OK);
  CHECK(unit.real("time") == 0.5);
  REQUIRE(unit.step(0.5, 0.25) == fmi3OK);
  CHECK(unit.real("time") == 0.75);
}

// ---- Steps ----

TEST_CASE("a step must start at the unit's time, be positive, and end before the stop time") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.start_steps(0, 1) == fmi3OK);
  CHECK(unit.step(0.5, 0.1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("is at 0 s, but the step starts at 0.5 s"));
  CHECK(unit.step(0, 0) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("must be positive"));
  CHECK(unit.step(0, -0.1) == fmi3Error);
  CHECK(unit.step(0, 1.1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("behind the stop time 1 s"));
  CHECK(unit.step(0, std::numeric_limits<double>::quiet_NaN()) == fmi3Error);
  CHECK(unit.step(std::numeric_limits<double>::infinity(), 1) == fmi3Error);
  CHECK(unit.step(0, 1) == fmi3OK);
  CHECK(unit.last.reached == 1);
}

TEST_CASE("instants may be further apart than a step can be") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("largest_step", 1e15) == fmi3OK);
  REQUIRE(unit.start_steps(-9e14) == fmi3OK);
  CHECK(unit.step(9e14, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("is at -9e+14 s, but the step starts at 9e+14 s"));
  CHECK(unit.step(-9e14, 18e14) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("step size must be at most 1e+15 s"));
  CHECK(unit.step(-9e14, 9e14) == fmi3OK);
}

TEST_CASE("a rejected step is fmi3Discard with its reason and leaves the unit as it was") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("largest_step", 0.1) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.step(0, 0.2) == fmi3Discard);
  CHECK_THAT(unit.last_message(), Contains("fmi3DoStep: a step may be 0.1") && Contains("at most"));
  CHECK(unit.message_statuses == std::vector<fmi3Status>{fmi3Discard});
  CHECK(unit.integer("steps") == 0);
  CHECK(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.integer("steps") == 1);
}

TEST_CASE("a unit does in a step only what it has declared") {
  const UnitLibrary library(unit_library("liar"));
  UnitInstance unit(library, early_return());
  SECTION("it rejects") {
    REQUIRE(unit.set_boolean("rejects", true) == fmi3OK);
    REQUIRE(unit.start_steps() == fmi3OK);
    CHECK(unit.step(0, 0.1) == fmi3Error);
    CHECK_THAT(unit.last_message(), Contains("rejected the step (out of spite), but the unit did "
                                             "not declare may_reject"));
  }
  SECTION("it returns early") {
    REQUIRE(unit.set_real("early_after", 0.05) == fmi3OK);
    REQUIRE(unit.start_steps() == fmi3OK);
    CHECK(unit.step(0, 0.1) == fmi3Error);
    CHECK_THAT(unit.last_message(),
               Contains("returned early, but the unit did not declare early_return"));
  }
}

TEST_CASE("an early return stops at its instant and requests an event there") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library, early_return());
  REQUIRE(unit.set_real("early_at", 0.04) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.last.early);
  CHECK(unit.last.event);
  CHECK(unit.last.reached == 0.04);
  CHECK(unit.real("position") == Approx(0.08));
  REQUIRE(unit.step(0.04, 0.06) == fmi3OK);
  CHECK_FALSE(unit.last.early);
}

TEST_CASE("without leave to return early the step goes to its end") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("early_at", 0.04) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  CHECK_FALSE(unit.last.early);
  CHECK(unit.last.reached == 0.1);
}

TEST_CASE("late in a long simulation doubles are coarser than picoseconds, and steps still join") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library, early_return());
  const double start = 1e6;
  const double early = 1000000.0012345678;
  REQUIRE(unit.set_real("early_at", early) == fmi3OK);
  REQUIRE(unit.start_steps(start, start + 10) == fmi3OK);
  double point = start;
  for (int i = 0; i < 1000; ++i) {
    const double next = start + (i + 1) * 1e-2;
    REQUIRE(unit.step(point, next - point) == fmi3OK);
    point = unit.last.reached;
    if (unit.last.early) {
      CHECK(point == Approx(early).epsilon(1e-15));
      REQUIRE(unit.step(point, next - point) == fmi3OK);
      point = unit.last.reached;
    }
  }
  CHECK(unit.integer("steps") == 1001);
}

TEST_CASE("a step ends at its exact instant, by its duration or by the difference of its ends") {
  const UnitLibrary library(unit_library("stepper"));
  const bool by_difference = GENERATE(false, true);
  const stride::Time start(
      std::chrono::seconds(5000));  // the rounded sum would be another picosecond
  const stride::Duration size(1'100'000'000'001);
  UnitInstance unit(library);
  REQUIRE(unit.start_steps(stride::to_seconds(start)) == fmi3OK);
  for (stride::Time from = start; from < stride::Time(std::chrono::seconds(5100)); from += size) {
    const double begin = stride::to_seconds(from);
    const double end = stride::to_seconds(from + size);
    REQUIRE(unit.step(begin, by_difference ? end - begin : stride::to_seconds(size)) == fmi3OK);
    REQUIRE(unit.real("time") == end);
  }
}

TEST_CASE("a unit can end the simulation") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("end_at", 0.2) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  CHECK_FALSE(unit.last.terminate);
  REQUIRE(unit.step(0.1, 0.1) == fmi3OK);
  CHECK(unit.last.terminate);
}

// ---- Events and clocks ----

TEST_CASE("a tick in a step is seen in the Event Mode that follows, and then withdrawn") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("tick_at", 0.1) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.last.event);
  REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
  CHECK(unit.clock("clock"));
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.iterate);
  CHECK_FALSE(unit.clock("clock"));
}

TEST_CASE("a tick in Event Mode requests another iteration") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.set_clock("receive.clock", true) == fmi3OK);
  CHECK(unit.clock("receive.clock"));
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.iterate);
  CHECK(unit.clock("send.clock"));
  CHECK_FALSE(unit.clock("receive.clock"));
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.iterate);
  CHECK_FALSE(unit.clock("send.clock"));
}

TEST_CASE("clocks are set where they are inputs, clocked inputs in Event Mode only") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  REQUIRE(unit.initialize() == fmi3OK);
  CHECK(unit.set_clock("send.clock", true) == fmi3Error);
  const fmi3ValueReference frame = unit.reference("receive.frame");
  const fmi3Byte byte = 7;
  const fmi3Binary value = &byte;
  const std::size_t size = 1;
  CHECK(library.SetBinary(unit.handle, &frame, 1, &size, &value, 1) == fmi3OK);
  REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  CHECK(library.SetBinary(unit.handle, &frame, 1, &size, &value, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("'receive.frame' cannot be set in Step Mode"));
}

TEST_CASE("outputs follow inputs within Event Mode") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.set_real("float64", 3) == fmi3OK);
  REQUIRE(unit.set_real("gain", 2) == fmi3OK);
  CHECK(unit.real("gained") == 6);
}

TEST_CASE("the next event and another iteration are passed on") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("event_at", 0.1) == fmi3OK);
  REQUIRE(unit.initialize() == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.has_next_event);
  CHECK(unit.next_event == 0.1);
  REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.iterate);
  CHECK_FALSE(unit.has_next_event);
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.iterate);
}

TEST_CASE("an event that is announced for Time::max() never comes") {
  stride::Event event(stride::Time{}, stride::time_from_seconds(1));
  REQUIRE(event.next());
  event.next_event(stride::Time::max());
  CHECK_FALSE(event.next());
}

TEST_CASE("an announced event stays announced until it has come") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  const auto event_after_step = [&](double from, double to) {
    REQUIRE(library.EnterStepMode(unit.handle) == fmi3OK);
    REQUIRE(unit.step(from, to - from) == fmi3OK);
    REQUIRE(library.EnterEventMode(unit.handle) == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
  };
  REQUIRE(unit.set_real("event_at", 0.5) == fmi3OK);

  SECTION("at further iterations and earlier events it is told again") {
    REQUIRE(unit.initialize() == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    CHECK((unit.has_next_event && unit.next_event == 0.5));
    event_after_step(0, 0.25);
    CHECK((unit.has_next_event && unit.next_event == 0.5));
    event_after_step(0.25, 0.75);
    CHECK_FALSE(unit.has_next_event);
  }
  SECTION("the unit may withdraw it") {
    REQUIRE(unit.set_real("withdraw_at", 0.25) == fmi3OK);
    REQUIRE(unit.initialize() == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    event_after_step(0, 0.25);
    CHECK_FALSE(unit.has_next_event);
  }
  SECTION("a restored state has it, a reset unit has not") {
    REQUIRE(unit.initialize() == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    const SavedState saved(unit);
    event_after_step(0, 0.5);
    CHECK_FALSE(unit.has_next_event);
    REQUIRE(library.SetFMUState(unit.handle, saved.state) == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    CHECK((unit.has_next_event && unit.next_event == 0.5));
    REQUIRE(library.Reset(unit.handle) == fmi3OK);
    REQUIRE(unit.initialize() == fmi3OK);
    REQUIRE(unit.update() == fmi3OK);
    CHECK_FALSE(unit.has_next_event);
  }
}

// ---- Output derivatives ----

TEST_CASE("the first derivative of an output that has one") {
  const UnitLibrary library(unit_library("stepper"));
  CHECK(attribute(library.describe(), "<CoSimulation", "maxOutputDerivativeOrder") == "1");
  UnitInstance unit(library);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.1) == fmi3OK);
  const fmi3ValueReference position = unit.reference("position");
  fmi3Int32 order = 1;
  double rate = 0;
  REQUIRE(library.GetOutputDerivatives(unit.handle, &position, 1, &order, &rate, 1) == fmi3OK);
  CHECK(rate == 2);
  order = 2;
  CHECK(library.GetOutputDerivatives(unit.handle, &position, 1, &order, &rate, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("'position' has no derivative of order 2"));
}

TEST_CASE("a derivative that depends on inputs is right before the first step") {
  const UnitLibrary library(unit_library("minimal"));
  UnitInstance unit(library);
  REQUIRE(unit.set_real("u", 3) == fmi3OK);
  REQUIRE(unit.set_real("y", 1) == fmi3OK);
  REQUIRE(unit.set_real("time_constant", 0.5) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  const fmi3ValueReference y = unit.reference("y");
  const fmi3Int32 order = 1;
  double rate = 0;
  REQUIRE(library.GetOutputDerivatives(unit.handle, &y, 1, &order, &rate, 1) == fmi3OK);
  CHECK(rate == 4);  // (u - y) / time_constant
}

TEST_CASE("the error of a unit without a state names the missing capability") {
  const Resources resources;
  const UnitLibrary library(unit_library("stateless"));
  InstanceChoices choices;
  choices.resources = resources.path();
  UnitInstance unit(library, choices);
  CHECK(attribute(library.describe(resources.path()), "<CoSimulation", "canGetAndSetFMUState") ==
        "");
  fmi3FMUState state = nullptr;
  CHECK(library.GetFMUState(unit.handle, &state) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("cannot save its state"));
}
