// What a sample says about what it was drawn from, and how sure that is.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_STATISTICS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_EVALUATION_STATISTICS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stride::campaign {

/// Limits of a confidence interval of 95 %.
struct Confidence {
  double low = 0;
  double high = 0;
};

/// The place of each value among the sorted ones, from 1 on; equal values share the mean of their
/// places. No value is NaN.
std::vector<double> mid_ranks(std::span<const double> values);

/// Spearman's rank correlation: that of Pearson of the mid-ranks, so ties are allowed.
struct RankCorrelation {
  std::size_t count = 0;                 ///< of the pairs
  std::optional<double> value;           ///< from -1 to 1; empty where one of both does not vary
  std::optional<Confidence> confidence;  ///< empty with fewer than 4 pairs, and where it is ±1
};

/// Of the pairs in which neither is NaN; both have as many values. The interval is that of Fisher's
/// transformation, with the variance (1 + r^2 / 2) / (n - 3): Bonett and Wright, "Sample size
/// requirements for estimating Pearson, Kendall and Spearman correlations", Psychometrika 65
/// (2000), 23-28. It is an approximation, the rougher the more ties there are.
RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y);

/// Of the share of `hits` in `count` trials, which is not 0: the score interval of Wilson,
/// "Probable inference, the law of succession, and statistical inference", JASA 22 (1927), 209-212,
/// without correction for continuity.
Confidence share_confidence(std::uint64_t hits, std::uint64_t count);

}  // namespace stride::campaign

#endif
