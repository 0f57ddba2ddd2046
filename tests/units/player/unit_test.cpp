// The player seen by an importer.
#include <algorithm>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"
#include "tests/units/player/example.h"
#include "tests/units/resource_folder.h"

using namespace stride::tests;
using Catch::Contains;

namespace {

struct Resources : ResourceFolder {
  explicit Resources(const std::string& text) : ResourceFolder("stimuli.csv", text) {}
};

}  // namespace

TEST_CASE("the table is that of the captured inputs") {
  const UnitLibrary library(unit_library("player"));
  const Resources resources(example());
  const std::string xml = library.describe(resources.path());
  CHECK(attribute(xml, "name=\"level\"", "causality") == "output");
  CHECK(attribute(xml, "name=\"level\"", "unit") == "V");
  CHECK(attribute(xml, "name=\"mode\"", "variability") == "discrete");
  CHECK(attribute(xml, "name=\"message.text\"", "clocks") ==
        attribute(xml, "name=\"message.clock\"", "valueReference"));
  CHECK_THAT(xml, Contains("Plays to 'lamp' what 'left' received in 'room'"));
  CHECK_THAT(xml, Contains("<Item name=\"on\" value=\"2\""));
}

TEST_CASE("without stimuli, or with bad ones, the error has what is expected") {
  const UnitLibrary library(unit_library("player"));
  CHECK_THROWS_WITH(library.describe(),
                    Contains("expected one with stimuli.csv") && Contains("stride run --capture"));
  const Resources none("");
  CHECK_THROWS_WITH(library.describe(none.path()), Contains("stimuli.csv: cannot be read"));
  const Resources bad(replaced(example(), "0.25,,level,0.75", "0.25,,level,x"));
  CHECK_THROWS_WITH(library.describe(bad.path()),
                    Contains("stimuli.csv:20: 'x' is not a valid Float64"));
}

TEST_CASE("the first and the last row are where a run begins and ends") {
  const UnitLibrary library(unit_library("player"));
  const auto experiment = [&](const char* table) {
    const Resources resources(table);
    const std::string xml = library.describe(resources.path());
    const std::size_t begin = std::min(xml.find("<DefaultExperiment"), xml.size());
    return xml.substr(begin, begin < xml.size() ? xml.find("/>", begin) - begin : 0);
  };
  CHECK(experiment("time,u\n0,1\n10,2\n") == "<DefaultExperiment stopTime=\"10\"");
  CHECK(experiment("time [min],u\n-1,1\n1,2\n") ==
        "<DefaultExperiment startTime=\"-60\" stopTime=\"60\"");
  CHECK(experiment("time,f.a:Int8 event\n1,1\n2,2\n") == "<DefaultExperiment stopTime=\"2\"");
  CHECK(experiment("time,u\n0,1\n") == "");
}

TEST_CASE("a table's columns are outputs; lines are continuous, with a tangent") {
  const UnitLibrary library(unit_library("player"));
  const Resources resources("time,car.speed [m/s],gear: Int32\n0,72,1\n10,100,2\n");
  const std::string xml = library.describe(resources.path());
  CHECK(attribute(xml, "name=\"car.speed\"", "causality") == "output");
  CHECK(attribute(xml, "name=\"car.speed\"", "unit") == "m/s");
  CHECK(attribute(xml, "name=\"gear\"", "variability") == "discrete");
  CHECK(xml.find("captured.unit") == std::string::npos);
  const Resources texts("time,u: String\n0,1\n1,\"a\"\n");
  CHECK_NOTHROW(library.describe(texts.path()));
  const Resources mixed("time,u\n0,1\n1,\"a\"\n");
  CHECK_THROWS_WITH(library.describe(mixed.path()), Contains("stimuli.csv:3: column 'u': 'a'"));
  const Resources twice("time,u,u\n0,1,2\n");
  CHECK_THROWS_WITH(library.describe(twice.path()), Contains("stimuli.csv:1: columns 2 and 3"));
}
