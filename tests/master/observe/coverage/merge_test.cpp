#include "master/observe/coverage/merge.h"

#include <algorithm>
#include <map>
#include <random>

#include <catch2/catch.hpp>

#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

constexpr unsigned kVariants = 3;

/// Of a unit of which there are several: the level has other bins, and the last one has no words.
GroupDefinition swapped_group(unsigned variant) {
  const double high = variant == 1 ? 6 : 4;
  GroupDefinition group =
      group_of({values_of("level", 0, equal_ranges(0, high, 4, false, core::ValueType::Float64))});
  if (variant != 2)
    group.points.push_back(messages_of(Kind::Words, "words", {{"read"}, {"write"}}));
  group.points.push_back(messages_of(Kind::Words, "all"));
  group.points.back().ignored = {"e*"};
  group.points.push_back(messages_of(Kind::Sequences, "sequences"));
  group.points.push_back(cross_of(group, {group.points.size() - 2, 0}));
  group.goal = 70 + variant;
  return group;
}

GroupDefinition fixed_group() {
  GroupDefinition group = group_of({transitions_of("lamp", 1, truths())});
  group.name = "other";
  return group;
}

std::vector<GroupDefinition> definitions_of(unsigned variant) {
  return {swapped_group(variant), fixed_group()};
}

/// One run, of one of the units. `words`: how many different ones there may be.
Report run(unsigned seed, unsigned variant, unsigned words = 12) {
  std::mt19937 random(seed);
  Coverage coverage(definitions_of(variant));
  Device device(swapped_group(variant));
  device.start(coverage);
  const unsigned messages = words > 12 ? words : 6;
  for (unsigned i = 0; i < messages; ++i) {
    constexpr const char* kWords[] = {"read", "write", "erase"};
    const unsigned word = random() % words;
    device.binary.binaries()[0].assign(1, 0x26);
    core::Message message{at(i), 0, {0, 9}, true, &device.binary, 0};
    const std::string content =
        word < std::size(kWords) ? kWords[word] : std::to_string(word) + "word";
    message.content = content;
    coverage.on_message(message);
    device.number.numbers<double>()[0] = static_cast<double>(random() % 7);
    device.truth.numbers<bool>()[0] = random() % 2 == 0;
    coverage.on_communication_point(at(i));
  }
  return coverage.report("s" + std::to_string(variant));
}

Report case_of(const Report& run, unsigned variant, std::uint64_t index) {
  const auto definitions = definitions_of(variant);
  Report report = empty_report(run.scenario, definitions, 0);
  add_case(report, definitions, covered_bins(run), index);
  return report;
}

Report sum_of(Report a, const Report& b) {
  merge(a, b);
  return a;
}

const PointReport& point_in(const Report& report, const std::string& name) {
  const auto& points = report.groups.at(0).points;
  return *std::ranges::find(points, name, &PointReport::name);
}

}  // namespace

TEST_CASE("merging is commutative and associative, whatever the definitions are") {
  std::mt19937 random(20261126);
  for (unsigned i = 0; i < 300; ++i) {
    std::vector<Report> reports;
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned variant = random() % kVariants;
      reports.push_back(run(random(), variant));
      if (random() % 2 == 0) reports[k] = case_of(reports[k], variant, random() % 4);
    }
    CAPTURE(i);
    REQUIRE(sum_of(reports[0], reports[1]) == sum_of(reports[1], reports[0]));
    REQUIRE(sum_of(sum_of(reports[0], reports[1]), reports[2]) ==
            sum_of(reports[0], sum_of(reports[1], reports[2])));
  }
}

TEST_CASE("so it is where there are more bins than are kept") {
  std::vector<Report> reports;
  for (unsigned seed = 0; seed < 4; ++seed) reports.push_back(run(seed, seed % 2, 900));
  const Report forwards = sum_of(sum_of(sum_of(reports[0], reports[1]), reports[2]), reports[3]);
  CHECK(forwards == sum_of(sum_of(reports[3], reports[1]), sum_of(reports[2], reports[0])));
  // most sequences are of one visit
  const PointReport& sequences = point_in(forwards, "sequences");
  REQUIRE(sequences.bins.size() == kMostOpenBins + 1);
  std::map<std::string, std::uint64_t> counts;
  std::uint64_t all = 0;
  for (const Report& report : reports) {
    for (const BinCount& bin : point_in(report, "sequences").bins) {
      counts[bin.name] += bin.count;
      all += bin.count;
    }
  }
  std::uint64_t kept = 0, further = 0;
  for (const BinCount& bin : sequences.bins) {
    if (bin.name == kFurther) {
      CHECK(bin.is_ignored);
      further = bin.count;
      continue;
    }
    kept += bin.count;
    CHECK(bin.count == counts.at(bin.name));
  }
  CHECK(kept + further == all);
  CHECK(further > 1000);
}

TEST_CASE("what all runs hit at once is what they hit one by one, in any order of the cases") {
  constexpr unsigned kCases = 40;
  std::map<unsigned, Report> by_variant;
  Report merged, backwards;
  const auto add = [](Report& all, const Report& one) {
    all = all.groups.empty() ? one : sum_of(all, one);
  };
  for (unsigned i = 0; i < kCases; ++i) {
    const unsigned variant = i * i % kVariants;
    const auto definitions = definitions_of(variant);
    const Report one = run(i, variant);
    const auto [report, is_new] = by_variant.try_emplace(variant);
    if (is_new) report->second = empty_report(one.scenario, definitions, 0);
    add_case(report->second, definitions, covered_bins(one), i);
    add(merged, case_of(one, variant, i));
    const unsigned last = kCases - 1 - i;
    add(backwards, case_of(run(last, last * last % kVariants), last * last % kVariants, last));
  }
  Report together;
  for (const auto& [variant, report] : by_variant) add(together, report);
  CHECK(together == merged);
  CHECK(backwards == merged);
  CHECK(merged.cases == kCases);
  CHECK(merged.scenario == "s0, s1");
}

TEST_CASE("points that mean the same are merged, others stand beside each other") {
  const Report merged = sum_of(run(1, 0), run(2, 1));
  REQUIRE(merged.groups.size() == 2);
  CHECK(merged.runs == 2);
  std::vector<std::string> names;
  for (const PointReport& point : merged.groups[0].points) names.push_back(point.name);
  CHECK(names ==
        std::vector<std::string>{"level", "level", "words", "all", "sequences", "cross", "cross"});
  const auto& points = merged.groups[0].points;
  CHECK((points[0].runs == 1 && points[1].runs == 1 && points[2].runs == 2));
  CHECK(points[0].definition != points[1].definition);
  // each cross is of a level of its own
  CHECK(points[5].of_definitions != points[6].of_definitions);
  CHECK(merged.groups[1].points.at(0).runs == 2);
  CHECK(merged.groups[0].goal == 71.0);
  CHECK(merged.definition != run(1, 0).definition);
  CHECK(sum_of(run(1, 0), run(2, 0)).definition == run(1, 0).definition);
}

TEST_CASE("a point that only some have is where it was declared") {
  const Report merged = sum_of(run(1, 2), run(2, 0));
  std::vector<std::string> names;
  for (const PointReport& point : merged.groups[0].points) names.push_back(point.name);
  CHECK(names == std::vector<std::string>{"level", "all", "words", "sequences", "cross"});
  CHECK(point_in(merged, "words").runs == 1);
  CHECK(point_in(merged, "all").runs == 2);
}

TEST_CASE("the first case that hit a bin is the one that is named") {
  const auto definitions = definitions_of(0);
  Report report = empty_report("s", definitions, 0);
  add_case(report, definitions, {{"device", {{"all", {{"read", 1, 0.25}}}}}}, 5);
  add_case(report, definitions, {{"device", {{"all", {{"read", 2, 0.5}}}}}}, 3);
  add_case(report, definitions, {{"gone", {{"all", {{"read", 1, 0.25}}}}}}, 6);
  CHECK(point_in(report, "all").bins.at(0) == BinCount{"read", false, 3, 0.5, 3});
  CHECK((report.cases == 3U && report.runs == 3));
  CHECK(point_in(report, "all").first_case == 3U);
  // before a visit of no case
  const Report all = sum_of(run(1, 0), report);
  const auto& bins = point_in(all, "all").bins;
  CHECK(std::ranges::find(bins, "read", &BinCount::name)->in_case == 3U);
}

TEST_CASE("points that are not what their definitions say are refused") {
  Report report = run(1, 0);
  Report other = report;
  other.groups[0].points[0].bins[1].name = "another";
  CHECK_THROWS_WITH(merge(report, other),
                    Catch::Contains("'device', point 'level': both have the definition"));
}
