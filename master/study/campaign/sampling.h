// The points of a stochastic campaign in the unit cube, from which quantiles make values.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_SAMPLING_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_SAMPLING_H

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/study/campaign/definition/definition.h"

namespace stride::campaign {

class RandomStream;

/// How many parameters the method can spread at most.
std::size_t most_dimensions(SamplingMethod method);

/// Each coordinate of a point is above 0 and below 1. A point is a function of its index, whatever
/// other points are asked for; an object may be used by several threads.
///
/// Independent: all coordinates are. LatinHypercube: of `count` points each coordinate has one in
/// each of `count` equal intervals. Sobol: the sequence of Joe and Kuo (2008) in the order of
/// Gray's code, shifted by an exclusive or with random bits in each dimension; each coordinate has
/// one of the first 2^m points in each of 2^m equal intervals.
class Sampling {
 public:
  /// A dimension for each name, on which its random numbers depend. Throws std::invalid_argument
  /// for more than most_dimensions().
  Sampling(SamplingMethod method, std::uint64_t seed, std::span<const std::string> names,
           std::uint64_t count);
  ~Sampling();
  Sampling(Sampling&&) noexcept;
  Sampling& operator=(Sampling&&) noexcept;

  std::vector<double> point(std::uint64_t index) const;

 private:
  struct SobolSequence;

  SamplingMethod method_;
  std::uint64_t count_;
  std::vector<RandomStream> streams_;  ///< one of each dimension
  std::unique_ptr<const SobolSequence> sobol_;
};

}  // namespace stride::campaign

#endif
