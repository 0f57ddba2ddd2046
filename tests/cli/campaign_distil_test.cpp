// stride campaign distil, from outside.
#include <algorithm>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "tests/cli/campaigns.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const std::string kCapture = "<stride:Capture component='second'/>";

struct Distilled : Workspace {
  explicit Distilled(const std::string& text, const Parts& parts = checked_filters(),
                     int exit_code = 1)
      : Workspace(parts) {
    scratch().write("c.xosc", text);
    const Outcome outcome = stride({"campaign", "run", "c.xosc", "-q", "--out", "cases"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == exit_code);
  }
  Outcome distil(const Arguments& further = {}, const std::string& component = "second") const {
    Arguments arguments{"campaign", "distil", "cases", "--component", component, "-o", "suite"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return stride(arguments);
  }
  /// Runs the suite where nothing else is.
  Outcome run_suite(const Arguments& further = {}) const {
    const fs::path elsewhere = *this / "elsewhere";
    fs::remove_all(elsewhere);
    fs::create_directories(elsewhere);
    fs::copy(*this / "suite", elsewhere / "moved", fs::copy_options::recursive);
    Arguments arguments{"env", "STRIDE_PROGRAM=" + stride_command({}).front(),
                        "STRIDE_UNITS=", "moved/run.sh"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return Process(arguments, elsewhere).wait();
  }
  void check_distilled(const Arguments& further = {}, const std::string& device = "second") const {
    const Outcome outcome = distil(further, device);
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err == "");
    const Outcome suite = run_suite();
    INFO(suite.out << suite.err);
    CHECK(suite.exit_code == 0);
    CHECK(static_cast<std::size_t>(std::count(suite.out.begin(), suite.out.end(), '\n')) ==
          replays().size());
  }
  std::vector<std::string> replays() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(*this / "suite")) {
      if (entry.path().extension() == ".ssd") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

/// One input in each case.
std::string inputs(std::initializer_list<const char*> values, const std::string& extension) {
  return campaign_text(deterministic(value_set("first.u", values)), extension, "test.ssd");
}

std::string all_of(const std::string& component) {
  return "<stride:Keep results='all'/><stride:Capture component='" + component + "'/>";
}

}  // namespace

TEST_CASE("without coverage there is a case for each way to end") {
  const Distilled space(inputs({"0.5", "9", "0.25", "5"}, kCapture));
  const Outcome outcome = space.distil();
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out,
             Contains("c: 2 of 4 cases are enough for 'second'\nThey have 2 ways to end") &&
                 Contains("the records have no coverage of it") &&
                 Contains("failed by 'bounded'") && Contains("Suite in suite:"));
  CHECK(space.replays() == std::vector<std::string>{"case_000000", "case_000001"});
  CHECK_FALSE(fs::exists(space / "suite.stride-new"));
  CHECK_THAT(read(space / "suite/README.md"),
             Contains("| 1 | failed by 'bounded' | its end | results and stimuli "
                      "of the case | `stride run test.ssd --set first.u=9` |") &&
                 Contains("| stimuli of the case | `stride run test.ssd --set first.u=0.5` |"));
  const Outcome suite = space.run_suite();
  CHECK(suite.out == "case_000000: passed\ncase_000001: passed\n");
  CHECK(suite.exit_code == 0);
}

TEST_CASE("the suite is the same when it is made again, whatever the jobs were") {
  const Distilled space(inputs({"0.5", "9"}, kCapture));
  CHECK(space.distil().exit_code == 0);
  fs::rename(space / "suite", space / "before");
  fs::create_directory(space / "suite");
  CHECK(space.stride({"campaign", "distil", "cases", "--component", "second", "-o", "suite/"})
            .exit_code == 0);
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(space / "suite")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path name = entry.path().lexically_relative(space / "suite");
    INFO(name);
    CHECK((read(space / "before" / name) == read(entry.path())));
  }
  CHECK(files == 11);
}

TEST_CASE("the cases that are chosen cover what all cover, and so do their replays") {
  Parts parts = checked_filters();
  parts.annotation +=
      "<stride:Coverage><stride:Group component='second' goal='90'>"
      "<stride:Values name='in' signal='u' edges='-1 -0.3 0 0.3 0.6'/>"
      "</stride:Group></stride:Coverage>";
  const Distilled space(inputs({"0.5", "0.25", "-0.5", "9", "5"}, kCapture), parts);
  space.check_distilled();
  CHECK(space.replays() == std::vector<std::string>{"case_000002", "case_000003"});
  // what is above 0.6 is no part of it
  CHECK_THAT(read(space / "suite/README.md"),
             Contains("They have 4 covered bins and 2 ways to end.\n") &&
                 Contains("in: [0.3, 0.6]") && Contains("in: [-1, -0.3)"));
  Arguments merge{"coverage", "--out", "replays.json"};
  for (const std::string& name : space.replays())
    merge.push_back("elsewhere/moved/results/" + name);
  REQUIRE(space.stride(merge).exit_code == 0);
  const auto hits = [&](const std::string& file) {
    std::set<std::string> names;
    const json report = json::parse(read(space / file));
    for (const auto& bin : report["groups"][0]["points"][0]["bins"]) {
      if (bin["count"] > 0 && !bin.contains("ignored")) names.insert(bin["name"]);
    }
    return names;
  };
  CHECK(hits("replays.json").size() == 4);
  CHECK(hits("replays.json") == hits("cases/coverage.json"));
}

TEST_CASE("where bins are to have several visits, the cases that are chosen have them") {
  Parts parts = checked_filters();
  parts.annotation +=
      "<stride:Coverage><stride:Group component='second' atLeast='2'>"
      "<stride:Values name='in' signal='u' edges='-1 -0.3 0 0.3 0.6'/>"
      "</stride:Group></stride:Coverage>";
  const Distilled space(inputs({"0.5", "0.25", "-0.5", "9", "5", "0.75"}, kCapture), parts);
  space.check_distilled();
  Arguments merge{"coverage", "--out", "replays.json"};
  for (const std::string& name : space.replays())
    merge.push_back("elsewhere/moved/results/" + name);
  REQUIRE(space.stride(merge).exit_code == 0);
  const auto covered = [&](const std::string& file) {
    std::set<std::string> names;
    const json report = json::parse(read(space / file));
    for (const auto& bin : report["groups"][0]["points"][0]["bins"]) {
      if (bin["count"] > 1 && !bin.contains("ignored")) names.insert(bin["name"]);
    }
    return names;
  };
  // the two that are negative are hit by one case only
  CHECK(covered("cases/coverage.json") == std::set<std::string>{"[0, 0.3)", "[0.3, 0.6]"});
  CHECK(covered("replays.json") == covered("cases/coverage.json"));
}

TEST_CASE("a replay that covers something else is in no suite") {
  Parts parts = checked_filters();
  parts.annotation +=
      "<stride:Coverage><stride:Group component='second'>"
      "<stride:Values name='in' signal='u' min='0' max='1'/></stride:Group></stride:Coverage>";
  const Distilled space(inputs({"0.5"}, kCapture), parts, 0);
  const std::string name = "cases/cases/000/000000.json";
  std::string line = read(space / name);
  const std::string count = "\"[0.1, 0.2)\":[1,";
  line.replace(line.find(count), count.size(), "\"[0.1, 0.2)\":[2,");
  space.scratch().write(name, line);
  const Outcome outcome = space.distil();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("it does not cover what it covered in the case: 'in'"));
  CHECK_FALSE(fs::exists(space / "suite"));
}

TEST_CASE("a device that does something else fails its suite") {
  const Distilled space(inputs({"0.5"}, kCapture), checked_filters(), 0);
  CHECK(space.distil().exit_code == 0);
  const Outcome other = space.run_suite({"--set", "second.time_constant=0.999"});
  CHECK(other.exit_code == 1);
  CHECK(other.out == "case_000000: FAILED\n");
  CHECK_THAT(other.err, Contains("second.y final = "));
  CHECK(space.run_suite({"--set", "second.time_constant=1"}).exit_code == 0);

  fs::remove_all(space / "suite");
  CHECK(space.distil({"--tolerance", "0.01"}).exit_code == 0);
  CHECK_THAT(read(space / "suite/case_000000.ssd"), Contains("tolerance=\"0.01\""));
  CHECK(space.run_suite({"--set", "second.time_constant=0.999"}).exit_code == 0);
  CHECK(space.run_suite({"--set", "second.time_constant=0.5"}).exit_code == 1);
  // as of a run, the exit code is none of a failure
  const Outcome cut = space.run_suite({"--stop", "0.5"});
  CHECK((cut.exit_code == 0 && cut.out == "case_000000: undecided\n"));
}

TEST_CASE("only bits that differ before the end are seen in the golden outputs") {
  const Distilled space(inputs({"0.5"}, kCapture), checked_filters(), 0);
  CHECK(space.distil().exit_code == 0);
  std::string golden = read(space / "suite/golden/case_000000/signals.csv");
  golden[golden.find("\n0.5,") + 9] ^= 1;
  std::ofstream(space / "suite/golden/case_000000/signals.csv") << golden;
  const Outcome suite = space.run_suite();
  CHECK(suite.exit_code == 1);
  CHECK_THAT(suite.out, Contains("differ") && Contains("case_000000: FAILED"));
}

TEST_CASE("what a device was set to, by the scenario, the case and in the run, is set again") {
  const Distilled space(
      campaign_text(
          deterministic(value_set("source.float64", {"0.5"}) + value_set("sink.gain", {"3"})),
          all_of("sink"), "test.ssd"),
      Parts{component("source", "types.fmu") + component("sink", "types.fmu"),
            connection("source.float64.echo", "sink.float64"),
            "<stride:Step size='0.25'/><stride:Set variable='sink.gain' value='2' at='0.5'/>"
            "<stride:Set variable='sink.colour' value='4' at='0.5'/>"
            "<stride:EarlyReturn components='sink' allowed='false'/>\n"},
      0);
  space.check_distilled({}, "sink");
  CHECK_THAT(read(space / "suite/case_000000.ssd"),
             Contains("<ssv:Float64 value=\"3\"/>") &&
                 Contains("<stride:Set variable=\"sink.gain\" value=\"2\" at=\"0.5\"/>") &&
                 Contains("<stride:Set variable=\"sink.colour\" value=\"blue\" at=\"0.5\"/>") &&
                 Contains("equals=\"blue\"") &&
                 Contains("<stride:EarlyReturn components=\"sink\" allowed=\"false\"/>"));
}

TEST_CASE("a replay has the steps of the run where they have fractions of picoseconds") {
  Parts parts = checked_filters();
  const bool is_own = GENERATE(false, true);
  parts.annotation += is_own ? "<stride:Step components='second' size='0.03333333333333333'/>"
                             : "<stride:Step size='0.03333333333333333'/>";
  const Distilled space(inputs({"0.5"}, kCapture), parts, 0);
  space.check_distilled();
  CHECK_THAT(read(space / "suite/case_000000.ssd"),
             Contains("<stride:Step policy=\"fixed\" size=\"0.03333333333333333\"/>"));
}

TEST_CASE("inputs that were set, forced or held in the run are so in the replay") {
  const auto check = [](const std::string& connections, const std::string& interventions,
                        const std::string& unit = "feedthrough.fmu") {
    INFO(interventions);
    const Distilled space(inputs({"0.5"}, all_of("second")),
                          Parts{component("first", "minimal.fmu") +
                                    component("other", "inverter.fmu") + component("second", unit),
                                connections, "<stride:Step size='0.125'/>" + interventions},
                          0);
    space.check_distilled();
  };
  check("",
        "<stride:Set variable='second.u' value='2' at='0.5'/>"
        "<stride:Set variable='second.u' value='3' at='0.7'/>");
  const std::string wire = connection("first.y", "second.u");
  check(wire, "<stride:Force variable='second.u' value='2' from='0.5' until='0.75'/>");
  check(wire, "<stride:Force variable='second.u' value='2' from='0.55'/>");
  check(wire, "<stride:Force variable='second.u' from='0.25' until='0.7'/>");
  check(connection("other.y", "second.u"),
        "<stride:Force variable='second.u' value='false' from='0.25' until='0.7'/>",
        "inverter.fmu");
}

TEST_CASE("values of every type, arrays and messages are those of the case") {
  std::string wires = connection("source.send.clock", "sink.receive.clock") +
                      connection("source.send.frame", "sink.receive.frame");
  for (const std::string name :
       {"float32", "float64", "int8", "uint64", "boolean", "string", "colour", "matrix", "blobs"}) {
    wires += connection("source." + name + ".echo", "sink." + name);
  }
  const Distilled space(
      campaign_text(deterministic(value_set("source.float64", {"1e-300", "0.1"}) +
                                  value_set("source.string", {"a, &quot;b&quot;"}) +
                                  value_set("source.colour", {"green"}) +
                                  value_set("source.matrix", {"1 2 3 4 5 0.1"}) +
                                  value_set("sink.int16", {"-7"})),
                    all_of("sink"), "test.ssd"),
      Parts{component("source", "types.fmu") + component("sink", "types.fmu"), wires,
            "<stride:Step size='0.25'/>"},
      0);
  space.check_distilled({}, "sink");
  CHECK_THAT(read(space / "suite/case_000000.ssd"),
             Contains("signal=\"sink.matrix.echo[2,3]\" equals=\"0.1\"") &&
                 Contains("signal=\"sink.string.echo\" equals=\"a, &quot;b&quot;\"") &&
                 Contains("event=\"sink.send.frame\" equals=\""));
}

TEST_CASE("a device that is idle, and one that ends its steps early, do the same alone") {
  const Distilled idle(campaign_text(deterministic(value_set("tank.rate", {"0.5", "0.25"})),
                                     all_of("tank"), "test.ssd"),
                       Parts{component("tank", "idler.fmu") + component("first", "minimal.fmu"), "",
                             "<stride:Step size='0.01'/><stride:Record signals='tank.*'/>",
                             "<ssd:DefaultExperiment stopTime=\"3\"/>"},
                       0);
  idle.check_distilled({}, "tank");
  const Distilled early(
      campaign_text(deterministic(value_set("device.instants", {"0.3 0.6 2 2 2 2 2 2"})),
                    all_of("device"), "test.ssd"),
      Parts{component("device", "early.fmu") + component("filter", "minimal.fmu"),
            connection("filter.y", "device.u"), "<stride:Step size='0.25'/>"},
      0);
  early.check_distilled({}, "device");
  CHECK_THAT(read(early / "suite/golden/case_000000/signals.csv"), Contains("\n0.3,"));
}

TEST_CASE("cases that did not come to their end are played up to there") {
  const Distilled space(
      campaign_text(deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.5"}) +
                                  value_set("c.fault", {"", "segfault", "kill"})),
                    kCapture + "<stride:Keep results='all'/>", "test.ssd"),
      {component("c", "faulty.fmu") + two_filters().components, two_filters().connections});
  const Outcome outcome = space.distil();
  INFO(outcome.out << outcome.err);
  CHECK_THAT(outcome.out, Contains("2 ways to end"));
  CHECK(space.replays() == std::vector<std::string>{"case_000000", "case_000001"});
  CHECK_THAT(read(space / "suite/case_000001.ssd"), Contains("stopTime=\"0.499\""));
  CHECK(space.run_suite().exit_code == 0);
}

TEST_CASE("a case that no replay can have is replaced by another, or missed") {
  // the device is its own judge, so its replay fails, too
  const Distilled space(inputs({"0.5", "9"}, all_of("judge")),
                        Parts{component("first", "minimal.fmu") + component("judge", "judge.fmu"),
                              connection("first.y", "judge.u")});
  const Outcome outcome = space.distil({}, "judge");
  INFO(outcome.out);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the suite lacks what only cases without a replay have: ends: "
                                   "failed by 'judge'") &&
                              Contains("case 1 has no replay: judge: the limit was reached"));
  CHECK(space.replays() == std::vector<std::string>{"case_000000"});
  CHECK(space.run_suite().exit_code == 0);
}

TEST_CASE("a folder of the user's beside the suite is left alone") {
  const Distilled space(inputs({"0.5"}, all_of("second")), checked_filters(), 0);
  space.scratch().write("suite.new/thesis", "mine");
  CHECK(space.distil().exit_code == 0);
  CHECK(read(space / "suite.new/thesis") == "mine");
}

TEST_CASE("results of a case that are others are found") {
  const Distilled space(inputs({"0.5"}, all_of("second")), checked_filters(), 0);
  const std::string name = "cases/cases/000/000000/signals.csv";
  std::string signals = read(space / name);
  const std::size_t row = signals.find("\n0.5,");
  signals[signals.find('\n', row + 1) - 1] ^= 1;
  space.scratch().write(name, signals);
  const Outcome outcome = space.distil();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("1 case cannot be replayed, as case 0: it does not do what it did "
                      "in the case: y at 0.5 s"));
  CHECK_FALSE(fs::exists(space / "suite"));
  CHECK_FALSE(fs::exists(space / "suite.stride-new"));
}

TEST_CASE("a device that alone is not given what it was is found") {
  const Distilled space(inputs({"0.5"}, kCapture), checked_filters(), 0);
  const std::string name = "cases/cases/000/000000.stimuli/second.csv";
  std::string stimuli = read(space / name);
  stimuli.insert(stimuli.find("time,event"), "set,time_constant,2\n");
  space.scratch().write(name, stimuli);
  const Outcome outcome = space.distil();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("as case 0: the device does not receive the same at the same "
                                   "times when it is alone"));
}

TEST_CASE("what distil refuses") {
  const Distilled space(inputs({"0.5"}, kCapture), checked_filters(), 0);
  const auto error = [&](const Arguments& arguments) {
    return input_error_of(space.stride(arguments));
  };
  const Arguments good{"campaign", "distil", "cases", "--component", "second", "-o", "suite"};
  const auto with = [&](std::size_t place, const std::string& word) {
    Arguments changed = good;
    changed[place] = word;
    return changed;
  };
  CHECK_THAT(error(with(4, "first")),
             Contains("--component first: the campaign does not capture it"));
  CHECK_THAT(error(with(4, "secnd")), Contains("did you mean 'second'?"));
  CHECK_THAT(error(with(2, "c.xosc")), Contains("there is no plan in this folder"));
  CHECK_THAT(error(with(6, "cases")), Contains("there is something in the way of the suite"));
  CHECK_THAT(error(with(6, "test.ssd")), Contains("test.ssd"));
  Arguments tolerance = good;
  tolerance.insert(tolerance.end(), {"--tolerance", "x"});
  CHECK_THAT(error(tolerance), Contains("--tolerance"));
  CHECK_FALSE(fs::exists(space / "suite"));

  space.scratch().write("d.xosc", inputs({"0.5"}, ""));
  CHECK(space.stride({"campaign", "run", "d.xosc", "-q"}).exit_code == 0);
  CHECK_THAT(error(with(2, "d.xosc")), Contains("write <stride:Capture component=\"second\"/>"));
  CHECK(space.stride({"campaign", "plan", "c.xosc", "--out", "fresh"}).exit_code == 0);
  CHECK_THAT(error(with(2, "fresh")), Contains("no case has stimuli of 'second'"));
}
