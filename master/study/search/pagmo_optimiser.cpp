// The library with the optimisers: see optimiser.h.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "master/study/search/optimiser.h"

namespace stride::search {
namespace {

/// Worse than any value that an optimiser is told.
constexpr double kUnknown = std::numeric_limits<double>::max();

/// What is known of the function, and what was asked beside that.
struct Evaluations {
  std::map<Point, double> known;
  std::vector<Point> missing;
  std::size_t asked = 0;
};

/// The function as an optimiser of pagmo sees it: one that does not wait for values.
struct Rehearsal {
  std::shared_ptr<Evaluations> evaluations = std::make_shared<Evaluations>();
  std::size_t dimensions = 1;

  pagmo::vector_double fitness(const pagmo::vector_double& point) const {
    ++evaluations->asked;
    const auto known = evaluations->known.find(point);
    if (known != evaluations->known.end()) return {known->second};
    if (std::ranges::find(evaluations->missing, point) == evaluations->missing.end()) {
      evaluations->missing.push_back(point);
    }
    return {kUnknown};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimensions, 0), pagmo::vector_double(dimensions, 1)};
  }
};

pagmo::algorithm make_algorithm(OptimiserKind kind, unsigned seed) {
  constexpr double kTolerance = 1e-6;
  constexpr double kInitialStep = 0.3;
  if (kind == OptimiserKind::CmaEs) {
    return pagmo::algorithm(
        pagmo::cmaes(1, -1, -1, -1, -1, kInitialStep, kTolerance, kTolerance, true, true, seed));
  }
  return pagmo::algorithm(pagmo::de1220(1, pagmo::de1220_statics<void>::allowed_variants, 1,
                                        kTolerance, kTolerance, true, seed));
}

/// Within a generation no point depends on the value of another one, so a rehearsal on copies, in
/// which unknown values are bad ones, tells them all; when their values are there, the generation
/// is repeated in earnest.
class PagmoOptimiser final : public Optimiser {
 public:
  PagmoOptimiser(OptimiserKind kind, const FirstGeneration& first, unsigned seed)
      : algorithm_(make_algorithm(kind, seed)) {
    Rehearsal rehearsal{evaluations_, first.points.front().size()};
    population_ = pagmo::population(pagmo::problem(rehearsal), 0, seed);
    for (std::size_t i = 0; i < first.points.size(); ++i) {
      const double value = std::min(first.values[i], kUnknown);
      evaluations_->known[first.points[i]] = value;
      population_.push_back(first.points[i], {value});
    }
  }

  /// A generation whose points are all known is passed over.
  std::vector<Point> ask() override {
    while (evaluations_->missing.empty()) {
      evaluations_->asked = 0;
      pagmo::algorithm algorithm = algorithm_;
      pagmo::population next = algorithm.evolve(population_);
      if (!evaluations_->missing.empty()) break;
      if (evaluations_->asked == 0) return {};
      algorithm_ = std::move(algorithm);
      population_ = std::move(next);
    }
    return evaluations_->missing;
  }

  void tell(std::span<const double> values) override {
    std::vector<Point>& missing = evaluations_->missing;
    for (std::size_t i = 0; i < missing.size(); ++i) {
      evaluations_->known[missing[i]] = std::min(values[i], kUnknown);
    }
    missing.clear();
  }

 private:
  std::shared_ptr<Evaluations> evaluations_ = std::make_shared<Evaluations>();
  pagmo::algorithm algorithm_;
  pagmo::population population_;
};

}  // namespace
}  // namespace stride::search

extern "C" __attribute__((visibility("default"))) stride::search::Optimiser* stride_make_optimiser(
    stride::search::OptimiserKind kind, const stride::search::FirstGeneration& first,
    unsigned seed) {
  return new stride::search::PagmoOptimiser(kind, first, seed);
}
