#include "master/study/campaign/definition/aggregates.h"

#include <catch2/catch.hpp>

#include "master/study/campaign/campaign_scenario.h"
#include "tests/master/study/campaign/support.h"

using namespace stride;
using namespace stride::campaign;
using namespace stride::tests;
using Function = Aggregate::Function;

namespace {

/// Of a signal that has these values at these times [s].
std::optional<double> aggregate(Function function, double at,
                                std::initializer_list<std::pair<double, double>> points,
                                const std::string& signal = "b.y") {
  const CampaignFolder folder(campaign_text(stochastic(drawn("b.u", uniform("0", "1")))));
  const CampaignScenario scenario(folder.read(), "1.0");
  Aggregates aggregates({{"x", signal, function, time_from_seconds(at), {}}},
                        scenario.loaded().system());
  const core::Variable& variable =
      scenario.loaded().system().variable(aggregates.signals().front());
  core::ValueBlock block(variable.type, 1);
  const core::Signal observed{aggregates.signals().front(), &block, 0};
  aggregates.on_start({&observed, 1});
  for (const auto& [time, value] : points) {
    if (variable.type == core::ValueType::Boolean) {
      block.numbers<bool>()[0] = value != 0;
    } else {
      block.numbers<double>()[0] = value;
    }
    aggregates.on_communication_point(time_from_seconds(time));
  }
  return aggregates.values().front();
}

}  // namespace

TEST_CASE("the extreme values and the last one") {
  CHECK(aggregate(Function::Min, 0, {{0, 3}, {1, -2}, {2, 1}}) == -2.0);
  CHECK(aggregate(Function::Max, 0, {{0, -3}, {1, -2}, {2, -5}}) == -2.0);
  CHECK(aggregate(Function::Final, 0, {{0, 3}, {1, -2}, {2, 1}}) == 1.0);
}

TEST_CASE("mean and integral are weighted with the time") {
  CHECK(aggregate(Function::Integral, 0, {{1, 0}, {2, 2}, {4, 4}}) == 7.0);
  CHECK(aggregate(Function::Mean, 0, {{1, 0}, {2, 2}, {4, 4}}) == Approx(7.0 / 3));
  CHECK(aggregate(Function::Mean, 0, {{1, 5}}) == 5.0);
  CHECK(aggregate(Function::Integral, 0, {{1, 5}}) == 0.0);
}

TEST_CASE("at an instant it is the value of the last point that is not later") {
  CHECK(aggregate(Function::At, 1.5, {{0, 3}, {1, 4}, {2, 5}}) == 4.0);
  CHECK(aggregate(Function::At, 2, {{0, 3}, {1, 4}, {2, 5}}) == 5.0);
  CHECK(aggregate(Function::At, 2.5, {{0, 3}, {1, 4}, {2, 5}}) == std::nullopt);
}

TEST_CASE("a run without a communication point has no aggregates") {
  for (const Function function : kAggregateFunctions) {
    CHECK(aggregate(function, 0, {}) == std::nullopt);
  }
}

TEST_CASE("a boolean counts as 0 or 1, and a text is refused") {
  CHECK(aggregate(Function::Mean, 0, {{0, 1}, {1, 1}, {2, 0}, {4, 0}}, "a.boolean") ==
        Approx(1.5 / 4));
  CHECK_THROWS_WITH(aggregate(Function::Final, 0, {}, "a.string"),
                    Catch::Contains("'a.string' is not a signal with a number"));
}
