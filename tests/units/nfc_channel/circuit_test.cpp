#include "units/nfc_channel/circuit.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace nfc_channel;

namespace {

constexpr double kOmega = kCarrierAngularFrequency;

const Coil kReader{0.030, 4, 0.5e-3, 0.0, 15.0};
const Coil kTag{0.008, 12, 0.1e-3, 0.0, 35.0};
const TagChip kChip{0.0, 5.5, 500.0};

Circuit circuit(const TagChip& chip = kChip, double reader_capacitance = 0.0) {
  return Circuit(ReaderAntenna(kReader, reader_capacitance), kTag, chip);
}

double mutual(double coupling) {
  return coupling * std::sqrt(inductance(kReader) * inductance(kTag));
}

}  // namespace

TEST_CASE("No power is made or lost: what leaves the transmitter heats coils and chip") {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> exponent(-2.0, 0.0);
  const auto random = [&](double most) { return most * std::pow(10.0, exponent(generator)); };
  int limited = 0;
  for (int i = 0; i < 2000; ++i) {
    const Coil reader{0.03, 4, 0.5e-3, 0.0, random(100.0)};
    const Coil tag{0.01, 10, 0.1e-3, 0.0, random(100.0)};
    const TagChip chip{i % 2 == 0 ? 0.0 : random(100e-12), random(10.0), 500.0};
    const Circuit c(ReaderAntenna(reader, i % 3 == 0 ? random(200e-12) : 0.0), tag, chip);
    const double power = random(2.0);
    const double m = random(1.0) * std::sqrt(inductance(reader) * inductance(tag));
    const Operation o = c.operate(m, power);
    limited += o.chip_conductance > 0.0;
    const double into = c.into_antenna(o);
    const double used = c.in_reader_coil(o) + c.in_tag_coil(o) + c.in_chip(o);
    CHECK(into == Approx(used).epsilon(1e-11));
    CHECK(into <= power * (1.0 + 1e-12));
  }
  CHECK(limited > 200);
}

TEST_CASE("With no tag near all of the carrier's power heats the reader's antenna") {
  const Circuit c = circuit();
  const Operation o = c.operate(0.0, 0.5);
  const double resistance = kOmega * inductance(kReader) / 15.0;
  CHECK(std::abs(o.reader_current) == Approx(std::sqrt(2.0 * 0.5 / resistance)));
  CHECK(c.into_antenna(o) == Approx(0.5));
  CHECK(c.in_chip(o) == 0.0);
  CHECK(c.source(0.0, 0.5).available_power == 0.0);
  CHECK(std::abs(c.operate(mutual(0.01), 0.0).tag_voltage) == 0.0);
}

TEST_CASE("Loosely coupled, the tag has omega M I, raised by its resonance") {
  // U0 = U / |(1 + j omega L / R_load)(...)|: Finkenzeller, sect. 4.1.8, with both losses
  const Circuit c = circuit();
  const double m = mutual(1e-5);
  const Operation o = c.operate(m, 0.5);
  const double reactance = kOmega * inductance(kTag);
  const std::complex<double> j(0.0, 1.0);
  const std::complex<double> divider = 1.0 + (reactance / 35.0 + j * reactance) * (j / reactance);
  CHECK(std::abs(o.tag_voltage) ==
        Approx(kOmega * m * std::abs(o.reader_current) / std::abs(divider)).epsilon(1e-6));
  CHECK(c.source(m, 0.5).voltage == Approx(std::abs(o.tag_voltage)).epsilon(1e-12));
  CHECK(c.tag_quality() == Approx(35.0));
  CHECK(c.tag_resistance() == Approx(35.0 * reactance).epsilon(1e-3));
}

TEST_CASE("Loosely coupled, power goes with the square of M, so with the sixth of the distance") {
  const Circuit c = circuit();
  const auto power = [&](double distance) {
    const double m = mutual_inductance(kReader, Pose{}, kTag, {{0.0, 0.0, distance}, {0, 0, 1}});
    return c.source(m, 0.5).available_power;
  };
  CHECK(power(2.0) / power(4.0) == Approx(64.0).epsilon(1e-3));
  CHECK(power(10.0) / power(100.0) == Approx(1e6).epsilon(1e-3));
}

TEST_CASE("No chip gets more than the best efficiency of two coupled resonators, and one gets it") {
  // U^2 / (1 + sqrt(1 + U^2))^2 with U = k sqrt(Q1 Q2): Kurs et al., Science 317 (2007)
  const double k = 0.05;
  const double u_squared = k * k * 15.0 * 35.0;
  const double root = 1.0 + std::sqrt(1.0 + u_squared);
  const double limit = u_squared / (root * root);
  const double reactance = kOmega * inductance(kTag);
  const double resistance = reactance / 35.0;
  const double susceptance = reactance / (resistance * resistance + reactance * reactance);
  double best = 0.0;
  for (double voltage = 0.1; voltage < 200.0; voltage *= 1.002) {
    const Circuit c = circuit({susceptance / kOmega, voltage, 500.0});
    const Operation o = c.operate(mutual(k), 0.5);
    const double efficiency = c.in_chip(o) / c.into_antenna(o);
    CHECK(efficiency <= limit * (1.0 + 1e-9));
    best = std::max(best, efficiency);
  }
  CHECK(best == Approx(limit).epsilon(1e-3));
}

TEST_CASE("No chip gets more than what is available, and one of half the voltage gets it") {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(0.1, 1.9);
  for (int i = 0; i < 500; ++i) {
    const double detuning = i % 2 == 0 ? 1.0 : uniform(generator);
    const double capacitance = detuning / (kOmega * kOmega * inductance(kTag));
    const double m = mutual(0.05 * uniform(generator));
    const Source source = circuit({capacitance, 1.0, 500.0}).source(m, 0.5);
    double best = 0.0;
    for (double share = 0.01; share < 1.0; share += 0.01) {
      const Circuit c = circuit({capacitance, share * source.voltage, 500.0});
      best = std::max(best, c.in_chip(c.operate(m, 0.5)));
    }
    CHECK(best <= source.available_power * (1.0 + 1e-9));
    CHECK(best == Approx(source.available_power).epsilon(1e-3));
  }
}

TEST_CASE("At its limit the tuned tag's chip gets what a source behind a resistance gives") {
  const Circuit c = circuit();
  const double m = mutual(0.01);
  const Source source = c.source(m, 0.5);
  const double resistance = source.voltage * source.voltage / (8.0 * source.available_power);
  CHECK(resistance == Approx(c.tag_resistance()).epsilon(0.03));
  const double current = (source.voltage - 5.5) / resistance;  // amplitude
  CHECK(c.in_chip(c.operate(m, 0.5)) == Approx(0.5 * 5.5 * current).epsilon(1e-3));
}

TEST_CASE("The limiter holds the voltage at its limit, and does not change a lower one") {
  const Circuit c = circuit();
  const Operation weak = c.operate(mutual(0.001), 0.5);
  CHECK(std::abs(weak.tag_voltage) < 5.5);
  CHECK(weak.chip_conductance == 0.0);
  const Operation strong = c.operate(mutual(0.05), 0.5);
  CHECK(std::abs(strong.tag_voltage) == Approx(5.5).epsilon(1e-12));
  CHECK(c.in_chip(strong) > 0.0);
  CHECK(c.source(mutual(0.05), 0.5).voltage > 5.5);
}

TEST_CASE("A tag loads the reader: the nearer, the less current, and never none") {
  const Circuit c = circuit({0.0, 1e9, 500.0});
  double last = std::abs(c.operate(0.0, 0.5).reader_current);
  for (double k = 0.01; k < 1.0; k += 0.01) {
    const double current = std::abs(c.operate(mutual(k), 0.5).reader_current);
    CHECK(current < last);
    CHECK(current > 0.0);
    last = current;
  }
}

TEST_CASE("Detuned, either circuit gives less") {
  const double m = mutual(0.01);
  const auto voltage = [m](const Circuit& c) { return c.source(m, 0.5).voltage; };
  const double tuned = voltage(circuit());
  const double capacitance = 1.0 / (kOmega * kOmega * inductance(kTag));
  CHECK(voltage(circuit({2.0 * capacitance, 5.5, 500.0})) < 0.7 * tuned);
  const double series = 1.0 / (kOmega * kOmega * inductance(kReader));
  CHECK(voltage(circuit(kChip, 0.8 * series)) < 0.7 * tuned);
  CHECK(voltage(circuit({capacitance, 5.5, 500.0}, series)) == Approx(tuned).epsilon(1e-9));
}

TEST_CASE("The sign of the flux changes no power") {
  const Circuit c = circuit();
  CHECK(c.source(mutual(0.02), 0.5).available_power ==
        c.source(-mutual(0.02), 0.5).available_power);
  CHECK(c.in_chip(c.operate(mutual(0.02), 0.5)) == c.in_chip(c.operate(-mutual(0.02), 0.5)));
}

TEST_CASE("The load modulator lowers the tag's voltage, and the reader's current follows") {
  const Circuit c = circuit();
  for (const double k : {0.005, 0.02, 0.05}) {
    const Operation off = c.operate(mutual(k), 0.5);
    const Operation on = c.modulate(mutual(k), off);
    CHECK(std::abs(on.tag_voltage) < std::abs(off.tag_voltage));
    CHECK(on.chip_conductance == off.chip_conductance);
    CHECK(std::abs(on.reader_current) > std::abs(off.reader_current));
  }
}
