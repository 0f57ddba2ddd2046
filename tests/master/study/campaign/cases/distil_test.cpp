#include "master/study/campaign/cases/distil.h"

#include <algorithm>
#include <bit>
#include <random>

#include <catch2/catch.hpp>

using namespace stride::campaign;

namespace {

using Items = std::set<std::string>;

using Counts = std::map<std::string, std::uint64_t>;

Counts counts_of(const std::vector<DistilCandidate>& candidates, unsigned chosen) {
  Counts counts;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if ((chosen >> i & 1) == 0) continue;
    for (const auto& [item, count] : candidates[i].items) counts[item] += count;
  }
  return counts;
}

Items all_items(const std::vector<DistilCandidate>& candidates, unsigned chosen) {
  Items items;
  for (const auto& [item, count] : counts_of(candidates, chosen)) items.insert(item);
  return items;
}

DistilCandidate once(std::uint64_t index, std::initializer_list<const char*> items) {
  DistilCandidate candidate{index};
  for (const char* const item : items) candidate.items.emplace(item, 1);
  return candidate;
}

/// By trying all subsets.
std::size_t fewest(const std::vector<DistilCandidate>& candidates) {
  const unsigned every = (1U << candidates.size()) - 1;
  const Items wanted = all_items(candidates, every);
  int best = static_cast<int>(candidates.size());
  for (unsigned chosen = 0; chosen <= every; ++chosen) {
    if (std::popcount(chosen) < best && all_items(candidates, chosen) == wanted) {
      best = std::popcount(chosen);
    }
  }
  return static_cast<std::size_t>(best);
}

/// The bit of each chosen candidate.
unsigned places(const std::vector<DistilCandidate>& candidates,
                const std::vector<DistilledCase>& chosen) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (const DistilledCase& one : chosen) {
      if (one.index == candidates[i].index) bits |= 1U << i;
    }
  }
  return bits;
}

std::vector<DistilCandidate> random_candidates(std::mt19937& random, unsigned most = 1) {
  const auto below = [&](unsigned limit) { return random() % limit; };
  std::vector<DistilCandidate> candidates(1 + below(9));
  const unsigned items = 1 + below(10);
  const unsigned density = 1 + below(6);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].index = 100 - 7 * i;
    for (unsigned item = 0; item < items; ++item) {
      if (below(density) == 0) candidates[i].items.emplace(std::to_string(item), 1 + below(most));
    }
  }
  return candidates;
}

double harmonic(std::size_t count) {
  double sum = 0;
  for (std::size_t i = 1; i <= count; ++i) sum += 1.0 / static_cast<double>(i);
  return sum;
}

std::vector<std::uint64_t> indices(const std::vector<DistilledCase>& chosen) {
  std::vector<std::uint64_t> found;
  for (const DistilledCase& one : chosen) found.push_back(one.index);
  return found;
}

}  // namespace

TEST_CASE("what is distilled has all items, none too many, and is near to the fewest") {
  std::mt19937 random(20261126);
  std::size_t optimal = 0;
  constexpr int kInstances = 2000;
  for (int i = 0; i < kInstances; ++i) {
    const auto candidates = random_candidates(random);
    const auto chosen = distil(candidates);
    const unsigned bits = places(candidates, chosen);
    const Items wanted = all_items(candidates, (1U << candidates.size()) - 1);
    CAPTURE(i, bits);
    REQUIRE(static_cast<std::size_t>(std::popcount(bits)) == chosen.size());
    REQUIRE(all_items(candidates, bits) == wanted);
    for (std::size_t place = 0; place < candidates.size(); ++place) {
      const unsigned bit = 1U << place;
      if ((bits & bit) != 0) REQUIRE(all_items(candidates, bits & ~bit) != wanted);
    }
    const std::size_t least = fewest(candidates);
    REQUIRE(static_cast<double>(chosen.size()) <=
            harmonic(wanted.size()) * static_cast<double>(least) + 1e-9);
    optimal += chosen.size() == least;
  }
  CHECK(optimal > kInstances * 9 / 10);
}

TEST_CASE("what a case has alone is what would be missing without it") {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const auto candidates = random_candidates(random);
    const auto chosen = distil(candidates);
    const unsigned bits = places(candidates, chosen);
    const Items wanted = all_items(candidates, bits);
    for (const DistilledCase& one : chosen) {
      Items rest = all_items(candidates, bits & ~places(candidates, {one}));
      CHECK_FALSE(one.alone.empty());
      for (const std::string& item : one.alone) CHECK(rest.insert(item).second);
      CHECK(rest == wanted);
    }
  }
}

TEST_CASE("of equal cases the first is taken, whatever their order") {
  CHECK(indices(distil(std::vector{once(5, {"a"}), once(2, {"a"}), once(9, {"a"})})) ==
        std::vector<std::uint64_t>{2});
  // 0 is taken first, and needed no longer when 1 and 2 are there
  CHECK(indices(distil(std::vector{once(0, {"a", "b", "c"}), once(1, {"a", "b", "x"}),
                                   once(2, {"c", "y"})})) == std::vector<std::uint64_t>{1, 2});
  CHECK(distil(std::vector<DistilCandidate>{{0, {}}}).empty());
  CHECK(distil(std::vector<DistilCandidate>{}).empty());
}

TEST_CASE("what is wanted several times is there so often, if there is so much of it") {
  std::mt19937 random(11);
  std::size_t several = 0;
  for (int i = 0; i < 500; ++i) {
    const auto candidates = random_candidates(random, 4);
    const Wanted wanted{{"0", 3}, {"1", 7}, {"2", 1000}};
    const Counts all = counts_of(candidates, (1U << candidates.size()) - 1);
    const auto is_enough = [&](const Counts& counts) {
      return std::ranges::all_of(all, [&](const auto& item) {
        const auto often = wanted.find(item.first);
        const std::uint64_t want =
            often == wanted.end() || item.second < often->second ? 1 : often->second;
        const auto found = counts.find(item.first);
        return found != counts.end() && found->second >= want;
      });
    };
    const auto chosen = distil(candidates, wanted);
    const unsigned bits = places(candidates, chosen);
    CAPTURE(i, bits);
    REQUIRE(is_enough(counts_of(candidates, bits)));
    for (const DistilledCase& one : chosen) {
      REQUIRE_FALSE(is_enough(counts_of(candidates, bits & ~places(candidates, {one}))));
      REQUIRE_FALSE(one.alone.empty());
    }
    several += chosen.size() > distil(candidates).size();
  }
  CHECK(several > 50);
}

TEST_CASE("endings are the same where outcome and failed checks are") {
  CaseResult result;
  CHECK(ending_of(result) == "passed");
  result.outcome = Outcome::Failed;
  result.verdicts = {{"b", "Always", false, "", {}},
                     {"c", "Always", true, "", {}},
                     {"a", "", false, "at 1 s", 1.0},
                     {"d", "", std::nullopt, "", {}}};
  CHECK(ending_of(result) == "failed by 'a', 'b'");
  result.verdicts.clear();
  result.outcome = Outcome::TimedOut;
  CHECK(ending_of(result) == "timed out");
}

TEST_CASE("covered bins are those of the component that count") {
  using stride::coverage::GroupDefinition;
  using stride::coverage::Kind;
  using stride::coverage::PointDefinition;
  PointDefinition field{.name = "field"};
  field.bins = {{"[0, 1)"}, {"[1, 2]"}, {"> 2", true}};
  field.at_least = 2;
  PointDefinition words{.name = "words", .kind = Kind::Words, .is_open = true, .ignored = {"x*"}};
  const std::vector<GroupDefinition> groups{{0, "sensor", {}, {field, words}}};
  auto others = groups;
  others[0].points[0].bins.insert(others[0].points[0].bins.begin(), {"[-1, 0)"});
  CaseDefinitions definitions(groups, [&](std::uint64_t) { return others; });
  CountedBins bins("sensor", definitions);
  CaseResult result;
  CHECK(bins.of(result, 0).empty());
  result.coverage = {hash(groups),
                     {{"sensor",
                       {{"field", {{"[0, 1)", 3, 0.5}, {"> 2", 1, 0.25}}},
                        {"words", {{"read", 1, 1}, {"x1", 1, 1}}}}},
                      {"reader", {{"y", {{"z", 1, 0}}}}}}};
  CHECK(bins.of(result, 0) == Counts{{"field: [0, 1)", 3}, {"words: read", 1}});
  CHECK(bins.wanted() == Wanted{{"field: [0, 1)", 2}});
  CHECK(CountedBins("led", definitions).of(result, 0).empty());
  // what has other bins is another point
  result.coverage->definition = hash(others);
  const std::string other = "field@" + hash(others[0], others[0].points[0]).substr(0, 8);
  CHECK(bins.of(result, 4) == Counts{{other + ": [0, 1)", 3}, {"words: read", 1}});
  // and of an unknown definition nothing is known
  result.coverage->definition = "another";
  CHECK(bins.of(result, 5).empty());
}
