// An optimiser of pagmo. It is in a library of its own, which a program loads when it searches:
// with pagmo it would begin 27 ms later, and have 16 MiB more to share with each case that it
// forks.
#ifndef STRIDE_MASTER_STUDY_SEARCH_OPTIMISER_H
#define STRIDE_MASTER_STUDY_SEARCH_OPTIMISER_H

#include <filesystem>
#include <span>
#include <vector>

namespace stride::search {

/// Of the unit cube, its faces included.
using Point = std::vector<double>;

/// Minimises a function that is known by its values only, generation by generation.
class Optimiser {
 public:
  virtual ~Optimiser() = default;
  /// The new points of the next generation; none if it has converged.
  virtual std::vector<Point> ask() = 0;
  /// Their values, in that order, before ask() is called again. Not NaN.
  virtual void tell(std::span<const double> values) = 0;
};

enum class OptimiserKind { CmaEs, DifferentialEvolution };

/// What an optimiser begins with: points, all different, and their values.
struct FirstGeneration {
  std::vector<Point> points;
  std::vector<double> values;
};

/// The function of the library, which returns a new object.
using MakeOptimiser = Optimiser*(OptimiserKind kind, const FirstGeneration& first, unsigned seed);
inline constexpr const char* kMakeOptimiser = "stride_make_optimiser";

/// Where the library is in a build and in an installation: in ../lib/stride beside the program.
std::filesystem::path optimiser_library();
/// Loads it; it stays until the process ends. Throws core::Error (Input) if that is not possible.
MakeOptimiser& load_optimisers(const std::filesystem::path& library);

}  // namespace stride::search

#endif
