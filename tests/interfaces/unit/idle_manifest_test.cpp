#include "interfaces/unit/idle_manifest.h"

#include <array>

#include <catch2/catch.hpp>

#include "interfaces/unit/model_description.h"

namespace {

struct Heater : stride::Unit {
  explicit Heater(bool promises, double tolerance = 0.25) {
    describe("a heater").promises_idle = promises;
    input("power", power);
    auto ambient = input("'ambient <temperature>'", temperature);
    auto outputs = output("surface", surface);
    auto core = output("core", core_temperature);
    if (!promises) return;
    ambient.deadband(0.5);
    outputs.tolerance(tolerance);
    core.tolerance(2).derivative(heating);
  }
  void step(stride::Step&) override {}

  double power = 0;
  double temperature = 0;
  std::array<double, 2> surface{};
  double core_temperature = 0;
  double heating = 0;
};

std::string manifest(const stride::Unit& unit) {
  double time = 0;
  return stride::kit::idle_manifest(unit, stride::kit::Table(unit, time));
}

std::string token(const stride::Unit& unit) {
  double time = 0;
  return stride::kit::instantiation_token("heater", unit, stride::kit::Table(unit, time));
}

}  // namespace

TEST_CASE("a manifest has the inputs with a deadband and the outputs with a tolerance") {
  CHECK(manifest(Heater(true)) == R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiLayeredStandardManifest xmlns:fmi-ls="http://fmi-standard.org/fmi-ls-manifest" )"
                                  R"(fmi-ls:fmi-ls-name="org.stride.idle" )"
                                  R"(fmi-ls:fmi-ls-version="1.0.0" )"
                                  R"(fmi-ls:fmi-ls-description="The unit can promise to be idle.">
  <Input name="'ambient &lt;temperature&gt;'" valueReference="2" deadband="0.5"/>
  <Output name="surface" valueReference="3" tolerance="0.25"/>
  <Output name="core" valueReference="4" tolerance="2" hasDerivative="true"/>
</fmiLayeredStandardManifest>
)");
}

TEST_CASE("a unit that never promises has no manifest") { CHECK(manifest(Heater(false)).empty()); }

TEST_CASE("another manifest is another token, so a library and an old manifest do not meet") {
  CHECK(token(Heater(true)) != token(Heater(false)));
  CHECK(token(Heater(true, 0.25)) != token(Heater(true, 0.5)));
  CHECK(token(Heater(true, 0.25)) == token(Heater(true, 0.25)));
}
