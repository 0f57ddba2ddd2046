// Which function may be called when (FMI 3.0, 2.3 and 4.2), through the C entry points: every
// function in every state, against a table written down here.
#include <functional>
#include <map>
#include <string>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// The states, by their letters in the table below.
constexpr char kStates[] = {'I', 'N', 'E', 'S', 'T'};

std::string state_name(char state) {
  const std::map<char, std::string> names = {{'I', "Instantiated"},
                                             {'N', "Initialization Mode"},
                                             {'E', "Event Mode"},
                                             {'S', "Step Mode"},
                                             {'T', "Terminated"}};
  return names.at(state);
}

void bring_to(UnitInstance& unit, char state) {
  if (state == 'I') return;
  REQUIRE(unit.fmi.EnterInitializationMode(unit.handle, false, 0, 0, false, 0) == fmi3OK);
  if (state == 'N') return;
  REQUIRE(unit.fmi.ExitInitializationMode(unit.handle) == fmi3OK);
  if (state == 'E') return;
  if (state == 'S') {
    REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);
    return;
  }
  REQUIRE(unit.fmi.Terminate(unit.handle) == fmi3OK);
}

struct Call {
  const char* name;
  const char* legal_states;
  std::function<fmi3Status(UnitInstance&)> run;
};

/// Getter and setter of a type with the unit's variable of that type.
template <class T, class Getter, class Setter>
void add_access(std::vector<Call>& calls, const char* getter_name, Getter UnitLibrary::*getter,
                const char* setter_name, Setter UnitLibrary::*setter, const char* variable) {
  calls.push_back({getter_name, "INEST", [=](UnitInstance& unit) {
                     const fmi3ValueReference r = unit.reference(variable);
                     T value{};
                     return (unit.fmi.*getter)(unit.handle, &r, 1, &value, 1);
                   }});
  calls.push_back({setter_name, "INES", [=](UnitInstance& unit) {
                     const fmi3ValueReference r = unit.reference(variable);
                     const T value{};
                     return (unit.fmi.*setter)(unit.handle, &r, 1, &value, 1);
                   }});
}

fmi3Status save_and(UnitInstance& unit, const std::function<fmi3Status(fmi3FMUState)>& body) {
  fmi3FMUState state = nullptr;
  if (unit.fmi.GetFMUState(unit.handle, &state) != fmi3OK) return fmi3Error;
  const fmi3Status status = body(state);
  return unit.fmi.FreeFMUState(unit.handle, &state) == fmi3OK ? status : fmi3Error;
}

std::vector<Call> life_cycle() {
  return {
      {"fmi3SetDebugLogging", "INEST",
       [](UnitInstance& u) { return u.fmi.SetDebugLogging(u.handle, false, 0, nullptr); }},
      {"fmi3Reset", "INEST", [](UnitInstance& u) { return u.fmi.Reset(u.handle); }},
      {"fmi3EnterInitializationMode", "I",
       [](UnitInstance& u) {
         return u.fmi.EnterInitializationMode(u.handle, false, 0, 0, false, 0);
       }},
      {"fmi3ExitInitializationMode", "N",
       [](UnitInstance& u) { return u.fmi.ExitInitializationMode(u.handle); }},
      {"fmi3EnterEventMode", "S", [](UnitInstance& u) { return u.fmi.EnterEventMode(u.handle); }},
      {"fmi3EnterStepMode", "E", [](UnitInstance& u) { return u.fmi.EnterStepMode(u.handle); }},
      {"fmi3UpdateDiscreteStates", "E", [](UnitInstance& u) { return u.update(); }},
      {"fmi3DoStep", "S", [](UnitInstance& u) { return u.step(0, 0.125); }},
      {"fmi3Terminate", "ES", [](UnitInstance& u) { return u.fmi.Terminate(u.handle); }},
  };
}

std::vector<Call> values() {
  std::vector<Call> calls;
#define ADD(T, variable)                                                       \
  add_access<fmi3##T>(calls, "fmi3Get" #T, &UnitLibrary::Get##T, "fmi3Set" #T, \
                      &UnitLibrary::Set##T, variable);
  ADD(Float32, "float32")
  ADD(Float64, "float64")
  ADD(Int8, "int8")
  ADD(UInt8, "uint8")
  ADD(Int16, "int16")
  ADD(UInt16, "uint16")
  ADD(Int32, "int32")
  ADD(UInt32, "uint32")
  ADD(Int64, "int64")
  ADD(UInt64, "uint64")
  ADD(Boolean, "boolean")
  ADD(String, "string")
#undef ADD
  calls.push_back({"fmi3GetBinary", "INEST", [](UnitInstance& u) {
                     const fmi3ValueReference r = u.reference("binary");
                     std::size_t size = 0;
                     fmi3Binary value = nullptr;
                     return u.fmi.GetBinary(u.handle, &r, 1, &size, &value, 1);
                   }});
  calls.push_back({"fmi3SetBinary", "INES", [](UnitInstance& u) {
                     const fmi3ValueReference r = u.reference("binary");
                     const std::size_t size = 0;
                     const fmi3Binary value = nullptr;
                     return u.fmi.SetBinary(u.handle, &r, 1, &size, &value, 1);
                   }});
  calls.push_back({"fmi3GetClock", "NE", [](UnitInstance& u) {
                     const fmi3ValueReference r = u.reference("send.clock");
                     bool value = false;
                     return u.fmi.GetClock(u.handle, &r, 1, &value);
                   }});
  calls.push_back(
      {"fmi3SetClock", "E", [](UnitInstance& u) { return u.set_clock("receive.clock", true); }});
  return calls;
}

std::vector<Call> states() {
  return {
      {"fmi3GetFMUState and fmi3FreeFMUState", "INEST",
       [](UnitInstance& u) { return save_and(u, [](fmi3FMUState) { return fmi3OK; }); }},
      {"fmi3SetFMUState", "INEST",
       [](UnitInstance& u) {
         return save_and(u, [&](fmi3FMUState s) { return u.fmi.SetFMUState(u.handle, s); });
       }},
      {"fmi3SerializedFMUStateSize", "INEST",
       [](UnitInstance& u) {
         return save_and(u, [&](fmi3FMUState s) {
           std::size_t size = 0;
           return u.fmi.SerializedFMUStateSize(u.handle, s, &size);
         });
       }},
  };
}

std::vector<Call> clocks() {
  const auto reference = [](UnitInstance& u) { return u.reference("tunable"); };
  return {
      {"fmi3GetIntervalDecimal", "NE",
       [=](UnitInstance& u) {
         const fmi3ValueReference r = reference(u);
         double seconds = 0;
         fmi3IntervalQualifier qualifier{};
         return u.fmi.GetIntervalDecimal(u.handle, &r, 1, &seconds, &qualifier);
       }},
      {"fmi3GetIntervalFraction", "NE",
       [=](UnitInstance& u) {
         const fmi3ValueReference r = reference(u);
         fmi3UInt64 counter = 0;
         fmi3UInt64 resolution = 0;
         fmi3IntervalQualifier qualifier{};
         return u.fmi.GetIntervalFraction(u.handle, &r, 1, &counter, &resolution, &qualifier);
       }},
      {"fmi3GetShiftDecimal", "N",
       [=](UnitInstance& u) {
         const fmi3ValueReference r = reference(u);
         double seconds = 0;
         return u.fmi.GetShiftDecimal(u.handle, &r, 1, &seconds);
       }},
      {"fmi3GetShiftFraction", "N",
       [=](UnitInstance& u) {
         const fmi3ValueReference r = reference(u);
         fmi3UInt64 counter = 0;
         fmi3UInt64 resolution = 0;
         return u.fmi.GetShiftFraction(u.handle, &r, 1, &counter, &resolution);
       }},
      {"fmi3SetIntervalDecimal", "NE",
       [=](UnitInstance& u) { return u.set_interval("tunable", 0.25); }},
      {"fmi3SetIntervalFraction", "NE",
       [=](UnitInstance& u) {
         const fmi3ValueReference r = reference(u);
         const fmi3UInt64 counter = 1;
         const fmi3UInt64 resolution = 4;
         return u.fmi.SetIntervalFraction(u.handle, &r, 1, &counter, &resolution);
       }},
      {"fmi3SetShiftDecimal", "N", [=](UnitInstance& u) { return u.set_shift("tunable", 0.25); }},
      {"fmi3SetShiftFraction", "N",
       [=](UnitInstance& u) {
         const fmi3ValueReference r = reference(u);
         const fmi3UInt64 counter = 1;
         const fmi3UInt64 resolution = 4;
         return u.fmi.SetShiftFraction(u.handle, &r, 1, &counter, &resolution);
       }},
  };
}

std::vector<Call> idle_skipping() {
  return {
      {"strideEnableIdleSkipping", "I",
       [](UnitInstance& u) { return u.fmi.EnableIdleSkipping(u.handle, 1); }},
      {"strideSetIdleTolerances", "I", [](UnitInstance& u) { return u.set_tolerance("level", 1); }},
      {"strideGetIdlePromise", "S",
       [](UnitInstance& u) {
         double until = 0;
         return u.fmi.GetIdlePromise(u.handle, &until);
       }},
  };
}

std::vector<Call> messages_in_words() {
  return {{"strideDescribeMessage", "INEST", [](UnitInstance& u) {
             const fmi3Byte byte = 0x26;
             char text[100];
             std::size_t size = 0;
             return u.fmi.DescribeMessage(u.handle, u.reference("binary"), &byte, 1, text,
                                          sizeof text, &size);
           }}};
}

/// Calls each function in each state, each time on a fresh instance.
void check(const std::vector<Call>& calls, const std::string& file = unit_library("types")) {
  const UnitLibrary library(file);
  for (const Call& call : calls) {
    for (const char state : kStates) {
      CAPTURE(call.name, state);
      UnitInstance unit(library);
      REQUIRE(unit.handle != nullptr);
      bring_to(unit, state);
      const bool legal = std::string(call.legal_states).find(state) != std::string::npos;
      CHECK(call.run(unit) == (legal ? fmi3OK : fmi3Error));
      CHECK(unit.messages.empty() == legal);
      if (legal) continue;
      CHECK_THAT(unit.last_message(), Contains(std::string(call.name) + ": "));
      CHECK_THAT(unit.last_message(), Contains("not allowed in " + state_name(state)));
      CHECK_THAT(unit.last_message(), Contains(state_name(call.legal_states[0])));
    }
  }
}

}  // namespace

TEST_CASE("the life cycle in every state") { check(life_cycle()); }
TEST_CASE("access to values in every state") { check(values()); }
TEST_CASE("access to the unit's state in every state") { check(states()); }
TEST_CASE("the intervals of clocks in every state") { check(clocks(), unit_library("clocks")); }

TEST_CASE("idle skipping in every state") { check(idle_skipping(), unit_library("idler")); }

TEST_CASE("messages in words in every state") { check(messages_in_words()); }

TEST_CASE("a call out of order changes nothing") {
  const UnitLibrary library(unit_library("stepper"));
  UnitInstance unit(library);
  CHECK(unit.step(0, 0.1) == fmi3Error);
  CHECK(unit.start_steps() == fmi3OK);
  CHECK(unit.initialize() == fmi3Error);
  CHECK(unit.step(0, 0.1) == fmi3OK);
  CHECK(unit.integer("steps") == 1);
}

TEST_CASE("without Event Mode a unit steps right after the initialization") {
  const UnitLibrary library(unit_library("stepper"));
  InstanceChoices choices;
  choices.event_mode = false;
  UnitInstance unit(library, choices);
  REQUIRE(unit.initialize() == fmi3OK);
  CHECK(unit.fmi.EnterStepMode(unit.handle) == fmi3Error);
  CHECK(unit.step(0, 0.1) == fmi3OK);
}
