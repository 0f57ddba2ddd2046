#include "units/sensor/relaxation.h"

#include <cmath>
#include <limits>

namespace sensor {
namespace {

// below this rate * seconds the closed forms lose digits to cancellation, and power series do not
constexpr double kSmall = 0.5;
constexpr int kTerms = 24;

// phi(t) = (1 - exp(-k t)) / k, what a slope of 1 at the start comes to
double phi(double rate, double seconds) { return -std::expm1(-rate * seconds) / rate; }

// the integral of phi over t, over t^2: the sum of (-x)^n / (n + 2)!
double first_moment(double x) {
  double term = 0.5;
  double sum = term;
  for (int n = 1; n < kTerms; ++n) {
    term *= -x / (n + 2);
    sum += term;
  }
  return sum;
}

// the integral of phi^2 over t, over t^3: the sum of (-x)^n (2^(n + 2) - 2) / (n + 3)!
double second_moment(double x) {
  double power = 1.0 / 6;  // (-x)^n / (n + 3)!
  double two = 4;
  double sum = 0;
  for (int n = 0; n < kTerms; ++n) {
    sum += power * (two - 2);
    power *= -x / (n + 4);
    two *= 2;
  }
  return sum;
}

}  // namespace

double Relaxation::after(double start, double seconds) const {
  return start + slope(start) * phi(rate, seconds);
}

double Relaxation::integral(double start, double seconds) const {
  const double x = rate * seconds;
  if (x < kSmall) return seconds * (start + slope(start) * seconds * first_moment(x));
  const double end = drift / rate;
  return end * seconds + (start - end) * phi(rate, seconds);
}

double Relaxation::integral_of_square(double start, double seconds) const {
  const double x = rate * seconds;
  if (x < kSmall) {
    const double rise = slope(start) * seconds;
    return seconds *
           (start * start + 2 * start * rise * first_moment(x) + rise * rise * second_moment(x));
  }
  const double end = drift / rate;
  const double from_end = start - end;
  return end * end * seconds + 2 * end * from_end * phi(rate, seconds) +
         from_end * from_end * phi(2 * rate, seconds);
}

double Relaxation::time_to(double start, double target) const {
  if (start == target) return 0;
  const double arrival = slope(target);
  const bool reached = (target - start) * arrival > 0;
  if (!reached) return std::numeric_limits<double>::infinity();
  return std::log1p(rate * (target - start) / arrival) / rate;
}

}  // namespace sensor
