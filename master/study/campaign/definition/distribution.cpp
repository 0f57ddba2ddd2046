#include "master/study/campaign/definition/distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <fmt/format.h>

#include "master/base/text/counted.h"

namespace stride::campaign {
namespace {

namespace bm = boost::math;

/// In double precision on every machine; a Poisson quantile is the least number that is good
/// enough; what is out of range is infinite or 0 instead of an exception.
using MathPolicy =
    bm::policies::policy<bm::policies::promote_double<false>,
                         bm::policies::discrete_quantile<bm::policies::integer_round_up>,
                         bm::policies::overflow_error<bm::policies::ignore_error>,
                         bm::policies::underflow_error<bm::policies::ignore_error>>;
using NormalLaw = bm::normal_distribution<double, MathPolicy>;
using PoissonLaw = bm::poisson_distribution<double, MathPolicy>;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// The probabilities below both limits, or above them where these are more exact.
struct Tails {
  bool are_upper = false;
  double at_lower = 0;
  double at_upper = 1;

  double between() const { return std::abs(at_upper - at_lower); }
  double at(double u) const { return at_lower + u * (at_upper - at_lower); }
};

Tails normal_tails(const NormalLaw& law, const Limits& limits) {
  if (limits.lower <= law.mean()) {
    return {false, bm::cdf(law, limits.lower), bm::cdf(law, limits.upper)};
  }
  return {true, bm::cdf(bm::complement(law, limits.lower)),
          bm::cdf(bm::complement(law, limits.upper))};
}

double limited_quantile(const NormalLaw& law, const Limits& limits, double u) {
  const Tails tails = normal_tails(law, limits);
  const double p = tails.at(u);
  const double x = tails.are_upper ? bm::quantile(bm::complement(law, p)) : bm::quantile(law, p);
  return std::clamp(x, limits.lower, limits.upper);
}

Limits limits_or_none(const std::optional<Limits>& limits) {
  return limits.value_or(Limits{-kNoLimit, kNoLimit});
}

NormalLaw law_of(const Normal& normal) {
  return NormalLaw(normal.mean, std::sqrt(normal.variance));
}

/// Of the logarithm; not finite, or 0, where the numbers are too far apart.
double log_variance(const LogNormal& log_normal) {
  return std::log1p(log_normal.variance / log_normal.mean / log_normal.mean);
}

NormalLaw law_of(const LogNormal& log_normal) {
  const double variance = log_variance(log_normal);
  return NormalLaw(std::log(log_normal.mean) - variance / 2, std::sqrt(variance));
}

Limits logarithms(const std::optional<Limits>& limits) {
  const auto [lower, upper] = limits.value_or(Limits{0, kNoLimit});
  return {lower <= 0 ? -kNoLimit : std::log(lower), upper <= 0 ? -kNoLimit : std::log(upper)};
}

bool contains(const std::optional<Limits>& limits, double number) {
  return !limits || (limits->lower <= number && number <= limits->upper);
}

/// Whole numbers only.
Limits whole_limits(const std::optional<Limits>& limits) {
  const auto [lower, upper] = limits.value_or(Limits{0, kNoLimit});
  return {std::max(0.0, std::ceil(lower)), std::floor(upper)};
}

Tails poisson_tails(const PoissonLaw& law, const Limits& whole) {
  const double below = whole.lower < 1 ? 0 : bm::cdf(law, whole.lower - 1);
  if (whole.lower <= law.mean()) {
    return {false, below, std::isfinite(whole.upper) ? bm::cdf(law, whole.upper) : 1};
  }
  return {true, bm::cdf(bm::complement(law, whole.lower - 1)),
          std::isfinite(whole.upper) ? bm::cdf(bm::complement(law, whole.upper)) : 0};
}

/// The place whose share of the sum holds u, and how far into it u is, from 0 to 1.
struct Share {
  std::size_t place = 0;
  double within = 0;
};

template <class Weighted>
Share share_at(const std::vector<Weighted>& items, double u) {
  double sum = 0;
  for (const Weighted& item : items) sum += item.weight;
  double rest = u * sum;
  std::size_t last = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].weight == 0) continue;
    last = i;
    if (rest < items[i].weight) return {i, rest / items[i].weight};
    rest -= items[i].weight;
  }
  return {last, 1};  // by rounding
}

double between(const Limits& limits, double share) {
  const double number = std::lerp(limits.lower, limits.upper, share);
  return std::clamp(number, limits.lower, limits.upper);
}

struct Quantile {
  double u;

  double operator()(const Uniform& uniform) const { return between(uniform.limits, u); }
  double operator()(const Normal& normal) const {
    if (normal.variance == 0) return normal.mean;
    return limited_quantile(law_of(normal), limits_or_none(normal.limits), u);
  }
  double operator()(const LogNormal& log_normal) const {
    if (log_variance(log_normal) == 0) return log_normal.mean;
    const double x =
        std::exp(limited_quantile(law_of(log_normal), logarithms(log_normal.limits), u));
    const auto& limits = log_normal.limits;
    return limits ? std::clamp(x, limits->lower, limits->upper) : x;
  }
  double operator()(const Poisson& poisson) const {
    const PoissonLaw law(poisson.mean);
    const Limits whole = whole_limits(poisson.limits);
    const Tails tails = poisson_tails(law, whole);
    const double p = tails.at(u);
    const double x = tails.are_upper ? bm::quantile(bm::complement(law, p)) : bm::quantile(law, p);
    return std::clamp(x, whole.lower, whole.upper);
  }
  double operator()(const Histogram& histogram) const {
    const auto [place, within] = share_at(histogram.bins, u);
    return between(histogram.bins[place].limits, within);
  }
  double operator()(const ProbabilitySet&) const { return std::nan(""); }
};

struct HasProbability {
  bool operator()(const Normal& normal) const {
    if (normal.variance == 0) return contains(normal.limits, normal.mean);
    return normal_tails(law_of(normal), limits_or_none(normal.limits)).between() > 0;
  }
  bool operator()(const LogNormal& log_normal) const {
    const double variance = log_variance(log_normal);
    if (variance == 0) return contains(log_normal.limits, log_normal.mean);
    if (!std::isfinite(variance)) return false;
    return normal_tails(law_of(log_normal), logarithms(log_normal.limits)).between() > 0;
  }
  bool operator()(const Poisson& poisson) const {
    const Limits whole = whole_limits(poisson.limits);
    return whole.lower <= whole.upper &&
           poisson_tails(PoissonLaw(poisson.mean), whole).between() > 0;
  }
  template <class Other>
  bool operator()(const Other&) const {
    return true;
  }
};

std::string limits_text(const std::optional<Limits>& limits) {
  return limits ? fmt::format(", from {} to {}", limits->lower, limits->upper) : "";
}

struct InWords {
  std::string operator()(const Uniform& uniform) const {
    return fmt::format("uniform, from {} to {}", uniform.limits.lower, uniform.limits.upper);
  }
  std::string operator()(const Normal& normal) const {
    return fmt::format("normal, mean {}, variance {}{}", normal.mean, normal.variance,
                       limits_text(normal.limits));
  }
  std::string operator()(const LogNormal& log_normal) const {
    return fmt::format("log-normal, mean {}, variance {}{}", log_normal.mean, log_normal.variance,
                       limits_text(log_normal.limits));
  }
  std::string operator()(const Poisson& poisson) const {
    return fmt::format("Poisson, mean {}{}", poisson.mean, limits_text(poisson.limits));
  }
  std::string operator()(const Histogram& histogram) const {
    return fmt::format("histogram, {} from {} to {}", core::counted(histogram.bins.size(), "bin"),
                       histogram.bins.front().limits.lower, histogram.bins.back().limits.upper);
  }
  std::string operator()(const ProbabilitySet& set) const {
    std::string text;
    for (const auto& [value, weight, where] : set.elements) {
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", value, weight);
    }
    return text;
  }
};

}  // namespace

double quantile(const Distribution& distribution, double u) {
  return std::visit(Quantile{u}, distribution);
}

double whole_quantile(const Uniform& distribution, double u) {
  const double first = std::ceil(distribution.limits.lower);
  const double last = std::floor(distribution.limits.upper);
  return std::min(first + std::floor(u * (last - first + 1)), last);
}

std::size_t chosen_element(const ProbabilitySet& set, double u) {
  return share_at(set.elements, u).place;
}

bool has_probability(const Distribution& distribution) {
  return std::visit(HasProbability{}, distribution);
}

std::string to_text(const Distribution& distribution) {
  return std::visit(InWords{}, distribution);
}

}  // namespace stride::campaign
