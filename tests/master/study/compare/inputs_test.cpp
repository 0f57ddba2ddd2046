#include "master/study/compare/inputs.h"

#include <nlohmann/json.hpp>

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

const char* const kInputs = R"({"system": "tank", "start": 0.0, "stop": 60.0,
  "step": {"policy": "fixed", "size": 0.001},
  "units": [{"name": "gauge", "model": "minimal", "fmi_version": "3.0", "calls": 7}],
  "connections": [{"from": "tank.level", "to": "gauge.u", "kind": "value"}],
  "interventions": [{"kind": "force", "variable": "gauge.u", "from": 20.0, "value": "0.2"}],
  "provenance": {"version": "0.1.0", "date": "2026-11-27", "host": "here",
    "commands": [{"words": ["run", "tank.ssd", "--set", "tank.hole=1", "--out", "a", "--seed=3"]}],
    "sources": [{"what": "a unit of the scenario", "path": "/a/gauge.fmu", "sha256": "00ff"}]}})";

std::vector<InputDifference> inputs_with(const std::string& from, const std::string& to) {
  std::string text = kInputs;
  text.replace(text.find(from), from.size(), to);
  const report::Json a = report::Json::parse(kInputs);
  const report::Json b = report::Json::parse(text);
  return compare_inputs({a, "run.json"}, {b, "run.json"});
}

using Inputs = std::vector<InputDifference>;

}  // namespace

TEST_CASE("dates, machines, paths and where results go are no inputs") {
  CHECK(inputs_with("2026-11-27", "2026-11-28").empty());
  CHECK(inputs_with("here", "there").empty());
  CHECK(inputs_with("/a/gauge.fmu", "/b/c/gauge.fmu").empty());
  CHECK(inputs_with(R"("--out", "a")", R"("-o", "b", "--quiet", "--live=8080")").empty());
  CHECK(inputs_with("tank.ssd", "other/tank.ssd").empty());
  CHECK(inputs_with(R"("calls": 7)", R"("calls": 8)").empty());
}

TEST_CASE("files with other contents, or of one run alone, are") {
  CHECK(inputs_with("00ff", "00fe") == Inputs{{"source", "gauge.fmu", "00ff", "00fe"}});
  CHECK(inputs_with("/a/gauge.fmu", "/a/meter.fmu") ==
        Inputs{{"source", "gauge.fmu", "00ff", ""}, {"source", "meter.fmu", "", "00ff"}});
}

TEST_CASE("options of the command line are, with either way to give a value") {
  CHECK(inputs_with("tank.hole=1", "tank.hole=2") ==
        Inputs{{"option", "--set", "tank.hole=1", "tank.hole=2"}});
  CHECK(inputs_with("--seed=3", "--no-checks") ==
        Inputs{{"option", "--no-checks", "", "given"}, {"option", "--seed", "3", ""}});
  CHECK(inputs_with(R"("--set", "tank.hole=1")", R"("--set=tank.hole=1", "--set", "a.b=-1")") ==
        Inputs{{"option", "--set", "", "a.b=-1"}});
}

TEST_CASE("settings, units, connections, interventions and the version are") {
  CHECK(inputs_with("60.0", "50.0") == Inputs{{"setting", "stop", "60.0", "50.0"}});
  CHECK(inputs_with("0.001", "0.01") == Inputs{{"setting", "step.size", "0.001", "0.01"}});
  CHECK(inputs_with("minimal", "maximal") ==
        Inputs{{"unit", "gauge", "minimal, FMI 3.0", "maximal, FMI 3.0"}});
  CHECK(inputs_with("tank.level", "tank.flow") ==
        Inputs{{"connection", "gauge.u", "from tank.level", "from tank.flow"}});
  CHECK(inputs_with("0.2", "0.3") == Inputs{{"intervention", "gauge.u", "force from 20.0 value 0.2",
                                             "force from 20.0 value 0.3"}});
  CHECK(inputs_with("0.1.0", "0.2.0") == Inputs{{"version", "stride", "0.1.0", "0.2.0"}});
}

TEST_CASE("what is no list of inputs is refused") {
  const auto error = [] {
    return error_of([] {
      inputs_with(
          R"([{"what": "a unit of the scenario", "path": "/a/gauge.fmu", "sha256": "00ff"}])",
          R"("none")");
    });
  };
  CHECK_THAT(error(),
             Contains("run.json: this is not what `stride run` writes: 'sources' is no list"));
  CHECK(inputs_with(R"("step": {"policy": "fixed", "size": 0.001})", R"("step": 5)").size() == 2);
}
