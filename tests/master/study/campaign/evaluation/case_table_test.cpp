#include "master/study/campaign/evaluation/case_table.h"

#include <filesystem>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include <catch2/catch.hpp>
#include <unistd.h>

#include "master/observe/coverage/coverage_json.h"
#include "master/study/campaign/evaluation/campaign_junit.h"
#include "tests/master/study/campaign/records.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

const CaseResult kFailed{
    .outcome = Outcome::Failed,
    .reason = "low: at 0.5 s, \"y\"\nand more",
    .verdicts = {{"low", "Never", false, "y", 0.5, CaseMargin{-0.5, "V", 0.75}},
                 {"low", "", true, "", {}},
                 {"open", "Count", std::nullopt, "", {}}},
    .aggregates = {0.1},
    .coverage = CaseCoverage{"0f", {{"b", {{"y", {{"[0, 1)", 3, 0.5}, {"NaN", 1, 0}}}}}}},
    .reached = 1,
    .has_results = true,
    .wall_time = 0.25,
    .began = "2026-11-25T23:59:59Z",
    .host = "a,b"};

}  // namespace

TEST_CASE("a record is read as it was written") {
  const Records records;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const CaseResult odd{.outcome = Outcome::TimedOut,
                       .reason = "a \xff",
                       .verdicts = {{"nan", "Never", false, "", {}, CaseMargin{-kInfinity, "", 0}}},
                       .aggregates = {-kInfinity}};
  for (const CaseResult& result : {kFailed, CaseResult{.aggregates = {std::nullopt}}}) {
    const std::string line = record_line(records.plan, records.plan.at(1), result);
    CHECK(line.find('\n') == std::string::npos);
    CHECK(parse_record(records.plan, 1, line) == result);
    CHECK(parse_record(records.plan, 2, line) == std::nullopt);
    CHECK(parse_record(records.plan, 1, line.substr(0, line.size() / 2)) == std::nullopt);
    std::string other = line;
    other[other.find("\"hash\":\"") + 8] ^= 1;  // of other values
    CHECK(parse_record(records.plan, 1, other) == std::nullopt);
  }
  const std::string line = record_line(records.plan, records.plan.at(0), odd);
  CHECK(parse_record(records.plan, 0, line)->aggregates == odd.aggregates);
  CHECK(parse_record(records.plan, 0, line)->verdicts == odd.verdicts);
}

TEST_CASE("records are in folders of a thousand, as a whole or not at all") {
  const Records records;
  CHECK(records.cases.record_file(3) == records.folder / "out/cases/000/000003.json");
  CHECK(records.cases.read(3) == std::nullopt);
  records.write(3, kFailed);
  CHECK(records.cases.read(3)->result == kFailed);
  CHECK_FALSE(fs::exists(records.folder / "out/running"));
  CHECK(Records("2000000").cases.results_name(1234567) == "cases/1234/1234567");
}

TEST_CASE("results are put beside the record, in the place of those of a killed process") {
  const Records records;
  const CaseScratch scratch(records.cases);
  records.touch("out/cases/000/000002/old");
  fs::create_directories(scratch.results(2) / "new");
  scratch.keep_results(2);
  CHECK(fs::exists(records.folder / "out/cases/000/000002/new"));
  CHECK_FALSE(fs::exists(records.folder / "out/cases/000/000002/old"));
}

TEST_CASE("what a killed process of this host has left is removed, and nothing else") {
  const Records records;
  char host[256] = {};
  REQUIRE(::gethostname(host, sizeof host - 1) == 0);
  const std::string running = "out/running/";
  records.touch(running + host + ".99999999/x");
  records.touch(running + "elsewhere.1/x");
  { const CaseScratch scratch(records.cases); }
  CHECK_FALSE(fs::exists(records.folder / (running + host + ".99999999")));
  CHECK(fs::exists(records.folder / (running + "elsewhere.1/x")));
}

TEST_CASE("the tables have a row for each case, with or without a record") {
  const Records records;
  records.write(2, kFailed);
  records.write(0, {.aggregates = {std::numeric_limits<double>::quiet_NaN()}, .reached = 1});
  const CaseScratch scratch(records.cases);
  const CaseSummary summary = write_case_tables(records.plan, records.cases, scratch, 5);
  CHECK(summary.totals.passed == 1);
  CHECK(summary.totals.failed == 1);
  CHECK(summary.totals.missing() == 2);
  REQUIRE(summary.first_failures.size() == 1);
  CHECK(summary.first_failures.front().index == 2);
  CHECK(summary.first_failures.front().result == kFailed);

  const auto row = [&](std::uint64_t index, const std::string& outcome, const std::string& rest) {
    const Case planned = records.plan.at(index);
    return std::to_string(index) + "," + *planned.values[0] + "," + std::to_string(planned.seed) +
           "," + outcome + "," + records.plan.hash(planned) + rest + "\n";
  };
  CHECK(content(records.folder / "out/cases.csv") ==
        "case,b.u,seed,outcome,reason,check:low,margin:low,verdict:low,check:open,margin:open,"
        "\"aggregate:a, \"\"b\"\"\",reached,"
        "hash,wall_time,began,host\n" +
            row(0, "passed,,,,,,,nan,1", ",0,,") + row(1, "missing,,,,,,,,", ",,,") +
            row(2, "failed,\"low: at 0.5 s, \"\"y\"\"\",failed,-0.5,passed,undecided,,0.1,1",
                ",0.25,2026-11-25T23:59:59Z,\"a,b\"") +
            row(3, "missing,,,,,,,,", ",,,"));
  const std::string lines = content(records.folder / "out/cases.jsonl");
  CHECK(std::count(lines.begin(), lines.end(), '\n') == 4);
  CHECK_THAT(lines, Contains("\"outcome\":\"missing\""));
}

TEST_CASE("a test report of a campaign") {
  const Records records;
  records.write(2, kFailed);
  records.write(1, {.outcome = Outcome::Crashed, .reason = "SIGSEGV", .aggregates = {{}}});
  records.write(0, {.aggregates = {{}}});
  write_campaign_junit(records.folder / "j.xml", records.plan, records.cases,
                       {.cases = 4, .passed = 1, .failed = 2});
  const std::string xml = content(records.folder / "j.xml");
  CHECK_THAT(xml,
             Contains("tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\" time=\"0.250\"") &&
                 Contains("<error message=\"SIGSEGV\" type=\"crashed\">") &&
                 Contains("<failure message=\"low: at 0.5 s, &quot;y&quot;\" "
                          "type=\"failed\">") &&
                 Contains("<skipped message=\"the case has not been run\"/>") &&
                 Contains(" --set b.u="));
}

namespace {

/// Of a component whose unit may be another one, with two bins up to there.
CaseDefinitions::Definitions covered_up_to(double high) {
  coverage::GroupDefinition group{.component = 1, .name = "b"};
  coverage::PointDefinition& point = group.points.emplace_back();
  point.name = point.signal = "y";
  point.classes = coverage::equal_ranges(0, high, 2, false, core::ValueType::Float64);
  point.bins = std::get<coverage::Ranges>(*point.classes).bins();
  return {group};
}

}  // namespace

TEST_CASE("coverage of the cases is a column, and merged where it means the same") {
  const Records records;
  const auto definitions = covered_up_to(2);
  const auto covering = [&](const std::string& bin, std::string definition) {
    return CaseResult{
        .aggregates = {1},
        .coverage = CaseCoverage{std::move(definition), {{"b", {{"y", {{bin, 2, 0.5}}}}}}}};
  };
  records.write(0, covering("NaN", coverage::hash(definitions)));
  records.write(2, covering("[0, 1)", coverage::hash(definitions)));
  records.write(1, covering("[2, 4]", coverage::hash(covered_up_to(4))));
  records.write(3, covering("[1, 2]", "another"));
  const CaseScratch scratch(records.cases);
  std::vector<std::uint64_t> loaded;
  const auto load = [&](std::uint64_t index) -> CaseDefinitions::Definitions {
    loaded.push_back(index);
    if (index == 3) core::fail_input({}, "its unit is gone");
    return covered_up_to(4);
  };
  const CaseSummary summary = write_case_tables(records.plan, records.cases, scratch, 5,
                                                CaseDefinitions(definitions, load));
  CHECK(loaded == std::vector<std::uint64_t>{1, 3});
  CHECK(summary.without_bins == 1);
  REQUIRE(summary.coverage);
  CHECK(summary.coverage->cases == 3U);
  const auto& points = summary.coverage->groups[0].points;
  REQUIRE(points.size() == 2);
  CHECK((points[0].runs == 2 && points[1].runs == 1 && points[1].first_case == 1U));
  CHECK(points[0].bins[0] == coverage::BinCount{"[0, 1)", false, 2, 0.5, 2});
  CHECK((points[0].bins[1].count == 0 && points[0].bins[4].in_case == 0U));
  CHECK(points[1].bins[1] == coverage::BinCount{"[2, 4]", false, 2, 0.5, 1});
  CHECK(coverage::read_coverage(records.folder / "out/coverage.json") == *summary.coverage);
  const std::string table = content(records.folder / "out/cases.csv");
  CHECK_THAT(table, Contains("\"\"b\"\"\",coverage:b,reached,"));
  CHECK_THAT(table,
             Contains("passed,,1,0,") && Contains("passed,,1,50,") && Contains("passed,,1,,"));
  CHECK_THAT(content(records.folder / "out/cases.csv"), !Contains("missing"));
}
