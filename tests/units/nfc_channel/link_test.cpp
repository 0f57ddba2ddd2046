#include "units/nfc_channel/link.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace nfc_channel;

namespace {

constexpr double kBitSeconds = 128.0 / 13.56e6;  // [s]

}  // namespace

TEST_CASE("Thermal noise and interference add up") {
  CHECK(noise_density({290.0, 0.0}) == Approx(4.00388e-21).epsilon(1e-5));
  CHECK(noise_density({0.0, 1e-10}) == Approx(1e-10 * kBitSeconds));
  CHECK(noise_density({290.0, 1e-10}) == Approx(4.00388e-21 + 1e-10 * kBitSeconds));
}

TEST_CASE("Eb/N0 is the signal's energy over the noise density") {
  const BitSignal bit{2e-6, false};
  CHECK(signal_to_noise(1e-6, bit, 1e-14) == Approx(200.0));
  CHECK(signal_to_noise(0.0, bit, 1e-14) == 0.0);
  CHECK(signal_to_noise(0.0, bit, 0.0) == 0.0);
  CHECK(std::isinf(signal_to_noise(1e-6, bit, 0.0)));
}

TEST_CASE("A pause is a quarter of a bit, and antennas of no quality let the whole of it through") {
  for (const std::uint32_t rate : {106, 212, 424, 848}) {
    const double bit = kBitSeconds * 106 / rate;
    CHECK(down_signal(rate, 1e-3, 1e-3).seconds == Approx(bit / 4.0).epsilon(1e-6));
    CHECK_FALSE(down_signal(rate, 1e-3, 1e-3).coherent);
  }
}

TEST_CASE("The higher the quality factors, the less the envelope falls in a pause") {
  // one resonance alone: 1 - exp(-t / tau), tau = 2 Q / omega
  const double tau = 2.0 * 30.0 / kCarrierAngularFrequency;
  const double depth = 1.0 - std::exp(-kBitSeconds / 8.0 / 4.0 / tau);
  CHECK(down_signal(848, 30.0, 1e-9).seconds ==
        Approx(kBitSeconds / 32.0 * depth * depth).epsilon(1e-6));
  CHECK(down_signal(848, 30.0, 10.0).seconds < down_signal(848, 30.0, 5.0).seconds);
  CHECK(down_signal(848, 30.0, 10.0).seconds == Approx(down_signal(848, 10.0, 30.0).seconds));
  // equal ones are the limit of nearly equal ones
  CHECK(down_signal(848, 20.0, 20.0).seconds ==
        Approx(down_signal(848, 20.0, 20.001).seconds).epsilon(1e-3));
}

TEST_CASE("With a loaded tag a pause of 848 kbit/s is as deep as the standard requires") {
  // amplitude left: 0.22 to 0.58 (ISO/IEC 14443-2, 8.1.2.3); the default reader's Q is 7.5
  const double share = down_signal(848, 7.5, 2.53).seconds / (kBitSeconds / 32.0);
  const double left = 1.0 - std::sqrt(share);
  CHECK(left > 0.22);
  CHECK(left < 0.58);
}

TEST_CASE("The answer is half a bit of subcarrier at 106 kbit/s, a whole bit at the higher rates") {
  CHECK(up_signal(106, 1e-9, 1e-9).seconds == Approx(kBitSeconds / 2.0));
  CHECK_FALSE(up_signal(106, 1e-9, 1e-9).coherent);
  for (const std::uint32_t rate : {212, 424, 848}) {
    CHECK(up_signal(rate, 1e-9, 1e-9).seconds == Approx(kBitSeconds * 106 / rate));
    CHECK(up_signal(rate, 1e-9, 1e-9).coherent);
  }
}

TEST_CASE("A resonance of Q = 8 passes half of the sidebands' power") {
  CHECK(up_signal(106, 8.0, 1e-9).seconds == Approx(kBitSeconds / 4.0));
  CHECK(up_signal(106, 1e-9, 8.0).seconds == Approx(kBitSeconds / 4.0));
  CHECK(up_signal(106, 8.0, 8.0).seconds == Approx(kBitSeconds / 8.0));
}

TEST_CASE("The sidebands fall with the twelfth power of the distance: there and back") {
  const Coil reader{0.030, 4, 0.5e-3, 0.0, 15.0};
  const Coil tag{0.008, 12, 0.1e-3, 0.0, 35.0};
  const Circuit circuit(ReaderAntenna(reader, 0.0), tag, {0.0, 5.5, 500.0});
  const auto power = [&](double m) { return sideband_power(circuit, m, circuit.operate(m, 0.5)); };
  CHECK(power(2e-10) / power(1e-10) == Approx(16.0).epsilon(1e-3));
  CHECK(power(0.0) == 0.0);
}

TEST_CASE("The bit error probability falls from one half") {
  for (const bool coherent : {false, true}) {
    CHECK(bit_error_probability(0.0, coherent) == 0.5);
    CHECK(bit_error_probability(std::numeric_limits<double>::infinity(), coherent) == 0.0);
  }
  // noncoherent detection of orthogonal signals at 12 dB, antipodal signals at 9.6 dB
  CHECK(bit_error_probability(std::pow(10.0, 1.2), false) == Approx(1.8089e-4).epsilon(1e-3));
  CHECK(bit_error_probability(std::pow(10.0, 0.96), true) == Approx(1.0e-5).epsilon(0.05));
}
