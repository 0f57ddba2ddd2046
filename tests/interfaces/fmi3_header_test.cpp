#include "tests/interfaces/fmi3_header_test.h"

#include <iterator>
#include <set>
#include <string>
#include <type_traits>

#include <catch2/catch.hpp>

// The platform types of FMI 3.0, 2.2.3.
static_assert(std::is_same_v<fmi3Float32, float> && sizeof(fmi3Float32) == 4);
static_assert(std::is_same_v<fmi3Float64, double> && sizeof(fmi3Float64) == 8);
static_assert(std::is_same_v<fmi3Int8, std::int8_t>);
static_assert(std::is_same_v<fmi3UInt8, std::uint8_t>);
static_assert(std::is_same_v<fmi3Int16, std::int16_t>);
static_assert(std::is_same_v<fmi3UInt16, std::uint16_t>);
static_assert(std::is_same_v<fmi3Int32, std::int32_t>);
static_assert(std::is_same_v<fmi3UInt32, std::uint32_t>);
static_assert(std::is_same_v<fmi3Int64, std::int64_t>);
static_assert(std::is_same_v<fmi3UInt64, std::uint64_t>);
static_assert(std::is_same_v<fmi3Boolean, bool> && sizeof(fmi3Boolean) == 1);
static_assert(std::is_same_v<fmi3Clock, bool>);
static_assert(std::is_same_v<fmi3Char, char>);
static_assert(std::is_same_v<fmi3String, const char*>);
static_assert(std::is_same_v<fmi3Byte, std::uint8_t>);
static_assert(std::is_same_v<fmi3Binary, const std::uint8_t*>);
static_assert(std::is_same_v<fmi3ValueReference, std::uint32_t>);
static_assert(std::is_same_v<fmi3Instance, void*>);

TEST_CASE("C and C++ give every platform type the same size and alignment") {
#define CHECK_SIZE(T)                        \
  CHECK(c_size_of_##T() == sizeof(fmi3##T)); \
  CHECK(c_align_of_##T() == alignof(fmi3##T));
  PLATFORM_TYPES(CHECK_SIZE)
#undef CHECK_SIZE
}

TEST_CASE("the enumerators have the values of the standard") {
  const int expected[] = {0, 1, 2, 3, 4, 0, 1, 2, 3, 4, 5, 0, 1, 2};
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    CAPTURE(i);
    CHECK(c_enumerators[i] == expected[i]);
  }
}

TEST_CASE("the entry table has every function of FMI 3.0 once") {
  std::set<std::string> names;
#define ADD(name) names.insert(#name);
  FMI3_FUNCTIONS(ADD)
#undef ADD
  CHECK(names.size() == 75);
  CHECK(c_function_count() == names.size());
}

TEST_CASE("callbacks carry their arguments from C to C++") {
  struct Seen {
    std::string text;
    fmi3Status status = fmi3OK;
    double time = 0;
  } seen;
  c_log(
      [](fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
         fmi3String message) {
        auto* to = static_cast<Seen*>(environment);
        to->status = status;
        to->text = std::string(category) + ":" + message;
      },
      &seen);
  CHECK(seen.status == fmi3Discard);
  CHECK(seen.text == "category:message");
  c_intermediate_update(
      [](fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean set_requested,
         fmi3Boolean get_allowed, fmi3Boolean finished, fmi3Boolean can_return,
         fmi3Boolean* requested, fmi3Float64* until) {
        const bool as_sent = set_requested && !get_allowed && finished && !can_return;
        static_cast<Seen*>(environment)->time = as_sent && !*requested && *until == 0 ? time : -1;
      },
      &seen);
  CHECK(seen.time == 1.5);
}

TEST_CASE("functions carry their arguments from C++ to C") {
  bool event = false, terminate = true, early = false;
  double reached = 0;
  CHECK(c_do_step(&reached, 1.5, 0.25, true, &event, &terminate, &early, &reached) == fmi3Discard);
  CHECK((event && !terminate && early && reached == 1.75));

  const fmi3ValueReference references[] = {3, 2};
  std::size_t sizes[2] = {};
  fmi3Binary values[2] = {};
  CHECK(c_get_binary(&reached, references, 2, sizes, values, 2) == fmi3OK);
  CHECK((sizes[0] == 3 && sizes[1] == 2 && values[1][2] == 3));

  std::size_t sum = 0;
  const fmi3Clock clocks[] = {fmi3ClockActive, fmi3ClockInactive};
  CHECK(c_set_clock(&sum, references, 2, clocks) == fmi3Warning);
  CHECK(sum == 3);
}

TEST_CASE("the functions of idle skipping carry their arguments from C++ to C") {
  double sum = 0;
  const fmi3ValueReference outputs[] = {3, 2};
  const double tolerances[] = {0.5, 0.25};
  CHECK(c_set_idle_tolerances(&sum, outputs, 2, tolerances, 2) == fmi3Warning);
  double until = 0;
  CHECK(c_get_idle_promise(&sum, &until) == fmi3OK);
  CHECK(until == 2);
}
