#include "master/study/compare/compare.h"

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

const std::string kMessages =
    "time,index,component,variable,direction,payload,content\n0.5,0,tank,alarm,sent,01,full\n";

/// The results of a run of two rows.
struct Results {
  TemporaryFolder folder;

  explicit Results(const std::string& level = "2") {
    folder.write("run.json", R"({"outcome": "completed", "reached": 1.0,
      "signals": [{"name": "tank.level", "unit": "m", "type": "Float64",
                   "variability": "continuous"},
                  {"name": "tank.code", "unit": "", "type": "String", "variability": "discrete"}],
      "files": {"signals": "signals.csv", "events": "events.csv", "activity": "activity.csv",
                "trace": "signals.vcd", "statistics": "run.json", "coverage": "coverage.json"}})");
    folder.write("signals.csv", "time,tank.level [m],tank.code\n0,1,007\n1," + level + ",007\n");
    folder.write("events.csv", kMessages);
    folder.write("activity.csv", "time,until,component,kind\n0,0,tank,event\n");
    folder.write("signals.vcd", "anything");
  }
  std::filesystem::path path() const { return folder / ""; }

  void write_run(const std::string& before, const std::string& after) const {
    std::string run = content(folder / "run.json");
    folder.write("run.json", run.replace(run.find(before), before.size(), after));
  }
};

Comparison compared_with(const Results& other, const Settings& settings = {}) {
  const Results results;
  return compare_results(results.path(), other.path(), settings);
}

}  // namespace

TEST_CASE("results are equal to those of the same run, whatever is in files that repeat others") {
  Results other;
  other.folder.write("signals.vcd", "something else");
  const Comparison comparison = compared_with(other);
  CHECK(comparison.differences.empty());
  CHECK(comparison.inputs == std::vector<InputDifference>());
  CHECK(comparison.signals == 2);
  CHECK(comparison.rows == 2);
  CHECK(comparison.messages == 1);
  CHECK(comparison.notes.empty());
}

TEST_CASE("differences of all files are in the order of their times") {
  Results other("3");
  other.folder.write("events.csv", kMessages + "1,0,tank,alarm,sent,01,full\n");
  other.folder.write("activity.csv", "time,until,component,kind\n0.25,0.25,tank,event\n");
  other.folder.write("coverage.json",
                     R"({"format": "stride coverage", "version": 1, "scenario": "s",
                         "definition": "d", "groups": []})");
  other.folder.write("run.json", R"({"outcome": "failed", "reached": 1.0})");
  CHECK(names_of(compared_with(other).differences) == Names{"event tank", "message tank.alarm sent",
                                                            "signal tank.level", "outcome outcome",
                                                            "file coverage.json"});
}

TEST_CASE("a signal of another type is a difference") {
  Results other;
  other.write_run("Float64", "Float32");
  const Comparison comparison = compared_with(other);
  REQUIRE(names_of(comparison.differences) == Names{"signal tank.level"});
  CHECK(comparison.differences[0].a == "Float64");
  CHECK(comparison.differences[0].b == "Float32");
}

TEST_CASE("an empty file is that of a run that was killed, and has nothing to say") {
  for (const char* file : {"signals.csv", "events.csv", "activity.csv"}) {
    Results other;
    other.folder.write(file, "");
    CHECK_THAT(error_of([&] { compared_with(other); }),
               Contains(file) && Contains("the file is empty"));
  }
}

TEST_CASE("a run that has not ended, and one that has recorded nothing, are noted") {
  Results other;
  other.write_run("completed", "running");
  const Comparison comparison = compared_with(other);
  REQUIRE(comparison.notes.size() == 1);
  CHECK_THAT(comparison.notes[0], Contains("the run was killed, or goes on"));
  const Results results;
  for (const Results* each : std::initializer_list<const Results*>{&other, &results}) {
    each->folder.write("signals.csv", "time,tank.level [m],tank.code\n");
    each->folder.write("events.csv", "time,index,component,variable,direction,payload,content\n");
  }
  CHECK_THAT(compare_results(results.path(), other.path(), {}).notes.back(),
             Contains("neither rows of signals nor messages"));
}

TEST_CASE("a file that only one has is a difference") {
  Results other;
  std::filesystem::remove(other.folder / "events.csv");
  const Comparison comparison = compared_with(other);
  REQUIRE(names_of(comparison.differences) == Names{"file events.csv"});
  CHECK(comparison.differences[0].a == "present");
  CHECK(comparison.differences[0].b == "missing");
}

TEST_CASE("a golden folder has fewer files, and its own tolerances") {
  Results golden("2.125");
  for (const char* file : {"run.json", "activity.csv", "signals.vcd"}) {
    std::filesystem::remove(golden.folder / file);
  }
  CHECK(names_of(compared_with(golden, {.is_golden = true}).differences) ==
        Names{"signal tank.level"});
  golden.folder.write("tolerances.csv", "signal,absolute,relative\ntank.level [m],0.25,0\n");
  const Comparison comparison = compared_with(golden, {.is_golden = true});
  CHECK(comparison.differences.empty());
  CHECK_FALSE(comparison.inputs);
  CHECK(compared_with(golden).differences.size() == 3);
}

TEST_CASE("an option's tolerance comes before that of the golden folder") {
  Results golden("2.125");
  golden.folder.write("tolerances.csv", "signal,absolute,relative\ntank.level [m],0.25,0\n");
  CHECK(compared_with(golden, {.tolerances = {{"tank.level", {0.1, 0}, {}}}, .is_golden = true})
            .differences.size() == 1);
}

TEST_CASE("a mistake in a golden folder's signals is that of the file") {
  Results golden;
  std::filesystem::remove(golden.folder / "run.json");
  golden.folder.write("signals.csv", "time,tank.level [m],tank.code\n0,1,007\n0,x\n");
  CHECK_THAT(error_of([&] { compared_with(golden, {.is_golden = true}); }),
             Contains("signals.csv:3: expected 3 fields"));
  golden.folder.write("signals.csv", "time,tank.level [m],tank.code\n0,high,007\n1,2,007\n");
  CHECK(compared_with(golden, {.is_golden = true}).differences.at(0).b == "high");
}

TEST_CASE("with a tolerance of time events are not compared") {
  Results other;
  other.folder.write("activity.csv", "time,until,component,kind\n0.25,0.25,tank,event\n");
  CHECK(compared_with(other).differences.size() == 1);
  CHECK(compared_with(other, {.time_tolerance = Duration()}).differences.empty());
}

TEST_CASE("patterns mean signals and messages, and have to mean some") {
  Results other("3");
  other.folder.write("events.csv", kMessages + "1,0,tank,alarm,sent,01,full\n");
  CHECK(names_of(compared_with(other, {.ignored = {"tank.level"}}).differences) ==
        Names{"message tank.alarm sent"});
  const Comparison only = compared_with(other, {.only = {"tank.level"}});
  CHECK(names_of(only.differences) == Names{"signal tank.level"});
  CHECK(only.signals == 1);
  CHECK_THAT(error_of([&] { compared_with(other, {.ignored = {"tank.lvel"}}); }),
             Contains("did you mean 'tank.level'?"));
}

TEST_CASE("a line that was cut off is noted") {
  Results other;
  other.folder.write("signals.csv", "time,tank.level [m],tank.code\n0,1,007\n1,2,007\n2,");
  const Comparison comparison = compared_with(other);
  CHECK(comparison.differences.empty());
  REQUIRE(comparison.notes.size() == 1);
  CHECK_THAT(comparison.notes[0], Contains("signals.csv:4: the last line was cut off"));
}

TEST_CASE("what is no folder of results is refused") {
  const Results results;
  const TemporaryFolder empty;
  CHECK_THAT(error_of([&] { compare_results(results.path(), empty / "", {}); }),
             Contains("there are no results in this folder"));
  CHECK_THAT(error_of([&] { compare_results(empty / "x", results.path(), {}); }),
             Contains("this is not a folder"));
  results.folder.write("run.json", "{");
  CHECK_THAT(error_of([&] { compare_results(results.path(), results.path(), {}); }),
             Contains("run.json:1: this is not JSON"));
}
