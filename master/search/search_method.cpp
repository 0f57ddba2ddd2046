#include "master/search/search_method.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "master/campaign/random.h"

namespace stride::search {
namespace {

/// Worse than any value that a search is told.
constexpr double kUnknown = std::numeric_limits<double>::max();

/// Of the population of each restart.
constexpr unsigned kMostDoublings = 6;

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

std::size_t least_population(Method method, std::size_t dimensions) {
  constexpr std::size_t kLeast = 8;
  const auto count = static_cast<double>(dimensions);
  if (method == Method::CmaEs) {
    return std::max(kLeast, 4 + static_cast<std::size_t>(3 * std::log(count)));
  }
  return std::clamp<std::size_t>(5 * dimensions, 2 * kLeast, 50);
}

}  // namespace

const char* name(Method method) {
  switch (method) {
    case Method::CmaEs:
      return "cma-es";
    case Method::DifferentialEvolution:
      return "differential-evolution";
    case Method::Random:
      break;
  }
  return "random";
}

/// Runs an optimiser generation by generation. Within a generation no point depends on the value
/// of another one, so a rehearsal on copies, in which unknown values are bad ones, tells them all;
/// when their values are there, the generation is repeated in earnest.
class SearchMethod::Generations {
 public:
  Generations(Method method, std::size_t dimensions, std::uint64_t seed)
      : method_(method), dimensions_(dimensions), seed_(seed) {
    rehearsal_.dimensions = dimensions;
  }

  std::vector<Point> ask() {
    Evaluations& evaluations = *rehearsal_.evaluations;
    while (evaluations.missing.empty()) {
      if (method_ == Method::Random || !population_) {
        begin();
      } else {
        go_on();
      }
    }
    return evaluations.missing;
  }

  void tell(std::span<const double> values) {
    Evaluations& evaluations = *rehearsal_.evaluations;
    for (std::size_t i = 0; i < evaluations.missing.size(); ++i) {
      evaluations.known[evaluations.missing[i]] = std::min(values[i], kUnknown);
    }
    evaluations.missing.clear();
  }

 private:
  /// A first generation, which is spread at random; where its values are known, the optimiser
  /// that begins with it.
  void begin() {
    const bool grows = method_ != Method::Random;
    const unsigned doublings = grows ? std::min(restarts_, kMostDoublings) : 0;
    const std::size_t size = least_population(method_, dimensions_) << doublings;
    pagmo::population fresh(pagmo::problem(rehearsal_), 0, number_for("population"));
    for (std::size_t i = 0; i < size; ++i) {
      const Point point = random_point(i);
      fresh.push_back(point, rehearsal_.fitness(point));
    }
    if (!rehearsal_.evaluations->missing.empty()) return;
    if (method_ == Method::Random) {
      ++restarts_;
      return;
    }
    population_ = std::make_unique<pagmo::population>(std::move(fresh));
    optimiser_ = make_optimiser();
  }

  void go_on() {
    Evaluations& evaluations = *rehearsal_.evaluations;
    evaluations.asked = 0;
    pagmo::algorithm optimiser = optimiser_;
    pagmo::population next = optimiser.evolve(*population_);
    if (!evaluations.missing.empty()) return;
    if (evaluations.asked == 0) {  // it has converged
      ++restarts_;
      population_.reset();
      return;
    }
    optimiser_ = std::move(optimiser);
    *population_ = std::move(next);
  }

  pagmo::algorithm make_optimiser() const {
    const unsigned seed = number_for("optimiser");
    constexpr double kTolerance = 1e-6;
    constexpr double kInitialStep = 0.3;
    if (method_ == Method::CmaEs) {
      return pagmo::algorithm(
          pagmo::cmaes(1, -1, -1, -1, -1, kInitialStep, kTolerance, kTolerance, true, true, seed));
    }
    return pagmo::algorithm(pagmo::de1220(1, pagmo::de1220_statics<void>::allowed_variants, 1,
                                          kTolerance, kTolerance, true, seed));
  }

  unsigned number_for(const char* purpose) const {
    return static_cast<unsigned>(campaign::RandomStream(seed_, purpose).bits(restarts_));
  }

  Point random_point(std::size_t index) const {
    const campaign::RandomStream stream(seed_, "first points " + std::to_string(restarts_));
    Point point(dimensions_);
    for (std::size_t i = 0; i < dimensions_; ++i) {
      point[i] = stream.uniform(index * dimensions_ + i);
    }
    return point;
  }

  Method method_;
  std::size_t dimensions_;
  std::uint64_t seed_;
  unsigned restarts_ = 0;
  Rehearsal rehearsal_;
  std::unique_ptr<pagmo::population> population_;  ///< null: none is known
  pagmo::algorithm optimiser_;
};

SearchMethod::SearchMethod(Method method, std::size_t dimensions, std::uint64_t seed)
    : generations_(std::make_unique<Generations>(method, dimensions, seed)) {}
SearchMethod::~SearchMethod() = default;
SearchMethod::SearchMethod(SearchMethod&&) noexcept = default;
SearchMethod& SearchMethod::operator=(SearchMethod&&) noexcept = default;

std::vector<Point> SearchMethod::ask() { return generations_->ask(); }

void SearchMethod::tell(std::span<const double> values) { generations_->tell(values); }

}  // namespace stride::search
