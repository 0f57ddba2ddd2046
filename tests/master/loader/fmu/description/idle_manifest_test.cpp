#include "master/loader/fmu/description/idle_manifest.h"

#include "master/loader/fmu/fmu.h"
#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

core::UnitDescription tank(unsigned derivative_order = 1) {
  core::UnitDescription unit;
  unit.max_output_derivative_order = derivative_order;
  const auto add = [&](const char* name, core::Causality causality, core::ValueType type) {
    core::Variable& variable = unit.variables.emplace_back();
    variable.name = name;
    variable.reference = static_cast<core::ValueReference>(unit.variables.size());
    variable.causality = causality;
    variable.type = type;
  };
  add("inflow", core::Causality::Input, core::ValueType::Float64);
  add("valve", core::Causality::Input, core::ValueType::Boolean);
  add("level", core::Causality::Output, core::ValueType::Float64);
  add("reports", core::Causality::Output, core::ValueType::Int64);
  return unit;
}

std::string with_head(const std::string& head, const std::string& elements) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiLayeredStandardManifest " + head + ">\n" +
         elements + "\n</fmiLayeredStandardManifest>\n";
}

/// The elements begin in line 3.
std::string manifest(const std::string& elements, const std::string& version = "1.0.0") {
  return with_head(
      "xmlns:ls=\"http://fmi-standard.org/fmi-ls-manifest\" ls:fmi-ls-name=\"org.stride.idle\" "
      "ls:fmi-ls-version=\"" +
          version + "\"",
      elements);
}

std::string mistake(const std::string& text, unsigned derivative_order = 1) {
  core::UnitDescription unit = tank(derivative_order);
  return input_error([&] { importer::parse_idle_manifest(text, "tank.fmu/manifest.xml", unit); });
}

std::string mistake_in(const std::string& element) {
  const std::string text = mistake(manifest(element));
  CHECK_THAT(text, Contains("tank.fmu/manifest.xml:3"));
  return text;
}

}  // namespace

TEST_CASE("a manifest gives deadbands and tolerances, and declares the capability") {
  core::UnitDescription unit = tank();
  importer::parse_idle_manifest(
      manifest("<Input name='inflow' valueReference='1' deadband='0.25'/>"
               "<Output name='level' valueReference='3' tolerance='1e-3' hasDerivative='true'/>"),
      "", unit);
  CHECK(unit.promises_idle);
  CHECK(unit.variables[0].deadband == 0.25);
  CHECK(unit.variables[2].tolerance == 1e-3);
  CHECK(unit.variables[2].has_derivative);
  CHECK_FALSE(unit.variables[3].tolerance);
}

TEST_CASE("an empty manifest promises, with no deadband and no tolerance") {
  core::UnitDescription unit = tank(0);
  importer::parse_idle_manifest(manifest(""), "", unit);
  CHECK(unit.promises_idle);
  CHECK(unit.variables[0].deadband == 0);
  CHECK_FALSE(unit.variables[2].tolerance);
  importer::parse_idle_manifest(manifest("<Output name='level' valueReference='3' tolerance='2'/>"),
                                "", unit);
  CHECK_FALSE(unit.variables[2].has_derivative);
}

TEST_CASE("elements of later versions are ignored, unknown ones of this version are a mistake") {
  core::UnitDescription unit = tank();
  CHECK_NOTHROW(importer::parse_idle_manifest(manifest("<Memory size='3'/>", "1.1.0"), "", unit));
  CHECK(unit.promises_idle);
  CHECK_THAT(mistake_in("<Ouput name='level' valueReference='3' tolerance='2'/>"),
             Contains("<Ouput> has no meaning here; expected <Input> or <Output>"));
}

TEST_CASE("what is not a manifest of this extension is refused") {
  CHECK_THAT(mistake("<fmiLayeredStandardManifest>"), Contains("not well-formed"));
  CHECK_THAT(mistake("<Manifest/>"), Contains("expected <fmiLayeredStandardManifest>"));
  CHECK_THAT(mistake(with_head("fmi-ls-name='org.stride.idle' fmi-ls-version='1.0.0'", "")),
             Contains("in the namespace http://fmi-standard.org/fmi-ls-manifest") &&
                 Contains("manifest.xml:2"));
  CHECK_THAT(mistake(with_head("xmlns:ls='http://fmi-standard.org/fmi-ls-manifest' "
                               "ls:fmi-ls-name='org.fmi-standard.fmi-ls-bus'",
                               "")),
             Contains("fmi-ls-name is \"org.fmi-standard.fmi-ls-bus\"; expected "
                      "\"org.stride.idle\""));
  CHECK_THAT(mistake(manifest("", "2.0.0")),
             Contains("fmi-ls-version=\"2.0.0\" is not supported; expected 1.0.0") &&
                 Contains("take the manifest"));
}

TEST_CASE("entries must fit the unit's variables") {
  CHECK_THAT(mistake_in("<Input name='outflow' valueReference='1' deadband='1'/>"),
             Contains("the unit has no variable 'outflow'"));
  CHECK_THAT(mistake_in("<Input name='inflow' valueReference='3' deadband='1'/>"),
             Contains("the variable 'inflow' has the value reference 1, not 3"));
  CHECK_THAT(mistake_in("<Input name='level' valueReference='3' deadband='1'/>"),
             Contains("'level' is a Float64 output; only a Float64 input has a deadband"));
  CHECK_THAT(mistake_in("<Input name='valve' valueReference='2' deadband='1'/>"),
             Contains("'valve' is a Boolean input; only a Float64 input has a deadband"));
  CHECK_THAT(mistake_in("<Output name='reports' valueReference='4' tolerance='1'/>"),
             Contains("'reports' is an Int64 output; only a Float64 output has a tolerance"));
  CHECK_THAT(mistake_in("<Output name='level' valueReference='3' tolerance='1'/>"
                        "<Output name='level' valueReference='3' tolerance='2'/>"),
             Contains("'level' is listed twice"));
  CHECK_THAT(mistake_in("<Output valueReference='3' tolerance='1'/>"),
             Contains("needs the attribute 'name'"));
  CHECK_THAT(mistake_in("<Output name='level' tolerance='1'/>"),
             Contains("needs the attribute 'valueReference'"));
}

TEST_CASE("a deadband is at least 0, a tolerance above it") {
  for (const char* number : {"-0.5", "NaN", "INF"}) {
    CAPTURE(number);
    const std::string value = std::string("'") + number + "'/>";
    CHECK_THAT(mistake_in("<Input name='inflow' valueReference='1' deadband=" + value),
               Contains("of 'inflow': expected a finite number, at least 0"));
    CHECK_THAT(mistake_in("<Output name='level' valueReference='3' tolerance=" + value),
               Contains("of 'level': expected a finite number above 0"));
  }
  CHECK_THAT(mistake_in("<Output name='level' valueReference='3' tolerance='0'/>"),
             Contains("above 0"));
  CHECK_THAT(mistake_in("<Output name='level' valueReference='3' tolerance='much'/>"),
             Contains("tolerance=\"much\""));
  CHECK_THAT(mistake_in("<Output name='level' valueReference='3'/>"),
             Contains("needs the attribute 'tolerance'"));
}

TEST_CASE("an output has a derivative only where the unit has some") {
  CHECK_THAT(
      mistake(
          manifest("<Output name='level' valueReference='3' tolerance='1' hasDerivative='true'/>"),
          0),
      Contains("hasDerivative=\"true\" of 'level'") && Contains("maxOutputDerivativeOrder is 0"));
}

TEST_CASE("an FMU's manifest is read from where the layered standard has it") {
  const auto idler = importer::Fmu::load(test_fmu("idler"));
  CHECK(idler->description()->promises_idle);
  const auto level = idler->description()->find("level");
  CHECK(idler->description()->variables[level.value()].tolerance == 1e-3);
  CHECK_FALSE(importer::Fmu::load(test_fmu("types"))->description()->promises_idle);
}

TEST_CASE("a library of the kit gives its manifest without an FMU") {
  const auto idler = importer::Fmu::load(unit_library("idler"));
  CHECK(idler->description()->promises_idle);
  CHECK_FALSE(importer::Fmu::load(unit_library("types"))->description()->promises_idle);
}

TEST_CASE("a broken manifest is named with the FMU") {
  const Scratch scratch;
  const fs::path folder = make_raw_fmu(scratch, "raw");
  scratch.write(std::string("raw/") + STRIDE_IDLE_MANIFEST, "\n\n<x/>");
  CHECK_THAT(input_error([&] { importer::Fmu::load(folder); }),
             Contains("raw/extra/org.stride.idle/fmi-ls-manifest.xml:3"));
}

TEST_CASE("a manifest without the functions that go with it is refused where the library loads") {
  const Scratch scratch;
  const fs::path folder = make_raw_fmu(scratch, "raw");
  scratch.write(std::string("raw/") + STRIDE_IDLE_MANIFEST, manifest(""));
  const auto fmu = importer::Fmu::load(folder);
  CHECK(fmu->description()->promises_idle);
  CHECK_THAT(input_error([&] { fmu->instantiate("unit"); }),
             Contains("does not export strideEnableIdleSkipping, strideSetIdleTolerances, "
                      "strideGetIdlePromise"));
}
