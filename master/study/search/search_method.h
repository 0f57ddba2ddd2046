// Which points a search looks at next.
#ifndef STRIDE_MASTER_STUDY_SEARCH_SEARCH_METHOD_H
#define STRIDE_MASTER_STUDY_SEARCH_SEARCH_METHOD_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "master/study/search/optimiser.h"

namespace stride::search {

enum class Method {
  CmaEs,                  ///< covariance matrix adaptation (Hansen 2006), with restarts of larger
                          ///< populations (Auger and Hansen 2005)
  DifferentialEvolution,  ///< with self-adapted parameters and variants; with restarts
  Random,                 ///< independent points, which is what the others are compared with
};
const char* name(Method method);
inline constexpr Method kMethods[] = {Method::CmaEs, Method::DifferentialEvolution, Method::Random};

/// Minimises a function that is known by its values only. Its points depend on the arguments and on
/// the values that it is told, and on nothing else. What it asks for at once may be evaluated at
/// the same time.
class SearchMethod {
 public:
  /// There is a dimension at least. `make`: of the library with the optimisers; the random method
  /// needs none.
  SearchMethod(Method method, std::size_t dimensions, std::uint64_t seed, MakeOptimiser* make);

  /// New points, one at least, and a generation at most.
  std::vector<Point> ask();
  /// Their values, in the order of ask(), before it is called again. Not NaN.
  void tell(std::span<const double> values);

 private:
  std::vector<Point> first_points() const;

  Method method_;
  std::size_t dimensions_;
  std::uint64_t seed_;
  MakeOptimiser* make_;
  unsigned restarts_ = 0;
  std::unique_ptr<Optimiser> optimiser_;  ///< null where the first points are asked for
};

}  // namespace stride::search

#endif
