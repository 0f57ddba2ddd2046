#include "tests/interfaces/fmi2_header_test.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <set>
#include <string>
#include <type_traits>

#include <catch2/catch.hpp>

// The platform types of FMI 2.0, 2.1.2.
static_assert(std::is_same_v<fmi2Real, double> && sizeof(fmi2Real) == 8);
static_assert(std::is_same_v<fmi2Integer, int> && sizeof(fmi2Integer) == 4);
static_assert(std::is_same_v<fmi2Boolean, int>);
static_assert(std::is_same_v<fmi2Char, char>);
static_assert(std::is_same_v<fmi2String, const char*>);
static_assert(std::is_same_v<fmi2Byte, char>);
static_assert(std::is_same_v<fmi2ValueReference, unsigned>);
static_assert(std::is_same_v<fmi2Component, void*>);

namespace {

struct Seen {
  std::string text;
  fmi2Status logged = fmi2OK, finished = fmi2OK;
};

void log(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
         fmi2String category, fmi2String message, ...) {
  char text[100];
  va_list arguments;
  va_start(arguments, message);
  std::vsnprintf(text, sizeof text, message, arguments);
  va_end(arguments);
  auto* seen = static_cast<Seen*>(environment);
  seen->text = std::string(instance) + ":" + category + ":" + text;
  seen->logged = status;
}

}  // namespace

TEST_CASE("C and C++ give every platform type the same size and alignment") {
#define CHECK_SIZE(T)                        \
  CHECK(c_size_of_##T() == sizeof(fmi2##T)); \
  CHECK(c_align_of_##T() == alignof(fmi2##T));
  PLATFORM_TYPES(CHECK_SIZE)
#undef CHECK_SIZE
}

TEST_CASE("the enumerators have the values of the standard") {
  const int expected[] = {0, 1, 2, 3, 4, 5, 0, 1, 0, 1, 2, 3};
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    CAPTURE(i);
    CHECK(c_enumerators[i] == expected[i]);
  }
}

TEST_CASE("the entry table has every function of FMI 2.0 once") {
  std::set<std::string> names;
#define ADD(name) names.insert(#name);
  FMI2_FUNCTIONS(ADD)
#undef ADD
  CHECK(names.size() == 44);
  CHECK(c_function_count() == names.size());
}

TEST_CASE("callbacks carry their arguments from C to C++") {
  Seen seen;
  const fmi2CallbackFunctions functions = {
      &log, &std::calloc, &std::free,
      [](fmi2ComponentEnvironment environment, fmi2Status status) {
        static_cast<Seen*>(environment)->finished = status;
      },
      &seen};
  c_call_back(&functions);
  CHECK(seen.text == "name:category:3 and 4 and text and 0.5");
  CHECK(seen.logged == fmi2Discard);
  CHECK(seen.finished == fmi2Warning);
}

TEST_CASE("functions carry their arguments from C++ to C") {
  double number = 0;
  CHECK(c_do_step(&number, 1.5, 0.25, fmi2True) == fmi2Pending);
  CHECK(number == 1.75);

  double reached = 0;
  CHECK(c_get_real_status(&number, fmi2LastSuccessfulTime, &reached) == fmi2OK);
  CHECK(reached == 1.75);
  CHECK(c_get_real_status(&number, fmi2Terminated, &reached) == fmi2Discard);

  const fmi2ValueReference references[] = {3, 2};
  const fmi2Integer orders[] = {1, 2};
  const double values[] = {0.5, 0.25};
  number = 0;
  CHECK(c_set_input_derivatives(&number, references, 2, orders, values) == fmi2OK);
  CHECK(number == 2.5);

  fmi2Boolean flags[] = {7, 7};
  CHECK(c_get_boolean(&number, references, 2, flags) == fmi2OK);
  CHECK((flags[0] == fmi2True && flags[1] == fmi2False));

  fmi2EventInfo info = {};
  CHECK(c_new_discrete_states(&number, &info) == fmi2OK);
  CHECK((info.terminateSimulation && info.valuesOfContinuousStatesChanged));
  CHECK((info.nextEventTimeDefined && info.nextEventTime == 2.5));
  CHECK_FALSE((info.newDiscreteStatesNeeded || info.nominalsOfContinuousStatesChanged));
}
