#include <stdexcept>

#include <catch2/catch.hpp>

#include "master/scenario/run_settings.h"

using namespace stride::io;
using Catch::Contains;
using namespace std::chrono_literals;

namespace {

const std::vector<std::string> kNames = {"sensor", "arm.motor"};

HostRule rule(const char* pattern, const HostSettings& settings) {
  return {{pattern, {"x.ssd", 7}}, settings};
}

HostSettings hosted() { return {.process = true}; }

}  // namespace

TEST_CASE("without a word nothing is said of any component") {
  for (const HostSettings& settings : HostRules().settings(kNames)) {
    CHECK_FALSE(settings.process);
    CHECK_FALSE(settings.call_limit);
    CHECK_FALSE(settings.memory_limit);
    CHECK_FALSE(settings.sandbox);
    CHECK_FALSE(settings.snapshots);
  }
}

TEST_CASE("what a later rule says goes before, what it does not say stays") {
  HostRules hosts;
  hosts.rules = {rule("*", {true, {"x.ssd", 7}, 5s, 1024, true}),
                 rule("arm.*", {.process = false, .where = {"x.ssd", 8}, .snapshots = false}),
                 rule("sensor", {.call_limit = 1s, .sandbox = false})};
  const auto settings = hosts.settings(kNames);
  REQUIRE(settings.size() == 2);
  CHECK(settings[0].process == true);
  CHECK(settings[0].where.line == 7);
  CHECK(settings[0].call_limit == 1s);
  CHECK(settings[0].memory_limit == 1024);
  CHECK(settings[0].sandbox == false);
  CHECK(settings[1].process == false);
  CHECK(settings[1].where.line == 8);
  CHECK(settings[1].call_limit == 5s);
  CHECK(settings[1].snapshots == false);
}

TEST_CASE("a rule for no component is refused with its place") {
  HostRules hosts;
  hosts.rules = {rule("senor", hosted())};
  CHECK_THROWS_WITH(hosts.settings(kNames), Contains("x.ssd:7: 'senor' matches no component") &&
                                                Contains("did you mean 'sensor'?"));
}

TEST_CASE("a time limit is above 0 s, and whole milliseconds at the end") {
  CHECK(parse_call_limit("0.25") == 250ms);
  CHECK(parse_call_limit("1e-5") == 1ms);
  CHECK(parse_call_limit("0.0011") == 2ms);
  for (const char* text : {"0", "-1", "x", ""}) {
    CHECK_THROWS_AS(parse_call_limit(text), std::invalid_argument);
  }
}

TEST_CASE("a memory limit is a whole number of MiB") {
  CHECK(parse_memory_limit("3") == 3 * 1024 * 1024);
  for (const char* text : {"0", "-1", "1.5", "x", "", "18446744073709551615"}) {
    CHECK_THROWS_AS(parse_memory_limit(text), std::invalid_argument);
  }
}
