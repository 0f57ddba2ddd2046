#include "master/base/diagnostics.h"

#include <catch2/catch.hpp>

using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

void keep(Diagnostics& diagnostics, const Context& context, const std::string& message,
          const std::string& hint = "") {
  CHECK_FALSE(diagnostics.attempt([&] { fail_input(context, message, hint); }));
}

std::string told(const Diagnostics& diagnostics) {
  try {
    diagnostics.raise();
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("nothing is raised where nothing went wrong") {
  Diagnostics diagnostics;
  bool is_called = false;
  CHECK(diagnostics.attempt([&] { is_called = true; }));
  CHECK(is_called);
  CHECK_FALSE(diagnostics.any());
  CHECK_NOTHROW(diagnostics.raise());
}

TEST_CASE("a single mistake is raised as it is") {
  Diagnostics diagnostics;
  keep(diagnostics, {{"a.ssd", 7}, "sensor", "led", {}}, "it is wrong", "mend it");
  CHECK(diagnostics.any());
  CHECK(told(diagnostics) ==
        "a.ssd:7: unit 'sensor', variable 'led': it is wrong\n  hint: mend it");
}

TEST_CASE("several mistakes have a line each, those about one unit together") {
  Diagnostics diagnostics;
  keep(diagnostics, {{"a.ssd", 7}, "sensor", "led", {}}, "first");
  keep(diagnostics, {{"a.ssd", 8}, "world", "x", {}}, "second", "mend x");
  keep(diagnostics, {{"a.ssd", 9}, {}, {}, {}}, "third", "look");
  keep(diagnostics, {{"a.ssd", 5}, "sensor", "adc", {}}, "fourth", "look");
  CHECK(told(diagnostics) ==
        "there are 4 mistakes:\n"
        "  a.ssd:7: unit 'sensor', variable 'led': first\n"
        "  a.ssd:5: unit 'sensor', variable 'adc': fourth\n"
        "  a.ssd:8: unit 'world', variable 'x': second (mend x)\n"
        "  a.ssd:9: third\n"
        "  hint: look");
  CHECK(diagnostics.mentions("sensor", "adc"));
  CHECK_FALSE(diagnostics.mentions("world", "adc"));
}

TEST_CASE("where all are about one unit it is named once") {
  Diagnostics diagnostics;
  keep(diagnostics, {{"a.ssd", 7}, "sensor", "led", {}}, "first");
  keep(diagnostics, {{"a.ssd", 8}, "sensor", "adc", {}}, "second");
  CHECK(told(diagnostics) ==
        "unit 'sensor': 2 things do not fit:\n"
        "  a.ssd:7: variable 'led': first\n"
        "  a.ssd:8: variable 'adc': second");
}

TEST_CASE("what sums up the mistakes of a unit is above them if all are about it") {
  Diagnostics diagnostics;
  diagnostics.sum_up("sensor", {"a.ssd", 3}, "it has none of 2 variables");
  diagnostics.sum_up("world", {"a.ssd", 4}, "not this");
  keep(diagnostics, {{"a.ssd", 7}, "sensor", "led", {}}, "first");
  CHECK(told(diagnostics) == "a.ssd:7: unit 'sensor', variable 'led': first");
  keep(diagnostics, {{"a.ssd", 8}, "sensor", "adc", {}}, "second");
  CHECK(told(diagnostics) ==
        "a.ssd:3: unit 'sensor': 2 things do not fit; it has none of 2 variables:\n"
        "  a.ssd:7: variable 'led': first\n"
        "  a.ssd:8: variable 'adc': second");
  keep(diagnostics, {{"a.ssd", 9}, {}, {}, {}}, "third");
  CHECK_THAT(told(diagnostics), Contains("there are 3 mistakes:") && !Contains("none of"));
}

TEST_CASE("very many mistakes are counted") {
  Diagnostics diagnostics;
  for (int i = 0; i < 100; ++i) keep(diagnostics, {{"a.ssd", i}, "sensor", "led", {}}, "wrong");
  CHECK_THAT(told(diagnostics), Contains("100 things") && Contains("a.ssd:59") &&
                                    !Contains("a.ssd:60") && Contains("… and 40 more"));
}

TEST_CASE("only what the user gave is kept") {
  Diagnostics diagnostics;
  CHECK_THROWS_AS(diagnostics.attempt([] { fail_run({}, "it broke"); }), Error);
  CHECK_THROWS_AS(diagnostics.attempt([] { throw std::logic_error("a bug"); }), std::logic_error);
  CHECK_FALSE(diagnostics.any());
}

TEST_CASE("the work for mistakes only is bounded") {
  Diagnostics diagnostics;
  for (std::size_t i = 1; i < Diagnostics::kMostKept; ++i) {
    keep(diagnostics, {{"a.ssd", 7}, {}, {}, {}}, "wrong");
  }
  CHECK_THROWS_WITH(diagnostics.attempt([] {
    fail_input({{"a.ssd", 7}, {}, {}, {}}, "wrong");
  }),
                    Contains("at least 1000 mistakes"));
}
