#include "master/study/search/search_method.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "master/study/campaign/random.h"

namespace stride::search {
namespace {

/// Of the population of each restart.
constexpr unsigned kMostDoublings = 6;

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
      return "de";
    case Method::Random:
      break;
  }
  return "random";
}

SearchMethod::SearchMethod(Method method, std::size_t dimensions, std::uint64_t seed,
                           MakeOptimiser* make)
    : method_(method), dimensions_(dimensions), seed_(seed), make_(make) {}

std::vector<Point> SearchMethod::ask() {
  if (optimiser_) {
    std::vector<Point> points = optimiser_->ask();
    if (!points.empty()) return points;
    optimiser_.reset();  // it has converged
    ++restarts_;
  }
  return first_points();
}

void SearchMethod::tell(std::span<const double> values) {
  if (optimiser_) return optimiser_->tell(values);
  if (method_ == Method::Random) {
    ++restarts_;
    return;
  }
  const OptimiserKind kind =
      method_ == Method::CmaEs ? OptimiserKind::CmaEs : OptimiserKind::DifferentialEvolution;
  const auto seed =
      static_cast<unsigned>(campaign::RandomStream(seed_, "optimiser").bits(restarts_));
  optimiser_.reset(make_(kind, {first_points(), {values.begin(), values.end()}}, seed));
}

std::vector<Point> SearchMethod::first_points() const {
  const bool grows = method_ != Method::Random;
  const unsigned doublings = grows ? std::min(restarts_, kMostDoublings) : 0;
  std::vector<Point> points(least_population(method_, dimensions_) << doublings);
  const campaign::RandomStream stream(seed_, "first points " + std::to_string(restarts_));
  std::uint64_t place = 0;
  for (Point& point : points) {
    for (std::size_t i = 0; i < dimensions_; ++i) point.push_back(stream.uniform(place++));
  }
  return points;
}

}  // namespace stride::search
