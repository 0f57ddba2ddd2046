// Coverage of what a component is given: in runs, over campaigns, and merged.
#include <map>

#include <nlohmann/json.hpp>

#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/cli/campaigns.h"
#include "tests/cli/course.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using nlohmann::ordered_json;

namespace {

const std::string kPoints =
    "<stride:Values name='input' signal='u' min='0' max='1' bins='4'/>"
    "<stride:Values signal='y' edges='0 0.5 1'/><stride:Cross of='input y'/>";

std::string coverage_of(const std::string& groups) {
  return "<stride:Coverage>\n" + groups + "\n</stride:Coverage>\n";
}

/// Two filters in a row, of which the second one's values are covered; and who listens to a ticker
/// that ticks each 0.1 s.
Parts covered_parts(const std::string& checks = "", const std::string& goal = "") {
  Parts parts = two_filters();
  parts.components += component("ticker", "ticker.fmu") + component("listener", "listener.fmu");
  parts.connections += connection("ticker.tick.clock", "listener.message.clock") +
                       connection("ticker.tick.number", "listener.message.number") +
                       connection("ticker.tick.picoseconds", "listener.message.picoseconds");
  parts.annotation = coverage_of("<stride:Group component='second'" + goal + ">" + kPoints +
                                 "</stride:Group>\n"
                                 "<stride:Group component='listener'>"
                                 "<stride:Words event='message.number' words='1 2 3 99'/>"
                                 "<stride:Gaps event='message.number' min='0.01' max='1'/>"
                                 "</stride:Group>");
  if (!checks.empty()) parts.annotation += "<stride:Checks>" + checks + "</stride:Checks>\n";
  return parts;
}

const Arguments kInputs{"--set", "first.u=1", "--set", "ticker.period=0.1"};

Arguments with_inputs(const Arguments& further) {
  Arguments arguments = kInputs;
  arguments.insert(arguments.end(), further.begin(), further.end());
  return arguments;
}

ordered_json coverage_in(const fs::path& folder) {
  return ordered_json::parse(read(folder / "coverage.json"));
}

/// "name count, ..." of the bins with a count.
std::string hits(const ordered_json& point) {
  std::string text;
  for (const auto& bin : point["bins"]) {
    if (bin["count"] == 0) continue;
    text += (text.empty() ? "" : ", ") + bin["name"].get<std::string>() + " " +
            std::to_string(bin["count"].get<int>());
  }
  return text;
}

}  // namespace

TEST_CASE("a run counts what it was declared to cover, and shows it") {
  const Workspace workspace(covered_parts());
  const Outcome outcome = workspace.run(kInputs);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out,
             Contains("\nCoverage\n") && Contains("  input × y ") && Contains(" coverage.json"));
  const ordered_json coverage = coverage_in(workspace / "out");
  CHECK(coverage["scenario"] == "test");
  const auto& points = coverage["groups"][0]["points"];
  CHECK(hits(points[0]) == "[0, 0.25) 1, [0.25, 0.5) 1, [0.5, 0.75) 1");
  CHECK(points[0]["percentage"] == 75);
  CHECK(hits(points[1]) == "[0, 0.5) 1");
  CHECK(hits(coverage["groups"][1]["points"][0]).find("1 1, 2 1, 3 1") == 0);
  CHECK(coverage["groups"][1]["points"][0]["percentage"] == 75);
  CHECK(hits(coverage["groups"][1]["points"][1]).find("[100 ms, 300 ms)") == 0);
  const auto run = run_json(workspace);
  CHECK(run["coverage"][0]["component"] == "second");
  CHECK(run["coverage"][0]["percentage"] == coverage["groups"][0]["percentage"]);
  CHECK(run["files"]["coverage"] == "coverage.json");
}

TEST_CASE("without coverage there is none, and --coverage adds automatic points") {
  const Workspace workspace(
      Parts{component("listener", "listener.fmu") + component("ticker", "ticker.fmu"),
            connection("ticker.tick.clock", "listener.message.clock") +
                connection("ticker.tick.number", "listener.message.number")});
  const Outcome without = workspace.run();
  CHECK(without.exit_code == 0);
  CHECK_THAT(without.out, !Contains("Coverage"));
  CHECK_FALSE(fs::exists(workspace / "out/coverage.json"));
  CHECK_FALSE(run_json(workspace).contains("coverage"));
  const Outcome outcome = workspace.run({"--coverage", "listener", "--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(coverage_in(workspace / "out")["groups"][0]["component"] == "listener");
  CHECK_THAT(input_error_of(workspace.run({"--coverage", "listner"})),
             Contains("--coverage listner") && Contains("did you mean 'listener'?"));
}

TEST_CASE("a check can demand coverage") {
  const Workspace workspace(
      covered_parts("<stride:Covered component='second' point='input' min='75'/>"
                    "<stride:Covered name='well' component='listener' min='90'/>"));
  const Outcome outcome = workspace.run(kInputs);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("second, input covered >= 75 %  passed") && Contains("well ") &&
                              Contains("FAILED"));
  CHECK_THAT(outcome.err, Contains("well: at 1 s:") && Contains("expected 90 % at least"));
  const auto checks = run_json(workspace)["checks"];
  CHECK(checks[0]["kind"] == "covered");
  CHECK(checks[0]["margin"]["unit"] == "percentage points");
  CHECK(workspace.run(with_inputs({"--no-checks"})).exit_code == 0);
  CHECK(workspace.run(with_inputs({"--no-coverage"})).exit_code == 0);
  CHECK_FALSE(fs::exists(workspace / "out/coverage.json"));
  const Outcome cut = workspace.run(with_inputs({"--stop", "0.05"}));
  CHECK(cut.exit_code == 0);
  CHECK_THAT(cut.out, Contains("undecided"));
  const Outcome checked = workspace.stride({"check", "test.ssd"});
  CHECK_THAT(checked.out, Contains("\nCoverage\n") && Contains("second, input covered >= 75 %") &&
                              Contains("input × y"));
}

TEST_CASE("threads, a resumed run and a branch count the same") {
  const Workspace workspace(covered_parts());
  workspace.scratch().write("futures.xml",
                            "<stride:Branches xmlns:stride=\"urn:org.stride:scenario:1\">\n"
                            "<stride:Branch name='same'/></stride:Branches>\n");
  REQUIRE(workspace.run(with_inputs({"--quiet"})).exit_code == 0);
  const ordered_json whole = coverage_in(workspace / "out");
  REQUIRE(workspace.run(with_inputs({"--quiet", "--threads", "3"})).exit_code == 0);
  CHECK(coverage_in(workspace / "out") == whole);
  REQUIRE(workspace.run(with_inputs({"--quiet", "--branch", "0.35:futures.xml"})).exit_code == 0);
  CHECK(coverage_in(workspace / "out/branches/same") == whole);
  for (const std::string instant : {"0", "0.05", "0.3", "0.7301"}) {
    INFO(instant);
    REQUIRE(workspace.run(with_inputs({"--quiet", "--checkpoint", instant})).exit_code == 0);
    const Outcome resumed = workspace.stride({"resume", "out", "--quiet", "--out", "again"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK(coverage_in(workspace / "again") == whole);
  }
}

TEST_CASE("a campaign's coverage is that of its cases, merged") {
  const Workspace workspace(covered_parts("", " goal='90'"));
  workspace.scratch().write("c.xosc", drawn_input("12", "<stride:Keep results='all'/>"));
  const Outcome outcome =
      workspace.stride({"campaign", "run", "c.xosc", "--out", "c", "--jobs", "2"});
  INFO(outcome.err << outcome.out);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err,
             Contains("its coverage of 'second' is") && Contains("below the goal of 90 %"));
  CHECK_THAT(outcome.out, Contains("Coverage of 'listener' is "));
  const ordered_json merged = coverage_in(workspace / "c");
  CHECK(merged["cases"] == 12);
  Arguments all{"coverage", "--out", "together.json"};
  for (int i = 0; i < 12; ++i) {
    all.push_back("c/cases/000/0000" + std::string(i < 10 ? "0" : "") + std::to_string(i));
  }
  const Outcome together = workspace.stride(all);
  INFO(together.err);
  REQUIRE(together.exit_code == 0);
  const ordered_json runs = ordered_json::parse(read(workspace / "together.json"));
  CHECK(runs["definition"] == merged["definition"]);
  for (std::size_t g = 0; g < 2; ++g) {
    const auto& points = merged["groups"][g]["points"];
    for (std::size_t p = 0; p < points.size(); ++p) {
      CHECK(hits(points[p]) == hits(runs["groups"][g]["points"][p]));
    }
    CHECK(merged["groups"][g]["percentage"] == runs["groups"][g]["percentage"]);
  }
  CHECK(merged["groups"][0]["points"][0]["bins"][0]["case"] == 0);
  const Csv table(workspace / "c/cases.csv");
  CHECK(read(workspace / "c/cases.csv").find(",coverage:second,coverage:listener,reached,") !=
        std::string::npos);
  REQUIRE(workspace.stride({"campaign", "status", "c"}).exit_code == 0);
  CHECK(coverage_in(workspace / "c") == merged);
}

TEST_CASE("coverage of another definition is beside the rest") {
  const Workspace workspace(covered_parts());
  Parts parts = covered_parts("", " goal='80'");
  const std::string edges = "edges='0 0.5 1'";
  parts.annotation.replace(parts.annotation.find(edges), edges.size(), "edges='0 0.25 1'");
  const Workspace other(parts);
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  REQUIRE(other.run({"--quiet"}).exit_code == 0);
  const std::string file = (other / "out/coverage.json").string();
  const Outcome merged = workspace.stride({"coverage", "out", file, "--out", "all.json"});
  INFO(merged.out << merged.err);
  CHECK(merged.exit_code == 0);
  CHECK_THAT(merged.out,
             Contains("  y@") && Contains("80 %") && Contains("\nNot alike in all runs\n") &&
                 Contains("1 of 2 runs: out/coverage.json") &&
                 Contains("others define it otherwise") && Contains("bin 1 is '[0, 0.") &&
                 Contains("a part of it is another one than in input × y@"));
  CHECK_THAT(merged.out, !Contains("input@"));
  const ordered_json all = ordered_json::parse(read(workspace / "all.json"));
  CHECK(all["runs"] == 2);
  CHECK(all["groups"][0]["points"].size() == 5);
  CHECK(all["told_apart"].size() == 4);
  const Outcome backwards = workspace.stride({"coverage", file, "out", "--out", "again.json"});
  CHECK(read(workspace / "again.json") == read(workspace / "all.json"));
  // what was merged is merged again
  CHECK(workspace.stride({"coverage", "all.json", "--ucis", "u.xml"}).out.find("Not alike") !=
        std::string::npos);
  CHECK_THAT(read(workspace / "u.xml"), Contains("comment=\"1 of 2 runs: bin 1 is "));
}

TEST_CASE("what stride coverage refuses") {
  const Workspace workspace(covered_parts());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK_THAT(input_error_of(workspace.stride({"coverage", "tmp"})),
             Contains("there is no coverage.json in this folder"));
  CHECK_THAT(input_error_of(workspace.stride({"coverage", "out", "--out", "out/coverage.json"})),
             Contains("a coverage that is read"));
  const Outcome missing = workspace.stride({"coverage", "out", "--missing"});
  CHECK_THAT(missing.out, Contains("\nNot covered\n") && Contains("[0.75, 1]"));
  std::string text = read(workspace / "out/coverage.json");
  const std::string bin = "[0.25, 0.5)";
  workspace.scratch().write("other.json", text.replace(text.find(bin), bin.size(), "x"));
  CHECK_THAT(input_error_of(workspace.stride({"coverage", "out", "other.json"})),
             Contains("other.json: 'second', point 'input': both have the definition"));
}

namespace {

/// The filter, with a range of its output.
void write_ranged_filter(const Workspace& workspace, const std::string& folder,
                         const std::string& range) {
  const stride::importer::UnpackedFmu unpacked(unit_folder() / "minimal.fmu");
  fs::copy(unpacked.folder(), workspace / folder, fs::copy_options::recursive);
  std::string text = read(unpacked.folder() / "modelDescription.xml");
  const std::size_t output = text.find("name=\"y\"");
  workspace.scratch().write(folder + "/modelDescription.xml", text.insert(output, range + " "));
}

/// By the points, without the cases that the bins are from.
std::map<std::string, std::string> points_of(ordered_json coverage) {
  std::map<std::string, std::string> points;
  for (auto& point : coverage["groups"][0]["points"]) {
    for (auto& bin : point["bins"]) {
      bin.erase("case");
      bin.erase("first");
    }
    point.erase("first_case");
    const std::string name = point["name"].get<std::string>() + point["definition"].dump();
    points[name] = point.dump();
  }
  return points;
}

}  // namespace

TEST_CASE("where units are others, a campaign's coverage is merged point by point") {
  const Workspace workspace(
      Parts{component("first", "minimal.fmu") + component("second", "usual"),
            connection("first.y", "second.u"),
            coverage_of("<stride:Group component='second'>"
                        "<stride:Values name='in' signal='u' edges='0 0.5 1'/>"
                        "<stride:Values name='out' signal='y' bins='2'/></stride:Group>")});
  write_ranged_filter(workspace, "usual", "min=\"0\" max=\"0.25\"");
  write_ranged_filter(workspace, "wide", "min=\"0\" max=\"1\"");
  workspace.scratch().write(
      "c.xosc",
      campaign_text(
          deterministic(value_set("first.u", {"0.5", "1"}) + value_set("kind", {"usual", "wide"})),
          "<stride:Swap name='kind' component='second'><stride:Unit name='usual'/>"
          "<stride:Unit name='wide' file='wide'/></stride:Swap>"
          "<stride:Keep results='all'/><stride:Capture component='second'/>",
          "test.ssd"));
  const Outcome outcome = workspace.stride({"campaign", "run", "c.xosc", "--out", "c"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("\nNot alike in all runs\n") && !Contains("not counted") &&
                              Contains("2 of 4 cases, from case ") &&
                              Contains("bin 1 is '[0, 0.5)', and '[0, 0.125)' in out@"));
  const ordered_json merged = coverage_in(workspace / "c");
  CHECK(merged["cases"] == 4);
  CHECK(merged["groups"][0]["points"].size() == 3);
  Arguments all{"coverage", "--out", "together.json"};
  for (int i = 0; i < 4; ++i) all.push_back("c/cases/000/00000" + std::to_string(i));
  REQUIRE(workspace.stride(all).exit_code == 0);
  const ordered_json runs = ordered_json::parse(read(workspace / "together.json"));
  CHECK(points_of(runs) == points_of(merged));
  CHECK(runs["groups"][0]["percentage"] == merged["groups"][0]["percentage"]);
  const std::string table = read(workspace / "c/cases.csv");
  CHECK(table.find(",,0,") == std::string::npos);
  CHECK_THAT(read(workspace / "c/campaign.html"), Contains("told_apart"));
  const Outcome distilled =
      workspace.stride({"campaign", "distil", "c", "--component", "second", "-o", "suite"});
  INFO(distilled.out << distilled.err);
  CHECK(distilled.exit_code == 0);
  CHECK_THAT(distilled.out, Contains("out@"));
}

TEST_CASE("coverage is written for other tools, and never over what is read") {
  const Workspace workspace(covered_parts());
  REQUIRE(workspace.run(with_inputs({"--quiet"})).exit_code == 0);
  REQUIRE(workspace.stride({"coverage", "out", "--ucis", "ucis.xml"}).exit_code == 0);
  CHECK_THAT(read(workspace / "ucis.xml"), Contains("<UCIS ucisVersion=\"1.0\"") &&
                                               Contains("physicalName=\"out/coverage.json\"") &&
                                               Contains("<coverpoint name=\"input\"") &&
                                               Contains("<cross name=\"input × y\""));
  CHECK_THAT(input_error_of(workspace.stride({"coverage", "out", "./out/coverage.json"})),
             Contains("this is out/coverage.json, too, and would count twice"));
  const Outcome over = workspace.stride({"coverage", "out", "--ucis", "out/coverage.json"});
  CHECK_THAT(input_error_of(over), Contains("--ucis out/coverage.json"));
  CHECK(coverage_in(workspace / "out")["scenario"] == "test");
}
