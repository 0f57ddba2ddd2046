#include "units/reader/variation.h"

#include <cmath>
#include <complex>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/reader/programs.h"

using reader::start_offsets;
using reader::Tremor;
using reader::Variation;

namespace {

using reader::tests::at;

Variation trembling(std::uint64_t seed, std::vector<double> amplitudes = {0.002, 0.002}) {
  Variation variation;
  variation.seed = seed;
  variation.tremor = std::move(amplitudes);
  return variation;
}

/// What a Hann window lets through of 200 s of a tremor's first axis.
class Spectrum {
 public:
  explicit Spectrum(const Tremor& tremor) : windowed_(kPoints) {
    for (int i = 0; i < kPoints; ++i) {
      const double window = 1 - std::cos(2 * M_PI * i / kPoints);
      windowed_[static_cast<std::size_t>(i)] = window * tremor.at(0, at(kLength * i / kPoints));
    }
  }
  /// Its mean square at a frequency.
  double power(double frequency) const {
    const std::complex<double> turn = std::polar(1.0, -2 * M_PI * frequency * kLength / kPoints);
    std::complex<double> sum = 0, phase = 1;
    for (const double value : windowed_) {
      sum += value * phase;
      phase *= turn;
    }
    return std::norm(sum / static_cast<double>(kPoints));
  }

 private:
  static constexpr double kLength = 200.0;
  static constexpr int kPoints = 10000;
  std::vector<double> windowed_;
};

}  // namespace

TEST_CASE("A tremor is a function of seed, axis and time") {
  const Tremor tremor(trembling(3));
  const Tremor same(trembling(3));
  const Tremor other(trembling(4));
  const Tremor far(trembling(3 + (std::uint64_t{1} << 32)));
  CHECK(tremor.at(0, at(2.5)) == same.at(0, at(2.5)));
  CHECK(tremor.at(0, at(2.5)) != other.at(0, at(2.5)));
  CHECK(tremor.at(0, at(2.5)) != far.at(0, at(2.5)));
  CHECK(tremor.at(0, at(2.5)) != tremor.at(1, at(2.5)));
  // from another implementation of std::seed_seq and std::mt19937_64
  CHECK(tremor.at(0, at(2.5)) == Approx(-0.0003183267217266225).epsilon(1e-9));
}

TEST_CASE("An axis without amplitude, or that is not there, does not move") {
  const Tremor tremor(trembling(1, {0.0, 0.001}));
  CHECK(tremor.at(0, at(1)) == 0.0);
  CHECK(tremor.at(1, at(1)) != 0.0);
  CHECK(tremor.at(2, at(1)) == 0.0);
  CHECK(Tremor().at(0, at(1)) == 0.0);
}

TEST_CASE("Its mean is zero and its power that of a sine of its amplitude") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Tremor tremor(trembling(seed));
    double sum = 0, squares = 0, largest = 0;
    constexpr int kPoints = 100000;
    for (int i = 0; i < kPoints; ++i) {
      const double x = tremor.at(0, at(i * 0.002));
      sum += x;
      squares += x * x;
      largest = std::max(largest, std::abs(x));
    }
    CHECK(sum / kPoints == Approx(0).margin(2e-6));
    CHECK(squares / kPoints == Approx(0.002 * 0.002 / 2).epsilon(0.02));
    CHECK(largest < 0.002 * 4);
    CHECK(largest > 0.002);
  }
}

TEST_CASE("Its spectrum lies between the lowest and the highest frequency, in all parts of it") {
  const Spectrum spectrum{Tremor(trembling(9))};
  const double whole = 0.002 * 0.002 / 2;
  for (const double f : {0.5, 1.0, 2.0, 3.0, 3.9, 12.1, 13.0, 16.0, 20.0}) {
    INFO(f << " Hz");
    CHECK(spectrum.power(f) < 1e-9 * whole);
  }
  for (double part = 4; part < 12; part += 0.5) {  // one sine in each sixteenth of the band
    double strongest = 0;
    for (double f = part; f < part + 0.5; f += 0.002)
      strongest = std::max(strongest, spectrum.power(f));
    INFO(part << " Hz");
    CHECK(strongest > 0.01 * whole);
  }
}

TEST_CASE("It is smooth: no faster than its highest frequency allows") {
  const Tremor tremor(trembling(5));
  const double fastest = 2 * M_PI * 12 * 0.002 * 4;  // [rad/s]
  for (int i = 0; i < 20000; ++i) {
    const double h = 1e-4;
    const double rate = (tremor.at(0, at((i + 1) * h)) - tremor.at(0, at(i * h))) / h;
    REQUIRE(std::abs(rate) < fastest);
  }
}

TEST_CASE("Start offsets are spread over their range") {
  Variation variation;
  variation.start_offset = {0.1, 0.0};
  double least = 1, most = -1, sum = 0;
  for (variation.seed = 1; variation.seed <= 1000; ++variation.seed) {
    const auto offsets = start_offsets(variation);
    REQUIRE(offsets.size() == 2);
    CHECK(offsets[1] == 0.0);
    least = std::min(least, offsets[0]);
    most = std::max(most, offsets[0]);
    sum += offsets[0];
  }
  CHECK(least >= -0.1);
  CHECK(least < -0.099);
  CHECK(most <= 0.1);
  CHECK(most > 0.099);
  CHECK(sum / 1000 == Approx(0).margin(0.006));  // three standard deviations
}

TEST_CASE("Amplitudes are scaled with their proportion") {
  std::vector<double> amplitudes = {0.002, 0.0, 0.001};
  reader::scale_to(amplitudes, 0.01);
  CHECK(amplitudes[0] == Approx(0.01));
  CHECK(amplitudes[1] == 0.0);
  CHECK(amplitudes[2] == Approx(0.005));
  reader::scale_to(amplitudes, 0.0);
  CHECK(amplitudes == std::vector<double>{0, 0, 0});
  reader::scale_to(amplitudes, 0.01);
  CHECK(amplitudes == std::vector<double>{0.01, 0.01, 0.01});
  std::vector<double> none;
  reader::scale_to(none, 1.0);
  CHECK(none.empty());
}
