// Random numbers that are functions of a key and a place: whatever else is asked, and in whatever
// order, they are the same.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_RANDOM_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_RANDOM_H

#include <cstdint>
#include <string_view>

namespace stride::campaign {

/// The numbers of one purpose of a campaign: Philox4x64-10 (Salmon, Moraes, Dror, Shaw: "Parallel
/// random numbers: as easy as 1, 2, 3", SC11), whose key is the seed, and whose counter the purpose
/// and the place.
class RandomStream {
 public:
  /// The purpose is a text, such as the name of a parameter; 64 bits of its SHA-256 stand for it.
  RandomStream(std::uint64_t seed, std::string_view purpose);

  std::uint64_t bits(std::uint64_t place) const { return bits(place, 0); }
  /// Above 0 and below 1; a multiple of 2^-53.
  double uniform(std::uint64_t place) const;
  /// The place that `place` gets by a permutation of 0 … count - 1; both are below 2^32.
  std::uint64_t permuted(std::uint64_t place, std::uint64_t count) const;

 private:
  std::uint64_t bits(std::uint64_t place, std::uint64_t round) const;

  std::uint64_t seed_;
  std::uint64_t purpose_;
};

}  // namespace stride::campaign

#endif
