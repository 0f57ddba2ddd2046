#include "master/study/search/search.h"

#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/study/campaign/support.h"
#include "tests/master/study/search/optimisers.h"

using namespace stride::tests;
using namespace stride::search;
using namespace stride::campaign;
using Catch::Matchers::Contains;

namespace {

/// A device with an offset and a tilt, 0 in the nominal case: two checks with narrow regions in
/// which they fail.
class Device final : public Cases {
 public:
  explicit Device(std::size_t most = 1'000'000) : most_(most) {}

  bool add(std::vector<Row> rows) override {
    if (results_.size() + rows.size() > most_) return false;
    for (const Row& row : rows) results_.push_back(run(number(row[0]), number(row[1])));
    batches.push_back(rows.size());
    for (Row& row : rows) this->rows.push_back(std::move(row));
    return true;
  }
  std::size_t size() const override { return results_.size(); }
  const CaseResult& result(std::uint64_t index) const override { return results_[index]; }

  std::vector<Row> rows;
  std::vector<std::size_t> batches;

 private:
  static double number(const Text& text) { return text ? std::stod(*text) : 0; }

  static CaseResult run(double offset, double tilt) {
    CaseResult result;
    const double near = std::hypot(offset - 0.7, tilt + 0.6) - 0.05;
    const double far = std::hypot(offset + 0.4, tilt - 0.8) - 0.05;
    for (const auto& [name, margin] : {std::pair{"near", near}, std::pair{"far", far}}) {
      CaseVerdict& verdict = result.verdicts.emplace_back();
      verdict.name = name;
      verdict.kind = "always";
      verdict.passed = margin >= 0;
      verdict.margin = CaseMargin{margin, "m", 0};
      if (margin < 0) result.outcome = Outcome::Failed;
    }
    return result;
  }

  std::size_t most_;
  std::vector<CaseResult> results_;
};

Plan plan_with(const std::string& variation) { return plan_of(campaign_text(variation)); }

const Plan& continuous() {
  static const Plan plan =
      plan_with(stochastic(drawn("a.u", uniform("-1", "1")) + drawn("b.u", uniform("-1", "1"))));
  return plan;
}

struct Run {
  Device device;
  std::vector<Search::Found> found;
  bool is_complete = false;

  explicit Run(Request request, const Plan& plan = continuous(), std::size_t most = 1'000'000)
      : device(most) {
    request.make_optimiser = make_optimiser();
    const SearchSpace space(plan.campaign(), plan.kinds());
    Search search(request, space, device);
    std::uint64_t next = 0;
    is_complete = search.run([&](std::uint64_t index) { CHECK(index == next++); });
    CHECK(next == device.size());
    found = search.found();
  }
};

}  // namespace

TEST_CASE("a search ends at the first failure, and needs fewer cases than random ones") {
  std::size_t searched = 0, random = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Run run({.seed = seed, .runs = 3000});
    REQUIRE(run.found.size() == 1);
    const CaseResult& failed = run.device.result(run.found.front().index);
    CHECK(failures_of(failed) == std::set<std::string>{run.found.front().failure});
    CHECK(run.device.size() - run.found.front().index <= run.device.batches.back());
    searched += run.device.size();
    random += Run({.method = Method::Random, .seed = seed, .runs = 3000}).device.size();
  }
  CHECK(3 * searched < random);
}

TEST_CASE("a search for all failures finds each once") {
  for (const Method method : {Method::CmaEs, Method::DifferentialEvolution}) {
    const Run run({.method = method, .runs = 3000, .finds_all = true});
    REQUIRE(run.found.size() == 2);
    CHECK(run.found[0].failure != run.found[1].failure);
  }
}

TEST_CASE("a search for one check minimises its margin alone") {
  const Run run({.runs = 3000, .check = "far"});
  REQUIRE(run.found.size() == 1);
  CHECK(run.found.front().failure == "far");
  CHECK_THAT(error_of([] { Run({.check = "fat"}); }),
             Contains("no check is called 'fat'") && Contains("the checks are 'near', 'far'"));
}

TEST_CASE("a search never runs more cases than it may, nor one twice") {
  for (const std::uint64_t runs : {1U, 2U, 17U, 100U}) {
    const Run run({.runs = runs, .check = "far", .finds_all = true});
    CHECK(run.is_complete);
    CHECK(run.device.size() <= runs);
    CHECK(std::set<Row>(run.device.rows.begin(), run.device.rows.end()).size() ==
          run.device.size());
  }
}

TEST_CASE("a search of few values ends when it has run all of them") {
  const Plan few = plan_with(
      deterministic(value_set("a.u", {"0.1", "0.2", "0.3"}) + value_set("b.u", {"0.1", "0.2"})));
  for (const Method method : kMethods) {
    const Run run({.method = method, .runs = 100}, few);
    CHECK(run.is_complete);
    CHECK(run.found.empty());
    CHECK(run.device.size() == 7);
  }
}

TEST_CASE("a search that is interrupted goes on as if it had not been") {
  const Run whole({.runs = 100, .finds_all = true});
  const Run part({.runs = 100, .finds_all = true}, continuous(), 40);
  CHECK_FALSE(part.is_complete);
  REQUIRE(part.device.size() > 1);
  for (std::size_t i = 0; i < part.device.size(); ++i) {
    CHECK(part.device.rows[i] == whole.device.rows[i]);
  }
}
