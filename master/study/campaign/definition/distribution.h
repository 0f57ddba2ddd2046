// The distributions of OpenSCENARIO, by their inverse cumulative distribution functions.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DISTRIBUTION_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_DISTRIBUTION_H

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "master/base/error.h"

namespace stride::campaign {

/// Limits of a number, both included.
struct Limits {
  double lower = 0;
  double upper = 0;
};

/// The distributions of numbers. Limits cut one off, and what is left is scaled: the distribution
/// under the condition that the number is within them.
struct Uniform {
  Limits limits;
};
struct Normal {
  double mean = 0;
  double variance = 0;  ///< 0: always the mean
  std::optional<Limits> limits;
};
/// Mean and variance are those of the number itself, not of its logarithm; the mean is above 0.
struct LogNormal {
  double mean = 1;
  double variance = 0;
  std::optional<Limits> limits;
};
struct Poisson {
  double mean = 1;  ///< above 0
  std::optional<Limits> limits;
};
/// Within a bin the number is uniform. Sorted, and no two overlap; weights are not all 0.
struct Histogram {
  struct Bin {
    Limits limits;
    double weight = 0;
  };
  std::vector<Bin> bins;
};

/// Texts with probabilities in proportion to their weights, which are not all 0.
struct ProbabilitySet {
  struct Element {
    std::string value;
    double weight = 0;
    core::Location where{};
  };
  std::vector<Element> elements;
};

using Distribution = std::variant<Uniform, Normal, LogNormal, Poisson, Histogram, ProbabilitySet>;

/// The number that is at most exceeded with the probability 1 - u; 0 < u < 1. Not of a
/// ProbabilitySet.
double quantile(const Distribution& distribution, double u);
/// Of a uniform distribution of whole numbers: each within the limits has the same probability.
/// There has to be one.
double whole_quantile(const Uniform& distribution, double u);
/// The element that is chosen.
std::size_t chosen_element(const ProbabilitySet& set, double u);

/// Whether there are values within its limits, as far as numbers of its kind can tell.
bool has_probability(const Distribution& distribution);

/// For people: "normal, mean 1, variance 0.1, from 0 to 2".
std::string to_text(const Distribution& distribution);

}  // namespace stride::campaign

#endif
