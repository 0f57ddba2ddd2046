// Which points a search looks at next.
#ifndef STRIDE_MASTER_SEARCH_SEARCH_METHOD_H
#define STRIDE_MASTER_SEARCH_SEARCH_METHOD_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace stride::search {

/// Of the unit cube, its faces included.
using Point = std::vector<double>;

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
  /// There is a dimension at least.
  SearchMethod(Method method, std::size_t dimensions, std::uint64_t seed);
  ~SearchMethod();
  SearchMethod(SearchMethod&&) noexcept;
  SearchMethod& operator=(SearchMethod&&) noexcept;

  /// New points, one at least, and a generation at most.
  std::vector<Point> ask();
  /// Their values, in the order of ask(), before it is called again. Not NaN.
  void tell(std::span<const double> values);

 private:
  class Generations;
  std::unique_ptr<Generations> generations_;
};

}  // namespace stride::search

#endif
