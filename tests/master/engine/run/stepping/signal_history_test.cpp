#include "master/engine/run/stepping/signal_history.h"

#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;

namespace {

constexpr Duration kSecond = 1s;

double polynomial(double t) { return 3 - 2 * t + 5 * t * t; }
double mean_of_polynomial(double a, double b) {
  const auto integral = [](double t) { return 3 * t - t * t + 5 * t * t * t / 3; };
  return (integral(b) - integral(a)) / (b - a);
}

/// At 0, 0.3 and 1 s.
SignalHistory sampled(unsigned degree) {
  SignalHistory history(2, degree);
  for (const auto time : {0ms, 300ms, 1000ms}) {
    const auto values = history.add(Time(time));
    values[0] = polynomial(to_seconds(Time(time)));
    values[1] = -7;
  }
  return history;
}

}  // namespace

TEST_CASE("a polynomial of the second degree is found again from three samples") {
  const SignalHistory history = sampled(2);
  for (const double t : {0.0, 0.3, 1.0, 1.25, 2.0}) {
    const auto weights = history.at(Time(1s), t - 1, kSecond);
    CHECK(history.value(0, weights) == Approx(polynomial(t)).epsilon(1e-12));
    CHECK(history.value(1, weights) == Approx(-7).epsilon(1e-12));
  }
  CHECK(history.value(0, history.mean(Time(1s), Time(1500ms))) ==
        Approx(mean_of_polynomial(1, 1.5)).epsilon(1e-12));
  CHECK(history.value(0, history.mean(Time(1s), Time(1s))) == Approx(polynomial(1)));
}

TEST_CASE("a lower degree takes the newest samples only") {
  const double slope = (polynomial(1) - polynomial(0.3)) / 0.7;
  const SignalHistory line = sampled(1);
  CHECK(line.value(0, line.at(Time(1s), 0.5, kSecond)) == Approx(polynomial(1) + 0.5 * slope));
  CHECK(line.value(0, line.mean(Time(1s), Time(2s))) == Approx(polynomial(1) + 0.5 * slope));
  const SignalHistory held = sampled(0);
  CHECK(held.value(0, held.at(Time(1s), 0.5, kSecond)) == polynomial(1));
  CHECK(held.value(0, held.mean(Time(1s), Time(2s))) == polynomial(1));
}

TEST_CASE("with too few samples the degree is lower") {
  SignalHistory history(1, 2);
  CHECK(history.empty());
  history.add(Time(1s))[0] = 4;
  CHECK(history.value(0, history.at(Time(1s), 10, kSecond)) == 4);
  history.add(Time(2s))[0] = 6;
  CHECK(history.value(0, history.at(Time(2s), 1, kSecond)) == Approx(8));
  history.clear();
  CHECK(history.empty());
}

TEST_CASE("the newest sample can be taken back without a loss of degree") {
  SignalHistory history = sampled(2);
  history.add(Time(1100ms))[0] = 1e6;
  history.remove_newest();
  CHECK(history.newest() == Time(1s));
  CHECK(history.value(0, history.at(Time(1s), 1, kSecond)) == Approx(polynomial(2)).epsilon(1e-12));
}

TEST_CASE("of samples that are close to each other only the newest counts") {
  const unsigned degree = GENERATE(1, 2);
  SignalHistory history = sampled(degree);
  const SignalHistory before = sampled(degree);
  history.add(Time(1s) + 1ns)[0] = polynomial(1) + 1e-6;  // a slope of a thousand
  for (const double t : {0.0, 0.5}) {
    const double value = history.value(0, history.at(Time(1s), t, 1s));
    CHECK(value == Approx(before.value(0, before.at(Time(1s), t, 1s))).margin(1e-5));
  }
  CHECK(history.value(0, history.mean(Time(1s), Time(2s))) ==
        Approx(before.value(0, before.mean(Time(1s), Time(2s)))).margin(1e-5));
  // for a step of their own size they are as good as any
  const double slope = history.value(0, history.at(Time(1s), 1e-9, 1ns)) -
                       history.value(0, history.at(Time(1s), 0, 1ns));
  CHECK(slope == Approx(1e-6).epsilon(1e-3));
}

TEST_CASE("where all samples are close to each other, the newest is held") {
  SignalHistory history(1, 2);
  for (int i = 0; i < 4; ++i) history.add(Time(Duration(i)))[0] = i;
  CHECK(history.value(0, history.mean(Time(Duration(4)), Time(1ms))) == 3);
}

TEST_CASE("what is not finite is held") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const unsigned degree = GENERATE(0, 1, 2);
  const auto after = [&](std::vector<double> values) {
    SignalHistory history(1, degree);
    for (std::size_t i = 0; i < values.size(); ++i) history.add(Time(i * kSecond))[0] = values[i];
    return history.value(0, history.mean(history.newest(), history.newest() + kSecond));
  };
  CHECK(after({kInfinity, kInfinity, kInfinity}) == kInfinity);
  CHECK(after({1, 2, -kInfinity}) == -kInfinity);
  CHECK(after({kInfinity, kInfinity, 3}) == 3);
  CHECK(std::isnan(after({1, 2, std::nan("")})));
}
