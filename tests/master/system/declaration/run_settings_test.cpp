#include "master/system/declaration/run_settings.h"

#include <memory>
#include <stdexcept>

#include <catch2/catch.hpp>

using namespace stride::core;
using namespace stride::scenario;
using Catch::Contains;
using namespace std::chrono_literals;
using namespace stride;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> kNames = {"sensor", "arm.motor"};

HostRule rule(const char* pattern, const HostSettings& settings) {
  return {{pattern, {"x.ssd", 7}}, settings};
}

HostSettings hosted() { return {.process = true}; }

}  // namespace

TEST_CASE("by default no component has settings") {
  for (const HostSettings& settings : HostRules().settings(kNames)) {
    CHECK_FALSE(settings.process);
    CHECK_FALSE(settings.call_limit);
    CHECK_FALSE(settings.memory_limit);
    CHECK_FALSE(settings.sandbox);
    CHECK_FALSE(settings.snapshots);
  }
}

TEST_CASE("a later rule overrides what it sets, and keeps the rest") {
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

namespace {

core::Variable variable(const char* name, core::ValueReference reference, core::Causality causality,
                        std::optional<double> tolerance = std::nullopt) {
  core::Variable variable;
  variable.name = name;
  variable.reference = reference;
  variable.causality = causality;
  variable.tolerance = tolerance;
  return variable;
}

/// Two units with an input `u` and an output `y`, of which `idler` can promise to be idle.
core::System make_system() {
  core::SystemDeclaration declaration;
  for (const bool promises : {true, false}) {
    auto unit = std::make_shared<core::UnitDescription>();
    unit->promises_idle = promises;
    unit->variables = {variable("u", 0, core::Causality::Input),
                       variable("y", 1, core::Causality::Output,
                                promises ? std::optional<double>(0.1) : std::nullopt)};
    declaration.components.push_back({promises ? "idler" : "busy", unit, {}, {}});
  }
  return core::System(declaration);
}

IdleRule rule(const char* pattern, bool enabled, std::optional<Duration> skip) {
  return {{pattern, {"x.ssd", 7}}, enabled, skip, {"x.ssd", 7}};
}

core::StepOptions step(Duration size) {
  core::StepOptions options;
  options.size = size;
  return options;
}

template <class Change>
std::string refusal(Change&& change) {
  IdleSettings settings;
  change(settings);
  const core::System system = make_system();
  try {
    settings.options(system, step(1ms));
  } catch (const core::Error& error) {
    CHECK(error.kind() == core::Error::Kind::Input);
    return error.what();
  }
  return "none";
}

}  // namespace

TEST_CASE("by default every unit may be suspended for a second") {
  const core::System system = make_system();
  const core::IdleOptions options = IdleSettings().options(system, step(1ms));
  CHECK(options.max_skip == std::vector<std::optional<Duration>>{Duration(1s), Duration(1s)});
  CHECK(options.least == Duration(1ms));
}

TEST_CASE("a later rule takes precedence over an earlier one") {
  const core::System system = make_system();
  IdleSettings settings;
  settings.rules = {rule("*", true, Duration(3s)), rule("busy", false, std::nullopt)};
  using Skips = std::vector<std::optional<Duration>>;
  CHECK(settings.options(system, step(1ms)).max_skip == Skips{Duration(3s), std::nullopt});
  settings.rules.push_back(rule("b*", true, std::nullopt));
  CHECK(settings.options(system, step(1ms)).max_skip == Skips{Duration(3s), Duration(1s)});
}

TEST_CASE("deadbands and tolerances find their variables") {
  const core::System system = make_system();
  IdleSettings settings;
  settings.deadbands = {{"idler.u", 0.5, {}}};
  settings.tolerances = {{"idler.y", 0.25, {}}};
  const core::IdleOptions options = settings.options(system, step(1ms));
  REQUIRE(options.deadbands.size() == 1);
  CHECK(options.deadbands[0].id == core::VariableId{0, 0});
  CHECK(options.deadbands[0].value == 0.5);
  REQUIRE(options.tolerances.size() == 1);
  CHECK(options.tolerances[0].id == core::VariableId{0, 1});
}

TEST_CASE("a setting that does not fit is refused at its line") {
  CHECK_THAT(
      refusal([](IdleSettings& c) {
        c.deadbands = {{"idler.v", 1, {"x.ssd", 3}}};
      }),
      Contains("x.ssd:3") && Contains("'idler.v' is not a Float64 input") && Contains("idler.u"));
  CHECK_THAT(refusal([](IdleSettings& c) {
               c.deadbands = {{"busy.u", 1, {}}};
             }),
             Contains("can promise to be idle"));
  CHECK_THAT(refusal([](IdleSettings& c) {
               c.tolerances = {{"busy.y", 1, {}}};
             }),
             Contains("not an output with a tolerance"));
  CHECK_THAT(refusal([](IdleSettings& c) { c.rules = {rule("idle", true, std::nullopt)}; }),
             Contains("x.ssd:7") && Contains("matches no component"));
  CHECK_THAT(
      refusal([](IdleSettings& c) { c.rules = {rule("*", true, Duration(500us))}; }),
      Contains("x.ssd:7") && Contains("0.0005 s is below the communication step of 0.001 s"));
  CHECK(refusal([](IdleSettings& c) { c.rules = {rule("*", true, Duration(1ms))}; }) == "none");
}

TEST_CASE("a skip is above 0 s") {
  CHECK(parse_max_skip("0.25") == Duration(250ms));
  for (const char* text : {"0", "-1", "x", ""}) {
    CHECK_THROWS_AS(parse_max_skip(text), std::invalid_argument);
  }
}
