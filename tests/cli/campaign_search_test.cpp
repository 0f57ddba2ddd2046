// stride campaign search, from outside.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <initializer_list>
#include <list>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/build.h"
#include "tests/cli/leftovers.h"
#include "tests/cli/searches.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

using namespace std::chrono_literals;

/// How many cases a search has run, of so many at most; and whether it has found a failure.
struct SearchLength {
  std::size_t cases = 0;
  bool has_found = false;
};

SearchLength length_of(const Searches& space, const std::string& method, int seed,
                       const std::string& runs) {
  const std::string out = method + std::to_string(seed);
  const Outcome outcome =
      space.search(out, {"--method", method, "--seed", std::to_string(seed), "--runs", runs});
  INFO(outcome.err);
  const bool has_found = outcome.err.find("1 failure found") != std::string::npos;
  CHECK(outcome.exit_code == (has_found ? 1 : 0));
  return {records_in(space / out), has_found};
}

/// A search of another kind in the same folder.
void check_refused(const Searches& space, const Arguments& further, const std::string& why) {
  const Outcome outcome = space.search("out", further);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains(why));
}

/// Of some cases.
void check_part(const Outcome& outcome, int exit_code, const std::string& why) {
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == exit_code);
  CHECK_THAT(outcome.err, Contains(why));
}

}  // namespace

TEST_CASE("a search finds a planted failure in fewer runs than random points, over 20 seeds") {
  const Searches space;
  const int seeds = kSanitized ? 2 : 20, random_seeds = kSanitized ? 1 : 3;
  std::size_t searched = 0, random = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const SearchLength length = length_of(space, "cma-es", seed, "120");
    CHECK(length.has_found);
    searched += length.cases;
  }
  for (int seed = 1; seed <= random_seeds; ++seed) {
    random += length_of(space, "random", seed, "120").cases;
  }
  CHECK(3 * searched * random_seeds < random * seeds);
}

TEST_CASE("a search says what it has found, and how to repeat it") {
  const Searches space(planted_campaign(""));
  const Outcome outcome = space.search("out", {"--seed", "2"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("c: 1 failure found in 17 cases by cma-es, seed 2\n") &&
                              Contains("bounded    ") && Contains("first.time_constant [s]  ") &&
                              Contains("Table in out: cases.csv cases.jsonl search.json"));
  CHECK_THAT(outcome.err, Contains("1 failure found, the first one in case ") &&
                              Contains(": bounded") &&
                              Contains("stride campaign shrink out --case "));
  const std::string repeated = ": stride run test.ssd";
  const std::size_t at = outcome.out.find(repeated);
  REQUIRE(at != std::string::npos);
  const std::string options =
      outcome.out.substr(at + repeated.size(), outcome.out.find('\n', at) - at - repeated.size());
  Process process({"sh", "-c", "'" + stride_command({}).front() + "' run test.ssd -q" + options},
                  space.scratch().path());
  const Outcome again = process.wait();
  CHECK(again.exit_code == 1);
  CHECK_THAT(again.err, Contains("has failed by 1 of 1 verdict"));
}

TEST_CASE("a search without a failure names the least margins, and passes") {
  const Searches space;
  const Outcome outcome = space.search("out", {"--runs", "10"});
  INFO(outcome.out);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, Contains("c: no failure found in 10 cases by cma-es, seed 1\n") &&
                              Contains("bounded              0.7") && Contains("Repeated by"));
  const std::string table = space.table("out");
  CHECK(std::count(table.begin(), table.end(), '\n') == 11);
  CHECK_THAT(table, Contains("\n0,,,,"));
  CHECK_FALSE(fs::exists(space / "out/running"));
}

TEST_CASE("a search is the same whatever the number of jobs, and goes on with more runs") {
  const Searches space;
  const Arguments whole{"--all", "--runs", "90", "--jobs"};
  const auto with = [&](const std::string& jobs) {
    Arguments made = whole;
    made.push_back(jobs);
    return made;
  };
  const Outcome one = space.search("one", with("1"));
  const Outcome three = space.search("three", with("3"));
  CHECK(one.exit_code == 1);
  CHECK(space.table("one") == space.table("three"));
  CHECK(space.file("one/search.json") == space.file("three/search.json"));
  CHECK(one.out.substr(0, one.out.find("Table in")) ==
        three.out.substr(0, three.out.find("Table in")));

  CHECK(space.search("part", {"--runs", "13"}).exit_code == 0);
  CHECK(records_in(space / "part") == 13);
  const auto before = fs::last_write_time(space / "part/cases/000/000012.json");
  CHECK(space.search("part", with("2")).exit_code == 1);
  CHECK(space.table("part") == space.table("one"));
  CHECK(fs::last_write_time(space / "part/cases/000/000012.json") == before);
}

TEST_CASE("a search that is killed at any instant goes on where it was") {
  const Searches space;
  const Arguments request{"--all", "--runs", "60"};
  CHECK(space.search("whole", request).exit_code == 1);
  const Leftovers leftovers;
  std::mt19937 random(1);
  for (int i = 0; i < 12; ++i) {
    Process process(stride_command(Searches::arguments("killed", request)), space.scratch().path());
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
    process.send(SIGKILL);
    process.wait();
    CHECK(leftovers.after_a_while().empty());
  }
  CHECK(space.search("killed", request).exit_code == 1);
  CHECK(space.table("killed") == space.table("whole"));
  CHECK(space.file("killed/search.json") == space.file("whole/search.json"));
  CHECK_FALSE(fs::exists(space / "killed/running"));
}

TEST_CASE("a search that is interrupted says how it goes on") {
  const Searches space;
  const Leftovers leftovers;
  Process process(
      stride_command(Searches::arguments("out", {"--method", "random", "--runs", "100000"})),
      space.scratch().path());
  while (process.is_running() && records_in(space / "out") < 20) std::this_thread::sleep_for(5ms);
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the search was interrupted; ") &&
                              Contains(" of at most 100000 cases are done") &&
                              Contains("it goes on with the same command"));
  CHECK_THAT(outcome.out, Contains("Table in out"));
  CHECK_FALSE(fs::exists(space / "out/running"));
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("a search that other runners run in parts is the same") {
  const Searches space;
  const Arguments request{"--all", "--runs", "40", "--seed", "2"};
  CHECK(space.search("whole", request).exit_code == 1);
  const auto with = [&](Arguments further) {
    further.insert(further.begin(), request.begin(), request.end());
    return space.search("parts", further);
  };
  const auto next = [&] {
    const Outcome outcome = with({"--next"});
    CHECK(outcome.exit_code == 0);
    std::istringstream lines(outcome.out);
    std::vector<std::string> cases;
    for (std::string line; std::getline(lines, line);) cases.push_back(line);
    return cases;
  };
  CHECK(next() == std::vector<std::string>{"0"});
  check_part(with({"--cases", "0-1"}), 2, "--cases 0-1: the present generation ends with case 0");
  CHECK_FALSE(fs::exists(space / "parts"));

  for (std::vector<std::string> cases = next(); !cases.empty(); cases = next()) {
    const std::string& last = cases.back();
    check_part(with({"--cases", cases.front() + "-" + std::to_string(std::stoi(last) + 1)}), 2,
               "the present generation ends with case " + last);
    const std::size_t before = records_in(space / "parts");
    std::list<Process> processes;  // in any order, at the same time
    for (const std::string& index : cases) {
      Arguments further = request;
      further.insert(further.end(), {"--cases", index, "--jobs", "1"});
      processes.emplace_front(stride_command(Searches::arguments("parts", further)),
                              space.scratch().path());
    }
    for (Process& process : processes) CHECK(process.wait().exit_code <= 1);
    CHECK(records_in(space / "parts") == before + cases.size());
  }
  check_part(with({"--cases", "0-3"}), 0, "");
  check_part(with({"--cases", "17"}), 2, "--cases 17: the search is over with case 16");
  const auto written = fs::last_write_time(space / "parts/cases/000/000012.json");
  CHECK(with({}).exit_code == 1);
  CHECK(fs::last_write_time(space / "parts/cases/000/000012.json") == written);
  CHECK(space.table("parts") == space.table("whole"));
  CHECK(space.file("parts/search.json") == space.file("whole/search.json"));
  CHECK_FALSE(fs::exists(space / "parts/running"));
}

TEST_CASE("a part of a search replaces a record of another case, and says what is missing") {
  const Searches space;
  CHECK(space.search("out", {"--runs", "9"}).exit_code == 0);
  const std::string table = space.table("out");
  const auto record = [&](const char* index) {
    return space / ("out/cases/000/00000" + std::string(index) + ".json");
  };
  fs::remove(record("5"));
  std::string other = read(record("3"));
  other.replace(other.find("\"case\":3"), 8, "\"case\":4");
  std::ofstream(record("4")) << other;
  CHECK(space.search("out", {"--runs", "9", "--next"}).out == "4\n5\n");
  check_part(space.search("out", {"--runs", "9", "--cases", "5-6"}), 0, "");
  CHECK(read(record("4")) == other);
  check_part(space.search("out", {"--runs", "9", "--cases", "1-4"}), 0, "");
  CHECK(space.search("out", {"--runs", "9"}).exit_code == 0);
  CHECK(space.table("out") == table);
}

TEST_CASE("a folder has one search") {
  const Searches space;
  CHECK(space.search("out", {"--runs", "2"}).exit_code == 0);
  check_refused(space, {"--seed", "2"},
                "out: this folder belongs to another search: its seed is 1, and not 2");
  check_refused(space, {"--method", "de"}, "its method is \"cma-es\", and not \"de\"");
  check_refused(space, {"--check", "bounded"}, "its check is any, and not \"bounded\"");
  const Outcome run = space.stride({"campaign", "run", "c.xosc", "--out", "out"});
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("out: this folder belongs to a search"));
  space.scratch().write("c.xosc", planted_campaign("<stride:Keep results='all'/>"));
  check_refused(space, {}, "this folder belongs to a search of another campaign");
  CHECK(space.stride({"campaign", "plan", "c.xosc", "--out", "plan"}).exit_code == 0);
  const Outcome other = space.search("plan");
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Contains("plan: this folder belongs to a campaign"));
}

TEST_CASE("options of a search that are wrong are refused before anything runs") {
  const Searches space;
  check_refused(space, {"--check", "bounder"}, "no check is called 'bounder'");
  check_refused(space, {"--check", "bounder"}, "did you mean 'bounded'?");
  check_refused(space, {"--method", "luck"}, "'luck' is none of cma-es, de and random");
  check_refused(space, {"--runs", "0"}, "--runs");
  check_refused(space, {"--seed", "-1"}, "--seed");
  CHECK_FALSE(fs::exists(space / "out"));
  const Searches unchecked(planted_campaign(), two_filters());
  check_refused(unchecked, {}, "test.ssd: this scenario has no checks");
  const Searches fixed(
      campaign_text(deterministic(""), "<stride:Seed variables='first.u'/>", "test.ssd"));
  check_refused(fixed, {}, "nothing varies in this campaign");
}

TEST_CASE("seeds are those of the campaign's first case in all cases of a search") {
  Parts parts = planted_filters();
  parts.components += component("noise", "minimal.fmu");
  const Searches space(
      planted_campaign("<stride:Keep results='none'/><stride:Seed variables='noise.u'/>"), parts);
  CHECK(space.search("out", {"--runs", "4"}).exit_code == 0);
  CHECK(space.stride({"campaign", "plan", "c.xosc", "--out", "plan"}).exit_code == 0);
  const auto seed_in = [](const std::string& table, int row) {
    std::istringstream lines(table);
    std::string line, field;
    for (int i = 0; i <= row + 1; ++i) std::getline(lines, line);
    std::istringstream fields(line);
    for (int i = 0; i < 5; ++i) std::getline(fields, field, ',');
    return field;
  };
  const std::string first = seed_in(space.file("plan/plan.csv"), 0);
  CHECK(std::stod(first) >= 1);
  CHECK(seed_in(space.file("plan/plan.csv"), 1) != first);
  for (int i = 0; i < 4; ++i) CHECK(seed_in(space.table("out"), i) == first);
}

TEST_CASE("without --out a search is beside the folder of its campaign") {
  const Searches space;
  CHECK(space.stride({"campaign", "search", "c.xosc", "-q", "--runs", "2"}).exit_code == 0);
  CHECK(fs::exists(space / "campaigns/c.search/cases.csv"));
  CHECK(space.stride({"campaign", "plan", "c.xosc"}).exit_code == 0);
  CHECK(space.stride({"campaign", "search", "campaigns/c", "-q", "--runs", "2"}).exit_code == 0);
}

TEST_CASE("a check that is at its limit from the beginning does not hide the others") {
  const Searches space(
      planted_campaign(),
      planted_filters("<stride:Always name='not negative' signal='second.y' min='0'/>"));
  for (const char* seed : {"1", "2", "3"}) {
    const Outcome outcome = space.search(seed, {"--seed", seed, "--runs", "60"});
    INFO(outcome.out);
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains(": bounded"));
  }
}

TEST_CASE("a search for one check takes nothing else for a failure") {
  const Searches space(
      planted_campaign(),
      planted_filters("<stride:Always name='other' signal='first.y' max='0.02'/>"));
  const Outcome outcome = space.search("out", {"--check", "bounded", "--runs", "100"});
  INFO(outcome.out);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.out, Contains("of the check 'bounded'"));
  CHECK_THAT(outcome.err, Contains(": bounded") && !Contains("other"));
  CHECK(records_in(space / "out") > 10);
  const Outcome all = space.search("all", {"--all", "--runs", "100"});
  CHECK_THAT(all.err, Contains("2 failures found, the first one in case 1: other"));
}

TEST_CASE("units, interventions and sets are searched, too") {
  const auto campaign = [](std::initializer_list<const char*> values) {
    return campaign_text(
        deterministic(value_set("kind", {"slow", "direct"}) + value_set("wire.value", values) +
                      value_set("wire.enabled", {"true", "false"}) +
                      value_range("second.time_constant", "0.5", "0.5", "1.5")),
        std::string(kNoResults) +
            "<stride:Swap name='kind' component='first'><stride:Unit name='slow'/>"
            "<stride:Unit name='direct' file='" +
            (test_unit_folder() / "feedthrough.fmu").string() +
            "'/></stride:Swap><stride:Intervention name='wire'><stride:Force variable='second.u' "
            "value='0' from='0.25'/></stride:Intervention>",
        "test.ssd");
  };
  const Searches harmless(campaign({"0", "0.5"}));
  const Outcome none = harmless.search("out");
  INFO(none.out << none.err);
  CHECK(none.exit_code == 0);
  CHECK(records_in(harmless / "out") == 2 * 2 * 2 * 3 + 1);
  const Searches harmful(campaign({"0", "0.5", "9"}));
  const Outcome found = harmful.search("out");
  INFO(found.out << found.err);
  CHECK(found.exit_code == 1);
  CHECK_THAT(found.out, Contains("--force second.u=9@0.25.."));
}

TEST_CASE("a scenario that fails by itself needs no search") {
  const Searches space(planted_campaign(),
                       planted_filters("<stride:Final name='high' signal='second.y' min='9'/>"));
  const Outcome outcome = space.search("out");
  INFO(outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the scenario itself fails, without any value of the campaign: "
                                   "high") &&
                              Contains("repeat it with: stride run test.ssd"));
  CHECK(records_in(space / "out") == 1);
}

TEST_CASE("a case that crashes is a failure, and other failures are looked for with --all") {
  Parts parts{component("c", "faulty.fmu") + component("other", "minimal.fmu"), ""};
  parts.annotation =
      "<stride:Checks><stride:Always name='bounded' signal='other.y' max='0.5'/></stride:Checks>\n";
  const Searches space(
      campaign_text(deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.5"}) +
                                  value_set("c.fault", {"", "segfault"}) +
                                  value_set("other.u", {"0.1", "0.2", "9"})),
                    kNoResults, "test.ssd"),
      parts);
  const Outcome outcome = space.search("out", {"--all"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("2 failures found"));
  CHECK_THAT(outcome.out, Contains("crashed  ") && Contains("bounded  "));
}
