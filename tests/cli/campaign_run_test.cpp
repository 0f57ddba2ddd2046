// stride campaign run and status, from outside.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <initializer_list>
#include <list>
#include <random>
#include <sstream>
#include <thread>
#include <utility>

#include <sys/mount.h>

#include "tests/build.h"
#include "tests/cli/campaigns.h"
#include "tests/cli/course.h"
#include "tests/cli/leftovers.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

using namespace std::chrono_literals;

std::string campaign(const std::string& runs, const std::string& extension = "") {
  return drawn_input(runs,
                     "<stride:Aggregate name='last' signal='second.y' function='final'/>"
                     "<stride:Aggregate name='mean' signal='first.y' function='mean'/>" +
                         extension);
}

const char* const kKeepNone = "<stride:Keep results='none'/>";

/// Cases of a unit that does one of these things at 0.5 s.
std::string faults(std::initializer_list<const char*> names, const std::string& extension) {
  return campaign_text(deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.5"}) +
                                     value_set("c.fault", names)),
                       extension, "test.ssd");
}

/// A folder with a scenario and the campaign c.xosc.
struct CampaignRuns : Workspace {
  explicit CampaignRuns(const std::string& text, const Parts& parts = checked_filters())
      : Workspace(parts) {
    scratch().write("c.xosc", text);
  }

  static Arguments arguments(const std::string& out, const Arguments& further = {}) {
    Arguments made{"campaign", "run", "c.xosc", "--quiet", "--out", out};
    made.insert(made.end(), further.begin(), further.end());
    return made;
  }
  Outcome campaign(const std::string& out, const Arguments& further = {}) const {
    return stride(arguments(out, further));
  }
  std::string file(const std::string& name) const { return read(scratch() / name); }
  std::string table(const std::string& out) const {
    return without_wall_times(file(out + "/cases.csv"));
  }
  /// The row of a case, as fields.
  nlohmann::json line(const std::string& out, std::size_t index) const {
    std::istringstream lines(file(out + "/cases.jsonl"));
    std::string text;
    for (std::size_t i = 0; i <= index; ++i) std::getline(lines, text);
    return nlohmann::json::parse(text);
  }
  /// The results of failed cases are kept.
  void check_row(std::size_t index, const std::string& outcome, const std::string& reason) const {
    const nlohmann::json row = line("out", index);
    INFO(row);
    CHECK(row["outcome"] == outcome);
    CHECK_THAT(row["reason"].get<std::string>(), Contains(reason));
    CHECK(row["results"] == (outcome != "passed"));
  }
  /// Those of the first cases: their outcomes and reasons.
  void check_rows(std::initializer_list<std::pair<const char*, const char*>> rows) const {
    std::size_t index = 0;
    for (const auto& [outcome, reason] : rows) check_row(index++, outcome, reason);
  }
};

}  // namespace

TEST_CASE("a table has a row for each case, whatever the number of jobs") {
  const CampaignRuns space(campaign("20", kKeepNone));
  const Outcome outcome = space.campaign("one", {"--jobs", "1"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.out == "");
  CHECK_THAT(outcome.err, Contains("of 20 cases have not passed"));
  const std::string table = space.table("one");
  CHECK(std::count(table.begin(), table.end(), '\n') == 21);
  CHECK(table.substr(0, table.find('\n')) ==
        "case,first.u,seed,outcome,reason,check:bounded,margin:bounded,aggregate:last,aggregate:"
        "mean,reached,hash");
  CHECK_THAT(table, Contains(",passed,,passed,") && Contains(",failed,bounded: at "));
  CHECK(space.campaign("three", {"--jobs", "3"}).exit_code == 1);
  CHECK(space.table("three") == table);
  CHECK(space.left_behind().empty());
  CHECK_FALSE(fs::exists(space / "one/running"));
  CHECK_FALSE(fs::exists(space / "one/cases/000/000000"));

  const std::string value = space.line("one", 7)["values"]["first.u"];
  space.run({"--quiet", "--set", "first.u=" + value});
  const Csv signals = space.signals();
  CHECK(std::to_string(double(space.line("one", 7)["aggregates"]["last"])) ==
        std::to_string(std::stod(signals.row(signals.size() - 1).back())));
}

TEST_CASE("cases of a campaign may run in any order and in processes side by side") {
  const CampaignRuns space(campaign("8", kKeepNone));
  CHECK(space.campaign("all").exit_code == 1);
  std::list<Process> processes;
  for (const char* index : {"5", "0", "7", "3", "1", "6", "2", "4"}) {
    processes.emplace_back(stride_command(CampaignRuns::arguments("side", {"--case", index})),
                           space.scratch().path());
  }
  for (Process& process : processes) {
    const Outcome outcome = process.wait();
    INFO(outcome.err);
    CHECK((outcome.exit_code == 0 || outcome.err.find("failed: bounded") != std::string::npos));
  }
  CHECK(records_in(space / "side") == 8);
  CHECK_FALSE(fs::exists(space / "side/cases.csv"));
  const Outcome status = space.stride({"campaign", "status", "side"});
  INFO(status.err);
  CHECK(status.exit_code == 0);
  CHECK(space.table("side") == space.table("all"));
  CHECK(fs::exists(space / "side/plan.csv"));
  CHECK_FALSE(fs::exists(space / "side/running"));
}

TEST_CASE("ranges of cases may run side by side, and leave out what is done") {
  const CampaignRuns space(campaign("12", kKeepNone));
  CHECK(space.campaign("all").exit_code == 1);
  std::list<Process> processes;
  for (const char* range : {"6-11", "0-5", "4-7"}) {
    processes.emplace_back(
        stride_command(CampaignRuns::arguments("side", {"--cases", range, "--jobs", "2"})),
        space.scratch().path());
  }
  for (Process& process : processes) {
    const Outcome outcome = process.wait();
    INFO(outcome.err);
    CHECK((outcome.exit_code == 0 || outcome.err.find("not passed") != std::string::npos));
  }
  CHECK(records_in(space / "side") == 12);
  CHECK_FALSE(fs::exists(space / "side/cases.csv"));
  CHECK(space.stride({"campaign", "status", "side"}).exit_code == 0);
  CHECK(space.table("side") == space.table("all"));
  CHECK_FALSE(fs::exists(space / "side/running"));

  fs::remove(space / "side/cases/000/000003.json");
  const auto before = fs::last_write_time(space / "side/cases/000/000004.json");
  const Outcome again = space.stride(
      {"campaign", "run", "c.xosc", "--out", "side", "--cases", "3-4", "--progress", "none"});
  CHECK_THAT(again.out, Contains("cases 3-4: ") && Contains(", 0 missing"));
  CHECK(records_in(space / "side") == 12);
  CHECK(fs::last_write_time(space / "side/cases/000/000004.json") == before);
}

TEST_CASE("a campaign that is killed at any instant goes on where it was") {
  const CampaignRuns space(campaign("30", "<stride:Keep results='failed' every='7'/>"));
  CHECK(space.campaign("whole").exit_code == 1);
  const Leftovers leftovers;
  std::mt19937 random(1);
  std::size_t before = 0;
  for (int i = 0; i < 20; ++i) {
    Process process(stride_command(CampaignRuns::arguments("killed")), space.scratch().path());
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
    process.send(SIGKILL);
    process.wait();
    CHECK(leftovers.after_a_while().empty());
    const std::size_t now = records_in(space / "killed");
    CHECK(now >= before);
    before = now;
  }
  const auto time_of = [&](int index) {
    const fs::path file = space / ("killed/cases/000/00000" + std::to_string(index) + ".json");
    return fs::exists(file) ? fs::last_write_time(file) : fs::file_time_type{};
  };
  const auto first = time_of(0);
  CHECK(space.campaign("killed").exit_code == 1);
  CHECK(space.table("killed") == space.table("whole"));
  if (first != fs::file_time_type{}) CHECK(time_of(0) == first);
  CHECK_FALSE(fs::exists(space / "killed/running"));
  for (int i = 0; i < 30; ++i) {
    const std::string name = (i < 10 ? "00000" : "0000") + std::to_string(i);
    const bool is_kept = i % 7 == 0 || space.line("whole", i)["outcome"] != "passed";
    for (const char* out : {"whole", "killed"}) {
      const fs::path results = space / out / ("cases/000/" + name);
      INFO(results);
      CHECK(fs::exists(results / "run.json") == is_kept);
      CHECK(space.line(out, i)["results"] == is_kept);
    }
    if (!is_kept) continue;
    const std::string place = "/cases/000/" + name + "/signals.csv";
    CHECK(space.file("whole" + place) == space.file("killed" + place));
  }
}

TEST_CASE("whatever a case does is a row, and the others go on") {
  const CampaignRuns space(faults({"", "segfault", "sleep", "exit with 0", "kill", "abort"},
                                  "<stride:Limit wallTime='4'/><stride:Keep results='failed'/>"),
                           {component("c", "faulty.fmu"), ""});
  const Outcome outcome = space.campaign("out", {"--junit", "junit.xml"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("5 of 6 cases have not passed"));
  space.check_rows({{"passed", ""},
                    {"crashed", "unit 'c'"},
                    {"timed out", "it took longer than 4 s of wall time"},
                    {"crashed", "unit 'c'"},
                    {"crashed", "SIGKILL"},
                    {"crashed", "unit 'c'"}});
  for (const int index : {1, 2, 3, 4, 5}) {
    const std::string results = "out/cases/000/00000" + std::to_string(index);
    const nlohmann::json run = nlohmann::json::parse(space.file(results + "/run.json"));
    INFO(index);
    CHECK(run["outcome"] == "failed");
  }
  const std::string junit = space.file("junit.xml");
  CHECK_THAT(junit, Contains("tests=\"6\" failures=\"0\" errors=\"5\" skipped=\"0\"") &&
                        Contains("<testcase name=\"case 2\" classname=\"c\"") &&
                        Contains("stride run test.ssd --set c.call=step"));
  CHECK(space.left_behind().empty());
}

TEST_CASE("what a case does to its parent, or leaves behind, is no matter of other cases") {
  const Leftovers leftovers;
  const CampaignRuns space(
      faults({"limit parent", "kill parent", "daemon", "become daemon", "be traced and crash", ""},
             "<stride:Keep results='failed'/>"),
      {component("c", "faulty.fmu"), ""});
  const Outcome outcome = space.campaign("out");
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  space.check_rows({{"crashed", "was ended or limited"},
                    {"crashed", "was ended or limited"},
                    {"passed", ""},
                    {"crashed", "its process ended with the exit code 0"},
                    {"crashed", "unit 'c'"},
                    {"passed", ""}});
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("likewise from a common beginning on") {
  const Leftovers leftovers;
  const CampaignRuns space(
      campaign_text(deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.5"}) +
                                  value_set("c.fault", {"limit parent", "kill parent", "daemon"}) +
                                  value_set("late.value", {"0.25", "0.75"})),
                    "<stride:Intervention name='late'><stride:Set variable='other.u' value='0' "
                    "at='0.25'/></stride:Intervention><stride:Keep results='failed'/>",
                    "test.ssd"),
      {component("c", "faulty.fmu") + component("other", "minimal.fmu"), ""});
  const Outcome outcome = space.campaign("out");
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  space.check_rows({{"crashed", "was ended or limited"},
                    {"crashed", "was ended or limited"},
                    {"crashed", "was ended or limited"},
                    {"crashed", "was ended or limited"},
                    {"passed", ""},
                    {"passed", ""}});
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("what is done to a parent in a common beginning is what is done alone") {
  const CampaignRuns space(
      campaign_text(deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.25"}) +
                                  value_set("c.fault", {"limit parent", ""}) +
                                  value_set("late.value", {"0.25", "0.75"})),
                    "<stride:Intervention name='late'><stride:Set variable='other.u' value='0' "
                    "at='0.5'/></stride:Intervention><stride:Keep results='failed'/>",
                    "test.ssd"),
      {component("c", "faulty.fmu") + component("other", "minimal.fmu"), ""});
  CHECK(space.campaign("out").exit_code == 1);
  space.check_rows({{"crashed", "was ended or limited"},
                    {"crashed", "was ended or limited"},
                    {"passed", ""},
                    {"passed", ""}});
}

TEST_CASE("a case that exhausts the memory is a row, and the others go on") {
  if (kSanitized) return;  // AddressSanitizer needs memory of its own without end
  const CampaignRuns space(faults({"allocate", ""}, "<stride:Keep results='failed'/>"),
                           {component("c", "faulty.fmu"), ""});
  Process process({"sh", "-c",
                   "ulimit -v 800000; exec '" + stride_command({}).front() +
                       "' campaign run c.xosc --quiet --out out"},
                  space.scratch().path());
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  space.check_rows({{"error", "bad_alloc"}, {"passed", ""}});
}

namespace {

/// Combinations of two start values with interventions at 0.5 s or later, of which some fail.
std::string late_interventions(const std::string& extension) {
  return campaign_text(
      deterministic(value_set("first.u", {"0.25", "0.5"}) +
                    value_set("wire.from", {"0.75", "0.5"}) +
                    value_set("wire.value", {"0", "0.5", "9"})),
      "<stride:Aggregate name='last' signal='second.y' function='final'/>"
      "<stride:Aggregate name='mean' signal='second.y' function='mean'/>"
      "<stride:Intervention name='wire'><stride:Force variable='second.u' value='0' from='0.5'/>"
      "</stride:Intervention>" +
          extension,
      "test.ssd");
}

Parts checked_second() {
  Parts parts = two_filters();
  parts.annotation =
      "<stride:Checks><stride:Always name='bounded' signal='second.y' max='1'/></stride:Checks>\n"
      "<stride:Coverage><stride:Group component='second'>"
      "<stride:Values name='in' signal='u' edges='0 0.1 0.2 0.3 0.5 1 9'/>"
      "<stride:Values name='out' signal='y' edges='0 0.1 0.2 0.5 1 9'/>"
      "<stride:Cross of='in out'/></stride:Group></stride:Coverage>\n";
  return parts;
}

}  // namespace

TEST_CASE("cases that share a beginning are what they are alone") {
  const std::string keep =
      GENERATE(as<std::string>(), "<stride:Keep results='failed'/>", "<stride:Keep results='all'/>",
               "<stride:Keep results='none' every='5'/>");
  CAPTURE(keep);
  const CampaignRuns space(late_interventions(keep), checked_second());
  const Outcome outcome = space.campaign("together", {"--junit", "junit.xml"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  for (int i = 0; i < 12; ++i) {
    space.campaign("alone", {"--case", std::to_string(i)});
  }
  CHECK(records_in(space / "alone") == 12);
  CHECK(space.stride({"campaign", "status", "alone"}).exit_code == 0);
  CHECK_THAT(outcome.err, Contains("of 12 cases have not passed"));
  CHECK(space.table("together") == space.table("alone"));
  CHECK_THAT(space.table("alone"), Contains(",coverage:second,"));
  CHECK(space.file("together/coverage.json") == space.file("alone/coverage.json"));
  for (int i = 0; i < 12; ++i) {
    const fs::path results = "cases/000/0000" + std::string(i < 10 ? "0" : "") + std::to_string(i);
    const bool is_kept = fs::exists(space / "alone" / results);
    CHECK(fs::exists(space / "together" / results) == is_kept);
    if (is_kept) check_same_results(space / "alone" / results, space / "together" / results);
  }
  CHECK_FALSE(fs::exists(space / "together/running"));
  CHECK(space.left_behind().empty());
}

TEST_CASE("a beginning that fails, or a rest that does, is a row for each case") {
  const std::string fault = GENERATE("segfault", "sleep");
  CAPTURE(fault);
  const std::string failed = fault == "sleep" ? "timed out" : "crashed";
  const auto rows = [&](const std::string& at) {
    const CampaignRuns space(
        campaign_text(
            deterministic(value_set("c.call", {"step"}) + value_set("c.fault", {fault.c_str()}) +
                          value_set("c.at", {at.c_str()}) +
                          value_set("late.value", {"2", "0.75", "3"})),
            "<stride:Intervention name='late'><stride:Set variable='c.at' value='2' at='0.5'/>"
            "</stride:Intervention><stride:Limit wallTime='2'/>" +
                std::string(kKeepNone),
            "test.ssd"),
        {component("c", "faulty.fmu"), ""});
    const Leftovers leftovers;
    const Outcome outcome = space.campaign("out", {"--jobs", "2"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
    CHECK(leftovers.after_a_while().empty());
    std::vector<std::string> outcomes;
    for (int i = 0; i < 3; ++i) outcomes.push_back(space.line("out", i)["outcome"]);
    return outcomes;
  };
  CHECK(rows("2") == std::vector<std::string>{"passed", failed, "passed"});
  CHECK(rows("0.25") == std::vector<std::string>{failed, failed, failed});
}

TEST_CASE("what somebody removes while a campaign runs is no outcome of a case") {
  const CampaignRuns space(campaign("200", kKeepNone));
  REQUIRE(space.campaign("whole").exit_code == 1);
  Process process(stride_command(CampaignRuns::arguments("out")), space.scratch().path());
  while (process.is_running() && records_in(space / "out") == 0) std::this_thread::sleep_for(1ms);
  fs::rename(space / "test.ssd", space / "elsewhere.ssd");
  std::error_code also_removed;  // the campaign removes its own at the same time
  do {
    fs::remove_all(space / "tmp", also_removed);
  } while (also_removed);
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("is not what it was when the campaign began, so case "));
  CHECK(records_in(space / "out") < 200);

  fs::rename(space / "elsewhere.ssd", space / "test.ssd");
  fs::create_directory(space / "tmp");
  CHECK(space.campaign("out").exit_code == 1);
  CHECK(space.table("out") == space.table("whole"));
}

TEST_CASE("a library that changes while a campaign runs is no outcome of a case") {
  const CampaignRuns space(campaign("200", kKeepNone));
  REQUIRE(space.campaign("whole").exit_code == 1);
  Process process(stride_command(CampaignRuns::arguments("out")), space.scratch().path());
  while (process.is_running() && records_in(space / "out") == 0) std::this_thread::sleep_for(1ms);
  for (const auto& entry : fs::recursive_directory_iterator(space / "tmp")) {
    if (entry.path().extension() == ".so") fs::resize_file(entry.path(), 100);
  }
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains(".so' is not what it was when the campaign began, so case "));
  CHECK(space.campaign("out").exit_code == 1);
  CHECK(space.table("out") == space.table("whole"));
}

TEST_CASE("too few open files end a campaign, and are no outcome of a case") {
  const CampaignRuns space(campaign("5", "<stride:Keep results='failed'/>"), two_filters());
  Process process({"sh", "-c",
                   "ulimit -n 24; exec '" + stride_command({}).front() +
                       "' campaign run c.xosc --quiet --out out"},
                  space.scratch().path());
  const Outcome few = process.wait();
  CHECK(few.exit_code == 1);
  CHECK_THAT(few.err, Contains("a process may have 24 open files here, so case 0 is not done: ") &&
                          Contains("hint: raise the limit (ulimit -n 1024)"));
  CHECK(records_in(space / "out") == 0);
  CHECK(space.campaign("out").exit_code == 0);
}

TEST_CASE("a campaign that is interrupted says how it goes on") {
  const CampaignRuns space(faults({"", "sleep", "loop"}, kKeepNone),
                           {component("c", "faulty.fmu"), ""});
  const int signal = GENERATE(SIGTERM, SIGINT);
  const Leftovers leftovers;
  Process process(stride_command(CampaignRuns::arguments("out")), space.scratch().path());
  while (process.is_running() && records_in(space / "out") == 0) std::this_thread::sleep_for(5ms);
  std::this_thread::sleep_for(200ms);
  process.send(signal);
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the campaign was interrupted; 1 of 3 cases are done") &&
                              Contains("it goes on with: stride campaign run out"));
  CHECK(space.line("out", 0)["outcome"] == "passed");
  CHECK(space.line("out", 1)["outcome"] == "missing");
  CHECK(leftovers.after_a_while().empty());
  CHECK_FALSE(fs::exists(space / "out/running"));
  const Outcome status = space.stride({"campaign", "status", "out"});
  CHECK(status.exit_code == 0);
  CHECK_THAT(status.out, Contains("c: 1 of 3 cases done, 1 passed, 0 failed, 2 missing"));
}

TEST_CASE("a case whose processes all end together has no outcome, whichever ends first") {
  Parts parts = checked_filters();
  parts.annotation += "<stride:Host components='second'/>";
  const CampaignRuns space(campaign("30", kKeepNone), parts);
  const Leftovers leftovers;
  std::mt19937 random(1);
  for (int i = 0; i < 12; ++i) {
    const std::string out = "out" + std::to_string(i);
    Process process(stride_command(CampaignRuns::arguments(out, {"--cases", "0-29"})),
                    space.scratch().path());
    while (process.is_running() && records_in(space / out) == 0) std::this_thread::sleep_for(5ms);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 40));
    std::vector<pid_t> processes = leftovers.processes();
    std::sort(processes.rbegin(), processes.rend());
    for (const pid_t id : processes) ::kill(id, SIGTERM);
    CHECK(process.wait().exit_code != 0);
    CHECK(space.stride({"campaign", "status", out}).exit_code == 0);
    for (std::size_t index = 0; index < 30; ++index) {
      const std::string outcome = space.line(out, index)["outcome"];
      INFO(space.line(out, index));
      CHECK((outcome == "passed" || outcome == "failed" || outcome == "missing"));
    }
  }
}

TEST_CASE("a campaign whose cases pass is good, and status repeats the failures") {
  const CampaignRuns space(campaign("5"), two_filters());
  const Outcome good = space.stride({"campaign", "run", "c.xosc", "--progress", "json"});
  INFO(good.err);
  CHECK(good.exit_code == 0);
  CHECK_THAT(good.out, Contains("c: 5 of 5 cases done, 5 passed, 0 failed, 0 missing") &&
                           Contains("Table in campaigns/c: cases.csv cases.jsonl"));
  CHECK_THAT(good.err, Contains("\"done\":5") && Contains("\"outcome\":\"completed\""));
  CHECK(space.stride({"campaign", "run", "campaigns/c"}).exit_code == 0);

  const CampaignRuns bad(campaign("20", kKeepNone));
  REQUIRE(bad.campaign("out").exit_code == 1);
  const Outcome status = bad.stride({"campaign", "status", "c.xosc", "--out", "out"});
  CHECK(status.exit_code == 0);
  CHECK_THAT(status.out, Contains("failed   bounded: at ") &&
                             Contains(": stride run test.ssd --set first.u=1."));
}

TEST_CASE("what campaign run refuses") {
  const CampaignRuns space(campaign("5", kKeepNone), two_filters());
  REQUIRE(space.campaign("out").exit_code == 0);
  CHECK_THAT(input_error_of(space.campaign("out", {"--case", "5"})),
             Contains("--case 5: the campaign has 5 cases, the last one is 4"));
  CHECK_THAT(input_error_of(space.campaign("out", {"--cases", "3-5"})),
             Contains("--cases 5: the campaign has 5 cases, the last one is 4"));
  for (const char* index : {"-1", "1e3", "99999999999999999999"}) {
    for (const char* verb : {"run", "plan"}) {
      const Outcome outcome = space.stride({"campaign", verb, "c.xosc", "--case", index});
      CHECK(outcome.exit_code == 2);
      CHECK_THAT(outcome.err, Contains("--case: '" + std::string(index) + "' is no whole number"));
    }
  }
  for (const char* range : {"4-3", "a", "1-"}) {
    const Outcome outcome = space.campaign("out", {"--cases", range});
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains("is not as 20-29"));
  }
  CHECK_THAT(input_error_of(space.stride({"campaign", "status", "c.xosc"})),
             Contains("campaigns/c: there is no plan in this folder"));
  CHECK_THAT(input_error_of(space.stride({"campaign", "run", "out", "--out", "other"})),
             Contains("out: this is the folder of a campaign, so --out cannot name another one"));
  CHECK_THAT(input_error_of(space.stride({"campaign", "run", "tmp"})),
             Contains("tmp: there is no plan in this folder"));
  for (const char* const file : {"c.xosc", "test.ssd", "out/plan.csv", "out/campaign.json",
                                 "out/cases.csv", "out/cases/000/000001.json"}) {
    const std::string before = space.file(file);
    CHECK_THAT(input_error_of(space.campaign("out", {"--junit", file})), Contains("--junit "));
    CHECK(space.file(file) == before);
  }
  space.scratch().write("c.xosc", campaign("6", kKeepNone));
  CHECK_THAT(input_error_of(space.campaign("out")),
             Contains("out: this folder belongs to another plan"));
  CHECK_THAT(input_error_of(space.campaign("out", {"--case", "1"})),
             Contains("out: this folder belongs to another plan"));
  space.scratch().write("c.xosc", campaign("x"));
  CHECK(space.campaign("out").exit_code == 2);
}

TEST_CASE("half a record is none") {
  const CampaignRuns space(campaign("3", kKeepNone), two_filters());
  REQUIRE(space.campaign("out").exit_code == 0);
  const std::string table = space.table("out");
  const std::string record = "out/cases/000/000001.json";
  space.scratch().write(record, space.file(record).substr(0, 100));
  space.scratch().write("out/cases/000/000002.json", space.file("out/cases/000/000000.json"));
  CHECK(space.campaign("out").exit_code == 0);
  CHECK(space.table("out") == table);
}

TEST_CASE("a full disk ends a campaign, and is the end of no case") {
  const CampaignRuns space(campaign("3", "<stride:Keep results='all'/>"), two_filters());
  const char* const size = GENERATE("size=64k", "size=300k");  // not even records; no reports
  CAPTURE(size);
  fs::create_directory(space / "out");
  if (::mount("tmpfs", (space / "out").c_str(), "tmpfs", 0, size) != 0) {
    WARN("SKIPPED: no file system can be mounted: " << std::strerror(errno));
    return;
  }
  const Outcome full = space.campaign("out", {"--jobs", "1"});
  CHECK(records_in(space / "out") < 3);
  CHECK(full.exit_code == 1);
  CHECK_THAT(full.err, Contains("disk") || Contains("No space left"));
  REQUIRE(::mount("tmpfs", (space / "out").c_str(), "tmpfs", MS_REMOUNT, "size=20m") == 0);
  const Outcome outcome = space.campaign("out");
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(fs::exists(space / "out/cases/000/000002/report.html"));
  ::umount2((space / "out").c_str(), MNT_DETACH);
}

TEST_CASE("what a campaign varies may hold a '=' in its name") {
  const Workspace workspace(Parts{component("a=b", "gain.fmu")});
  workspace.scratch().write(
      "c.xosc", campaign_text(deterministic(value_set("a=b.k=1", {"2", "3"})), "", "test.ssd"));
  REQUIRE(workspace.stride({"campaign", "run", "c.xosc", "--quiet"}).exit_code == 0);
  const std::string table = read(workspace / "campaigns/c/cases.csv");
  CHECK_THAT(table, Contains("a=b.k=1"));
  const Outcome planned = workspace.stride({"campaign", "plan", "c.xosc", "--case", "1"});
  CHECK_THAT(planned.out, Contains("a=b.k=1=3"));
  const Outcome swapped =
      workspace.stride({"run", "test.ssd", "--set", "a=b.k=1=3", "--quiet", "--out", "out"});
  CHECK(swapped.exit_code == 0);
  CHECK(workspace.signals().numbers("a=b.c=d").back() == 3);
}
