#include "master/study/campaign/evaluation/statistics.h"

#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace stride::campaign;

namespace {

const double kNotKnown = std::numeric_limits<double>::quiet_NaN();

void check_share(std::uint64_t hits, std::uint64_t count, double low, double high) {
  const Confidence found = share_confidence(hits, count);
  INFO(hits << " of " << count);
  CHECK(found.low == Approx(low).margin(5e-5));
  CHECK(found.high == Approx(high).margin(5e-5));
}

}  // namespace

TEST_CASE("equal values share the mean of their places") {
  CHECK(mid_ranks(std::vector<double>{30, 10, 20, 10}) == std::vector<double>{4, 1.5, 3, 1.5});
  CHECK(mid_ranks(std::vector<double>{5, 5, 5}) == std::vector<double>{2, 2, 2});
  CHECK(mid_ranks(std::vector<double>{}).empty());
}

TEST_CASE("Spearman's rank correlation without ties is that of the differences of places") {
  // 1 - 6 * 194 / (10 * 99)
  const std::vector<double> x{106, 100, 86, 101, 99, 103, 97, 113, 112, 110};
  const std::vector<double> y{7, 27, 2, 50, 28, 29, 20, 12, 6, 17};
  const RankCorrelation found = rank_correlation(x, y);
  CHECK(found.count == 10);
  CHECK(found.value.value() == Approx(-29.0 / 165));
  // tanh(atanh(r) -+ 1.959964 sqrt((1 + r^2 / 2) / 7))
  CHECK(found.confidence.value().low == Approx(-0.7278300282));
  CHECK(found.confidence.value().high == Approx(0.5145466617));
}

TEST_CASE("Spearman's rank correlation with ties is that of Pearson of the mid-ranks") {
  const std::vector<double> x{1, 2, 3, 4, 5, 6, 7, 8}, y{0, 0, 0, 1, 0, 1, 1, 1};
  const RankCorrelation found = rank_correlation(x, y);
  CHECK(found.value.value() == Approx(0.7637626158));
  CHECK(found.confidence.value().low == Approx(0.0090023633));
  CHECK(found.confidence.value().high == Approx(0.9641238835));
}

TEST_CASE("a rank correlation does not depend on monotonous changes, and infinities have ranks") {
  const std::vector<double> x{1, 4, 2, 3}, y{10, 30, 40, 20};
  const double before = rank_correlation(x, y).value.value();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> changed{-infinity, std::exp(4), 0, std::exp(3)};
  CHECK(rank_correlation(changed, y).value.value() == before);
}

TEST_CASE("what is not known has no part in a rank correlation") {
  const std::vector<double> x{1, 2, kNotKnown, 3, 4}, y{1, 2, 9, kNotKnown, 3};
  const RankCorrelation found = rank_correlation(x, y);
  CHECK(found.count == 3);
  CHECK(found.value == 1);
  CHECK_FALSE(found.confidence.has_value());  // three, and all in one order
  CHECK_FALSE(rank_correlation(std::vector<double>{1, 1, 1}, std::vector<double>{1, 2, 3}).value);
  CHECK(rank_correlation(std::vector<double>{kNotKnown}, std::vector<double>{1}).count == 0);
}

TEST_CASE("confidence intervals of shares are those of Wilson") {
  // Newcombe, "Two-sided confidence intervals for the single proportion", Statistics in Medicine 17
  // (1998), table I
  check_share(81, 263, 0.2553, 0.3662);
  check_share(15, 148, 0.0624, 0.1605);
  check_share(0, 20, 0, 0.1611);
  check_share(1, 29, 0.0061, 0.1718);
  CHECK(share_confidence(0, 3).low == 0);
  CHECK(share_confidence(3, 3).high == 1);
}
