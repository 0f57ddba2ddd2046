#include "master/study/search/search_method.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/study/search/optimisers.h"

using namespace stride::search;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

using Function = std::function<double(const Point&)>;

/// From the unit cube to a cube around 0, whose minimum is put beside its middle.
double along(double u, double half) { return (2 * u - 1.17) * half; }

double sphere(const Point& point) {
  double sum = 0;
  for (const double u : point) sum += along(u, 5) * along(u, 5);
  return sum;
}

/// Minimum 0 in a bent valley.
double rosenbrock(const Point& point) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < point.size(); ++i) {
    const double x = along(point[i], 2), next = along(point[i + 1], 2);
    sum += 100 * std::pow(next - x * x, 2) + std::pow(1 - x, 2);
  }
  return sum;
}

/// Minimum 0 among hundreds of others.
double rastrigin(const Point& point) {
  double sum = 0;
  for (const double u : point) {
    const double x = along(u, 3);
    sum += x * x + 10 - 10 * std::cos(2 * std::numbers::pi * x);
  }
  return sum;
}

/// A narrow region below 0, without a trend in one of its parameters outside it.
double planted(const Point& point) {
  const double near = std::hypot(point[0] - 0.83, point[1] - 0.21);
  const bool is_late = point[2] > 0.7;
  return near - (is_late ? 0.05 : 0) + 0.01;
}

/// How many evaluations are needed for a value below the goal; `most` if it is not found.
std::size_t evaluations_to(double goal, const Function& function, Method method,
                           std::size_t dimensions, std::uint64_t seed, std::size_t most) {
  SearchMethod search(method, dimensions, seed, make_optimiser());
  std::size_t count = 0;
  while (count < most) {
    std::vector<double> values;
    for (const Point& point : search.ask()) {
      values.push_back(function(point));
      ++count;
      if (values.back() < goal) return count;
    }
    search.tell(values);
  }
  return most;
}

double median_evaluations(double goal, const Function& function, Method method,
                          std::size_t dimensions, std::size_t most) {
  constexpr int kSeeds = 20;
  std::vector<std::size_t> counts;
  for (int seed = 0; seed < kSeeds; ++seed) {
    counts.push_back(evaluations_to(goal, function, method, dimensions, seed, most));
  }
  std::ranges::sort(counts);
  return static_cast<double>(counts[kSeeds / 2 - 1] + counts[kSeeds / 2]) / 2;
}

}  // namespace

TEST_CASE("a search needs fewer values than random points, over 20 seeds") {
  struct Problem {
    const char* name;
    Function function;
    std::size_t dimensions;
    double goal;
    double factor;  ///< by how much fewer, at least
  };
  const Problem problems[] = {{"sphere", sphere, 4, 0.1, 50},
                              {"rosenbrock", rosenbrock, 3, 0.1, 15},
                              {"rastrigin", rastrigin, 3, 1, 10},
                              {"planted", planted, 3, 0, 4}};
  constexpr std::size_t kMost = 20'000;
  for (const auto& [name, function, dimensions, goal, factor] : problems) {
    const double random = median_evaluations(goal, function, Method::Random, dimensions, kMost);
    for (const Method method : {Method::CmaEs, Method::DifferentialEvolution}) {
      const double searched = median_evaluations(goal, function, method, dimensions, kMost);
      INFO(name << ": " << random << " random points, " << searched << " by "
                << stride::search::name(method));
      CHECK(searched * factor <= random);
    }
  }
}

TEST_CASE("points are in the unit cube, are new, and depend on the seed and the values alone") {
  for (const Method method : kMethods) {
    CAPTURE(name(method));
    MakeOptimiser* const make = make_optimiser();
    SearchMethod first(method, 3, 7, make), second(method, 3, 7, make), other(method, 3, 8, make);
    CHECK(first.ask() != other.ask());
    std::set<Point> seen;
    for (int generation = 0; generation < 300; ++generation) {
      const std::vector<Point> points = first.ask();
      REQUIRE_FALSE(points.empty());
      CHECK(points == first.ask());
      CHECK(points == second.ask());
      std::vector<double> values;
      for (const Point& point : points) {
        CHECK(seen.insert(point).second);
        REQUIRE(point.size() == 3);
        for (const double u : point) CHECK((0 <= u && u <= 1));
        values.push_back(rastrigin(point));
      }
      first.tell(values);
      second.tell(values);
    }
  }
}

TEST_CASE("a function without a trend is searched all the same") {
  for (const Method method : kMethods) {
    CAPTURE(name(method));
    for (const double value :
         {1.0, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
      SearchMethod search(method, 1, 1, make_optimiser());
      std::size_t count = 0;
      for (int generation = 0; generation < 100; ++generation) {
        const std::size_t asked = search.ask().size();
        count += asked;
        search.tell(std::vector<double>(asked, value));
      }
      CHECK(count >= 100);
    }
  }
}

TEST_CASE("a library with optimisers that cannot be loaded is an error") {
  CHECK_THAT(error_of([] { load_optimisers("/no/such/library.so"); }),
             Contains("cannot be loaded: /no/such/library.so") && Contains("libpagmo8"));
}
