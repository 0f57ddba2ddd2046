#include "master/study/campaign/definition/distribution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <boost/math/distributions/poisson.hpp>
#include <catch2/catch.hpp>

#include "master/study/campaign/random.h"

using namespace stride::campaign;

namespace {

constexpr std::size_t kDraws = 20'000;

std::vector<double> draws(const Distribution& distribution, const char* purpose) {
  const RandomStream stream(1, purpose);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < kDraws; ++i) {
    numbers.push_back(quantile(distribution, stream.uniform(i)));
  }
  return numbers;
}

double mean(const std::vector<double>& numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

double variance(const std::vector<double>& numbers) {
  const double middle = mean(numbers);
  double sum = 0;
  for (const double number : numbers) sum += (number - middle) * (number - middle);
  return sum / static_cast<double>(numbers.size() - 1);
}

/// The distance of Kolmogorov and Smirnov, times the square root of the number of draws: above 1.63
/// in 1 of 100 cases. The draws are always the same.
double distance(std::vector<double> numbers, const std::function<double(double)>& cdf) {
  std::ranges::sort(numbers);
  const auto count = static_cast<double>(numbers.size());
  double largest = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double expected = cdf(numbers[i]);
    largest = std::max({largest, std::abs(expected - static_cast<double>(i) / count),
                        std::abs(expected - static_cast<double>(i + 1) / count)});
  }
  return largest * std::sqrt(count);
}

double normal_cdf(double x, double middle, double deviation) {
  return 0.5 * std::erfc(-(x - middle) / deviation / std::sqrt(2));
}

constexpr double kCritical = 1.63;

}  // namespace

TEST_CASE("a uniform distribution") {
  const auto numbers = draws(Uniform{{2, 5}}, "uniform");
  CHECK(mean(numbers) == Approx(3.5).epsilon(0.01));
  CHECK(variance(numbers) == Approx(0.75).epsilon(0.02));
  CHECK(distance(numbers, [](double x) { return (x - 2) / 3; }) < kCritical);
  CHECK(quantile(Uniform{{4, 4}}, 0.3) == 4);
}

TEST_CASE("a uniform distribution of whole numbers has both limits") {
  const Uniform dice{{1, 6}};
  const RandomStream stream(3, "dice");
  std::vector<std::size_t> counts(7);
  for (std::size_t i = 0; i < 60'000; ++i) {
    ++counts[static_cast<std::size_t>(whole_quantile(dice, stream.uniform(i)))];
  }
  CHECK(counts[0] == 0);
  for (std::size_t i = 1; i <= 6; ++i)
    CHECK(std::abs(static_cast<double>(counts[i]) - 10'000) < 300);
  CHECK(whole_quantile(Uniform{{0.5, 2.5}}, 1e-9) == 1);
  CHECK(whole_quantile(Uniform{{0.5, 2.5}}, 1 - 1e-9) == 2);
}

TEST_CASE("a normal distribution") {
  const auto numbers = draws(Normal{-1, 4, {}}, "normal");
  CHECK(mean(numbers) == Approx(-1).margin(0.03));
  CHECK(variance(numbers) == Approx(4).epsilon(0.03));
  CHECK(distance(numbers, [](double x) { return normal_cdf(x, -1, 2); }) < kCritical);
  CHECK(quantile(Normal{3, 0, {}}, 0.9) == 3);
}

TEST_CASE("a normal distribution that is cut off is the conditional one") {
  for (const Limits limits : {Limits{-2, 1}, Limits{0.5, 9}, Limits{-30, -8}, Limits{8, 30}}) {
    CAPTURE(limits.lower);
    const auto numbers = draws(Normal{0, 1, limits}, "cut");
    const auto [least, greatest] = std::ranges::minmax(numbers);
    CHECK(least >= limits.lower);
    CHECK(greatest <= limits.upper);
    // above 0 the upper tail is the exact one
    const double sign = limits.lower > 0 ? -1 : 1;
    const double from = sign > 0 ? limits.lower : -limits.upper;
    const double to = sign > 0 ? limits.upper : -limits.lower;
    std::vector<double> mirrored;
    for (const double number : numbers) mirrored.push_back(sign * number);
    const double whole = normal_cdf(to, 0, 1) - normal_cdf(from, 0, 1);
    CHECK(distance(mirrored, [&](double x) {
            return (normal_cdf(x, 0, 1) - normal_cdf(from, 0, 1)) / whole;
          }) < kCritical);
  }
}

TEST_CASE("a log-normal distribution has the mean and the variance that it is given") {
  const auto numbers = draws(LogNormal{2, 0.5, {}}, "log-normal");
  CHECK(mean(numbers) == Approx(2).epsilon(0.01));
  CHECK(variance(numbers) == Approx(0.5).epsilon(0.05));
  const double deviation = std::sqrt(std::log1p(0.5 / 4));
  const double middle = std::log(2) - deviation * deviation / 2;
  CHECK(distance(numbers, [&](double x) { return normal_cdf(std::log(x), middle, deviation); }) <
        kCritical);
  const auto [least, greatest] =
      std::ranges::minmax(draws(LogNormal{2, 0.5, Limits{1.5, 2.5}}, "x"));
  CHECK(least >= 1.5);
  CHECK(greatest <= 2.5);
}

TEST_CASE("a Poisson distribution") {
  const auto numbers = draws(Poisson{4.5, {}}, "Poisson");
  CHECK(mean(numbers) == Approx(4.5).epsilon(0.01));
  CHECK(variance(numbers) == Approx(4.5).epsilon(0.03));
  const boost::math::poisson law(4.5);
  for (int k = 0; k < 15; ++k) {
    const auto count = static_cast<double>(std::ranges::count(numbers, k));
    const double expected = kDraws * boost::math::pdf(law, k);
    CAPTURE(k);
    CHECK(std::abs(count - expected) < 4 * std::sqrt(expected) + 1);
  }
  for (const double number : draws(Poisson{4.5, Limits{2.5, 5}}, "cut Poisson")) {
    CHECK((number == 3 || number == 4 || number == 5));
  }
  CHECK(quantile(Poisson{2, Limits{40, 50}}, 0.5) == 40);
}

TEST_CASE("a histogram is uniform in each bin, with its share") {
  const Histogram histogram{{{{0, 1}, 1}, {{1, 3}, 0}, {{3, 5}, 3}}};
  const auto numbers = draws(histogram, "histogram");
  CHECK(distance(numbers, [](double x) {
          return x <= 1 ? x / 4 : x <= 3 ? 0.25 : 0.25 + 0.75 * (x - 3) / 2;
        }) < kCritical);
  CHECK(std::ranges::none_of(numbers, [](double x) { return x > 1 && x < 3; }));
}

TEST_CASE("a set of texts is chosen from by weight") {
  const ProbabilitySet set{{{"never", 0}, {"one", 1}, {"three", 3}, {"nor", 0}}};
  const RandomStream stream(4, "set");
  std::vector<double> counts(4);
  for (std::size_t i = 0; i < kDraws; ++i) ++counts[chosen_element(set, stream.uniform(i))];
  CHECK(counts[0] == 0);
  CHECK(counts[3] == 0);
  CHECK(counts[1] / kDraws == Approx(0.25).margin(0.01));
  CHECK(chosen_element(set, std::nextafter(1.0, 0.0)) == 2);
}

TEST_CASE("whether anything is within the limits") {
  CHECK(has_probability(Normal{0, 1, Limits{5, 6}}));
  CHECK(has_probability(Normal{0, 1, Limits{30, 40}}));
  CHECK_FALSE(has_probability(Normal{0, 1, Limits{50, 60}}));
  CHECK_FALSE(has_probability(Normal{0, 0, Limits{1, 2}}));
  CHECK(has_probability(Normal{1, 0, Limits{1, 2}}));
  CHECK_FALSE(has_probability(LogNormal{1, 1, Limits{-3, -1}}));
  CHECK_FALSE(has_probability(LogNormal{1e-300, 1e308, {}}));
  CHECK(quantile(LogNormal{1e300, 1e-300, {}}, 0.3) == 1e300);
  CHECK(quantile(Uniform{{-1e308, 1e308}}, 0.5) == Approx(0).margin(1e292));
  CHECK_FALSE(has_probability(Poisson{3, Limits{1.2, 1.8}}));
  CHECK_FALSE(has_probability(Poisson{3, Limits{-5, -1}}));
  CHECK(has_probability(Poisson{3, Limits{20, 30}}));
}

TEST_CASE("distributions in words") {
  CHECK(to_text(Normal{1, 0.25, Limits{0, 2}}) == "normal, mean 1, variance 0.25, from 0 to 2");
  CHECK(to_text(ProbabilitySet{{{"a", 1}, {"b", 0.5}}}) == "a (1), b (0.5)");
  CHECK(to_text(Histogram{{{{0, 1}, 1}, {{2, 3}, 1}}}) == "histogram, 2 bins from 0 to 3");
}
