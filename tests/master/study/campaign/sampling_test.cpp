#include "master/study/campaign/sampling.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <boost/random/sobol.hpp>
#include <catch2/catch.hpp>

#include "master/study/campaign/random.h"
#include "tests/error_of.h"

using namespace stride::campaign;

namespace {

std::vector<std::string> names(std::size_t count) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < count; ++i) list.push_back("p" + std::to_string(i));
  return list;
}

std::vector<std::vector<double>> points(const Sampling& sampling, std::uint64_t count) {
  std::vector<std::vector<double>> all;
  for (std::uint64_t i = 0; i < count; ++i) all.push_back(sampling.point(i));
  return all;
}

/// Each of `count` equal intervals has one point.
bool is_stratified(const std::vector<std::vector<double>>& points, std::size_t dimension) {
  std::set<std::size_t> intervals;
  for (const auto& point : points) {
    intervals.insert(
        static_cast<std::size_t>(point[dimension] * static_cast<double>(points.size())));
  }
  return intervals.size() == points.size();
}

/// Warnock's formula for the L2 star discrepancy.
double discrepancy(const std::vector<std::vector<double>>& points) {
  const auto n = static_cast<double>(points.size());
  const auto dimensions = static_cast<double>(points.front().size());
  double single = 0, pairs = 0;
  for (const auto& x : points) {
    double product = 1;
    for (const double c : x) product *= 1 - c * c;
    single += product;
    for (const auto& y : points) {
      double both = 1;
      for (std::size_t k = 0; k < x.size(); ++k) both *= 1 - std::max(x[k], y[k]);
      pairs += both;
    }
  }
  return std::sqrt(std::pow(3, -dimensions) - std::pow(2, 1 - dimensions) / n * single +
                   pairs / n / n);
}

}  // namespace

TEST_CASE("a Latin hypercube has one point in each interval of each parameter") {
  for (const std::uint64_t count : {1, 7, 100, 1000}) {
    const Sampling sampling(SamplingMethod::LatinHypercube, 5, names(4), count);
    const auto all = points(sampling, count);
    for (std::size_t k = 0; k < 4; ++k) {
      CAPTURE(count, k);
      CHECK(is_stratified(all, k));
    }
  }
  const Sampling independent(SamplingMethod::Independent, 5, names(1), 100);
  CHECK_FALSE(is_stratified(points(independent, 100), 0));
}

TEST_CASE("the coordinates of a Latin hypercube do not depend on each other") {
  const Sampling sampling(SamplingMethod::LatinHypercube, 5, names(2), 1000);
  double sum = 0;
  for (const auto& point : points(sampling, 1000)) sum += (point[0] - 0.5) * (point[1] - 0.5);
  CHECK(std::abs(sum / 1000 * 12) < 0.1);  // the correlation
}

TEST_CASE("Sobol's sequence has the points of its authors, shifted") {
  const std::vector<std::string> three = names(3);
  const Sampling sampling(SamplingMethod::Sobol, 11, three, 64);
  std::vector<std::uint64_t> shifts;
  for (const std::string& name : three) shifts.push_back(RandomStream(11, "shift " + name).bits(0));
  const double expected[][3] = {{0, 0, 0},          {0.5, 0.5, 0.5},       {0.75, 0.25, 0.25},
                                {0.25, 0.75, 0.75}, {0.375, 0.375, 0.625}, {0.875, 0.875, 0.125}};
  for (std::uint64_t i = 0; i < 6; ++i) {
    const auto point = sampling.point(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto bits = static_cast<std::uint64_t>(expected[i][k] * 0x1p32) << 32;
      CAPTURE(i, k);
      CHECK(std::abs(point[k] - static_cast<double>((bits ^ shifts[k]) >> 12) * 0x1p-52) < 1e-15);
    }
  }
}

TEST_CASE("a power of two of Sobol's points is spread in each parameter, and in pairs") {
  const Sampling sampling(SamplingMethod::Sobol, 3, names(10), 256);
  const auto all = points(sampling, 256);
  for (std::size_t k = 0; k < 10; ++k) CHECK(is_stratified(all, k));
  std::set<std::pair<int, int>> cells;  // of the first two, a (0, 8, 2)-net
  for (const auto& point : all) {
    cells.emplace(static_cast<int>(16 * point[0]), static_cast<int>(16 * point[1]));
  }
  CHECK(cells.size() == 256);
}

TEST_CASE(
    "Sobol's points have a lower discrepancy than a Latin hypercube's, and these than others") {
  const auto of = [](SamplingMethod method) {
    return discrepancy(points(Sampling(method, 3, names(3), 512), 512));
  };
  const double independent = of(SamplingMethod::Independent);
  CHECK(of(SamplingMethod::LatinHypercube) < independent);
  CHECK(of(SamplingMethod::Sobol) < independent / 4);
}

TEST_CASE("a point is the same whatever was asked before, and whatever else varies") {
  for (const SamplingMethod method : kSamplingMethods) {
    const Sampling sampling(method, 9, names(3), 100);
    const auto all = points(sampling, 100);
    for (const std::uint64_t i : {99, 3, 0, 50, 3}) CHECK(sampling.point(i) == all[i]);
    const auto fewer = points(Sampling(method, 9, names(2), 100), 100);
    for (std::size_t i = 0; i < 100; ++i) CHECK(fewer[i][1] == all[i][1]);
    CHECK(Sampling(method, 10, names(3), 100).point(4) != all[4]);
  }
}

TEST_CASE("Sobol's sequence has many dimensions, not any number") {
  const std::size_t most = most_dimensions(SamplingMethod::Sobol);
  CHECK(most == 3667);
  CHECK_THAT(
      stride::tests::error_of([&] { Sampling(SamplingMethod::Sobol, 1, names(most + 1), 2); }),
      Catch::Contains("3668 parameters are too many for sobol, expected 3667 at most"));
}
