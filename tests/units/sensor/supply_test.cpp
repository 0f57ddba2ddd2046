#include "units/sensor/supply.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

using sensor::Currents;
using sensor::EnergyBooks;
using sensor::Flow;
using sensor::PowerParameters;
using sensor::PowerReadings;
using sensor::Relaxation;
using sensor::Supply;
using Mode = Flow::Mode;

namespace {

constexpr Currents kIdle{};

/// The source has 1 kOhm.
PowerParameters parameters() {
  PowerParameters p;
  p.antenna_resistance = 500;
  p.rectifier_drop = 0.5;
  p.capacitance = 1e-3;
  p.series_resistance = 200;
  p.leakage_resistance = 50e3;
  p.maximum_voltage = 5;
  return p;
}

/// A field in which the rectifier has this voltage without load.
double field(double voltage) {
  const PowerParameters p = parameters();
  return (voltage + p.rectifier_drop) * (voltage + p.rectifier_drop) / (8 * p.antenna_resistance);
}

double stored(const PowerParameters& p, double from, double to) {
  return p.capacitance / 2 * (to * to - from * from);
}

}  // namespace

TEST_CASE("the rectifier is a source behind twice the antenna's resistance") {
  const PowerParameters p = parameters();
  const Supply supply(p);
  const double amplitude = 12.0;
  const double available = amplitude * amplitude / (8 * p.antenna_resistance);
  const sensor::Source source = supply.source(available);
  CHECK(source.voltage == Approx(11.5));
  CHECK(source.resistance == Approx(1000));
  // what rail and diodes get is never more than what the antenna can give, and once as much
  double most = 0;
  for (double rail = 0; rail < source.voltage; rail += 0.01) {
    const double taken = (rail + p.rectifier_drop) * source.current_at(rail);
    CHECK(taken <= available * (1 + 1e-12));
    most = std::max(most, taken);
  }
  CHECK(most == Approx(available).epsilon(1e-5));
  CHECK(supply.source(0).voltage == 0);
  CHECK(supply.source(1e-9).voltage == 0);  // below the diodes' drop
  CHECK(supply.source(supply.field_power_for(1.8)).voltage == Approx(1.8));
  CHECK(supply.field_power_for(0) == 0);
}

TEST_CASE(
    "the rectifier's law is that of a bridge that clamps a resonance, by its currents in time") {
  // Integrated over many periods: a parallel resonance driven by a current, and a full bridge of
  // ideal diodes with a drop onto a constant rail.
  const double omega = 2 * M_PI * 13.56e6;
  const double resistance = 20e3, reactance = 200, drop = 0.6, rail = 3.0, amplitude = 8.0;
  const double inductance = reactance / omega, capacitance = 1 / (omega * reactance);
  const double h = 2 * M_PI / omega / 4000;
  double u = 0, i = 0, charge = 0;
  constexpr int kPeriods = 400, kLast = 50;
  for (int n = 0; n < kPeriods * 4000; ++n) {
    const double drive = amplitude / resistance * std::cos(omega * n * h);
    i += u / inductance * h;
    u += (drive - u / resistance - i) / capacitance * h;
    const double excess = std::max(0.0, std::abs(u) - rail - drop);
    if (n >= (kPeriods - kLast) * 4000) charge += excess * capacitance;
    u = std::copysign(std::abs(u) - excess, u);
  }
  const double mean = charge / (kLast * 4000 * h);
  CHECK(mean == Approx((amplitude - drop - rail) / (2 * resistance)).epsilon(0.03));
}

TEST_CASE("the capacitor feeds the rail where the field has too little voltage") {
  const Supply supply(parameters());
  const Flow flow = supply.flow(field(2.5), {1e-3, 0, 0, 0.5e-3}, 3.0);
  CHECK(flow.mode == Mode::FromCapacitor);
  CHECK(supply.current(flow, 3.0) == Approx(-1.5e-3));
  CHECK(supply.terminal(flow, 3.0) == Approx(3.0 - 1.5e-3 * 200));
  CHECK(supply.rail(flow, 3.0) == supply.terminal(flow, 3.0));
  CHECK(supply.load(flow, 3.0) == Approx(1.5e-3 * 2.7));
  CHECK(supply.intake(flow, 3.0) == Approx(0).margin(1e-18));
  CHECK(supply.drawn(flow, 3.0) == 0);
  CHECK(supply.voltage_for_terminal(flow, 2.7) == Approx(3.0));
}

TEST_CASE("field and capacitor feed the rail together where neither would do alone") {
  const Supply supply(parameters());
  const Flow flow = supply.flow(field(3.5), {1.5e-3, 0, 0, 0}, 3.0);  // alone it would hold 2 V
  CHECK(flow.mode == Mode::FromBoth);
  const double rail = supply.rail(flow, 3.0);
  const double from_field = (3.5 - rail) / 1000, from_capacitor = (3.0 - rail) / 200;
  CHECK(from_field + from_capacitor == Approx(1.5e-3));
  CHECK(supply.current(flow, 3.0) == Approx(-from_capacitor));
  CHECK(supply.intake(flow, 3.0) == Approx(rail * from_field));
  CHECK(supply.drawn(flow, 3.0) == Approx((rail + 0.5) * from_field));
  CHECK(supply.voltage_for_terminal(flow, rail) == Approx(3.0));
  CHECK(*supply.knee(flow) == Approx(2.0));
}

TEST_CASE("a field that cannot charge feeds the loads, and the capacitor only leaks") {
  const Supply supply(parameters());
  const Flow flow = supply.flow(field(4.5), {0.2e-3, 0, 0, 0}, 3.0);
  CHECK(flow.mode == Mode::FromField);
  CHECK(supply.rail(flow, 3.0) == Approx(4.3));
  CHECK(supply.terminal(flow, 3.0) == 3.0);
  CHECK(supply.current(flow, 3.0) == 0);
  CHECK(supply.intake(flow, 3.0) == Approx(4.3 * 0.2e-3));
  CHECK_FALSE(supply.knee(flow).has_value());
  // more than the loads take, but not at the maximum voltage
  CHECK(supply.flow(field(5.1), {0.2e-3, 0, 0, 0}, 3.0).mode == Mode::FromField);
}

TEST_CASE("modes meet where one follows the other") {
  const Supply supply(parameters());
  const Currents loads{1.5e-3, 0, 0, 0};
  Flow flow = supply.flow(field(3.5), loads, 4.5);
  CHECK(flow.mode == Mode::FromCapacitor);
  for (const Mode next : {Mode::FromBoth, Mode::FromField}) {
    const double knee = *supply.knee(flow);
    CHECK(supply.flow(field(3.5), loads, knee + 1e-9).mode == flow.mode);
    Flow after = flow;
    after.mode = Supply::after_knee(flow.mode);
    CHECK(after.mode == next);
    CHECK(supply.flow(field(3.5), loads, knee - 1e-9).mode == next);
    CHECK(supply.rail(after, knee) == Approx(supply.rail(flow, knee)));
    CHECK(supply.current(after, knee) == Approx(supply.current(flow, knee)).margin(1e-15));
    flow = after;
  }
}

TEST_CASE(
    "in the field the rail has the maximum voltage, and the terminal what the charger gives") {
  const Supply supply(parameters());
  const Flow flow = supply.flow(field(6.2), {0.2e-3, 0, 0, 0}, 3.0);  // 1.2 mA against 0.2 mA
  CHECK(flow.mode == Mode::ConstantCurrent);
  CHECK(supply.current(flow, 3.0) == Approx(1e-3));
  CHECK(supply.terminal(flow, 3.0) == Approx(3.2));
  CHECK(supply.rail(flow, 3.0) == 5);
  CHECK(supply.load(flow, 3.0) == Approx(1e-3));
  CHECK(supply.intake(flow, 3.0) == Approx(6e-3));
  CHECK(*supply.knee(flow) == Approx(4.8));
}

TEST_CASE("from the knee on the terminal has the maximum voltage and the current falls") {
  const Supply supply(parameters());
  const Flow flow = supply.flow(field(6.2), {0.2e-3, 0, 0, 0}, 4.9);
  CHECK(flow.mode == Mode::ConstantVoltage);
  CHECK(supply.current(flow, 4.9) == Approx(0.5e-3));
  CHECK(supply.terminal(flow, 4.9) == 5);
  CHECK(supply.intake(flow, 4.9) == Approx(0.7e-3 * 5));
  const Relaxation law = supply.capacitor(flow);
  CHECK(law.slope(4.9) == Approx((0.5e-3 - 4.9 / 50e3) / 1e-3));

  Flow below = flow;
  below.mode = Mode::ConstantCurrent;
  CHECK(supply.capacitor(below).slope(4.8) == Approx(law.slope(4.8)));  // they meet there
}

TEST_CASE("the charger gives no more than its current, the limiter takes the rest") {
  PowerParameters p = parameters();
  p.charging_current = 0.4e-3;
  const Supply supply(p);
  const Flow flow = supply.flow(field(6.2), kIdle, 1.0);
  CHECK(supply.current(flow, 1.0) == Approx(0.4e-3));
  CHECK(supply.books(flow, 1.0, 1e-3).limiter == Approx(0.8e-3 * 5 * 1e-3));
}

TEST_CASE("without field and load the capacitor only leaks") {
  const Supply supply(parameters());
  const Flow flow = supply.flow(0, kIdle, 4.0);
  const double seconds = 30;
  const double end = supply.capacitor(flow).after(4.0, seconds);
  CHECK(end == Approx(4.0 * std::exp(-seconds / (50e3 * 1e-3))));
  const EnergyBooks books = supply.books(flow, 4.0, seconds);
  CHECK(books.field == 0);
  CHECK(books.leakage == Approx(-stored(parameters(), 4.0, end)).epsilon(1e-13));
  CHECK(books.all_but_field_and_stored() == books.leakage);
}

TEST_CASE("each part's energy is its charge at the regulated voltage") {
  const Supply supply(parameters());
  const Currents currents{2e-3, 1e-3, 0.2e-3, 0.8e-3};
  const EnergyBooks books = supply.books(supply.flow(0, currents, 4.5), 4.5, 0.1);
  for (std::size_t i = 0; i < sensor::kParts; ++i) {
    CHECK(books.parts[i] == Approx(currents[i] * 1.8 * 0.1));
  }
  CHECK(books.regulator > 0);
}

TEST_CASE("each loss agrees with quadrature over the flow") {
  const PowerParameters p = parameters();
  const Supply supply(p);
  struct Case {
    double source, load, voltage;
  };
  for (const Case& c : {Case{0, 2e-3, 4.0},
                        {3.9, 2e-3, 4.0},
                        {4.9, 0.3e-3, 4.0},
                        {7.0, 0.5e-3, 1.0},
                        {8.0, 0.5e-3, 4.7}}) {
    const Flow flow = supply.flow(field(c.source), {c.load, 0, 0, 0}, c.voltage);
    const Relaxation law = supply.capacitor(flow);
    EnergyBooks expected;
    constexpr int kIntervals = 100'000;
    const double seconds = 0.2;
    const double h = seconds / kIntervals;
    for (int i = 0; i < kIntervals; ++i) {  // midpoint rule
      const double u = law.after(c.voltage, (i + 0.5) * h);
      const double current = supply.current(flow, u);
      const double rail = supply.rail(flow, u);
      const double terminal = supply.terminal(flow, u);
      const double rectified = std::max(0.0, (c.source - rail) / 1000);
      const double charger = std::max(0.0, current);
      expected.field += (rail + p.rectifier_drop) * rectified * h;
      expected.rectifier += p.rectifier_drop * rectified * h;
      expected.series_resistance += current * current * p.series_resistance * h;
      expected.leakage += u * u / p.leakage_resistance * h;
      expected.charger += charger * (rail - terminal) * h;
      expected.limiter += rail * (rectified - c.load - current) * h;
      expected.regulator += c.load * (rail - p.supply_voltage) * h;
    }
    const EnergyBooks books = supply.books(flow, c.voltage, seconds);
    CAPTURE(c.source, c.load, c.voltage);
    CHECK(books.field == Approx(expected.field).epsilon(1e-9).margin(1e-15));
    CHECK(books.rectifier == Approx(expected.rectifier).epsilon(1e-9).margin(1e-15));
    CHECK(books.series_resistance == Approx(expected.series_resistance).epsilon(1e-9));
    CHECK(books.leakage == Approx(expected.leakage).epsilon(1e-9));
    CHECK(books.charger == Approx(expected.charger).epsilon(1e-9).margin(1e-15));
    CHECK(books.limiter == Approx(expected.limiter).epsilon(1e-9).margin(1e-15));
    CHECK(books.regulator == Approx(expected.regulator).epsilon(1e-9));
  }
}

TEST_CASE("energy is conserved to rounding in every mode") {
  std::mt19937 random(2);  // its sequence is part of the C++ standard
  const auto between = [&](double least, double most) {
    return least + (most - least) * (random() / 4294967296.0);
  };
  const auto magnitude = [&](double least, double most) {
    return std::exp(between(std::log(least), std::log(most)));
  };
  int modes[5] = {};
  for (int i = 0; i < 20'000; ++i) {
    PowerParameters p;
    p.antenna_resistance = magnitude(100, 1e5);
    p.rectifier_drop = between(0, 1);
    p.capacitance = magnitude(1e-6, 1);
    p.series_resistance = magnitude(0.1, 1e4);
    p.leakage_resistance = magnitude(1e5, 1e12);
    p.charging_current = magnitude(1e-4, 1);
    const Supply supply(p);
    const double start = between(2, 5);
    const Flow flow = supply.flow(i % 3 == 0 ? 0 : magnitude(1e-5, 0.1),
                                  {magnitude(1e-7, 1e-2), 0, between(0, 1e-4), 0}, start);
    ++modes[static_cast<int>(flow.mode)];
    const double seconds = magnitude(1e-9, 1e-2);
    const double end = supply.capacitor(flow).after(start, seconds);
    const EnergyBooks books = supply.books(flow, start, seconds);
    const double gained = p.capacitance / 2 * (end - start) * (end + start);
    const double balance = books.field - books.all_but_field_and_stored() - gained;
    const double rounding = p.capacitance * 25 * 1e-15;  // of the voltage at the end
    REQUIRE(std::abs(balance) <= 1e-13 * (std::abs(books.field) + std::abs(gained)) + rounding);
  }
  for (const int count : modes) CHECK(count > 500);
}

namespace {

/// A flow in each mode, with everything in it.
std::vector<std::pair<Flow, double>> flows(const Supply& supply) {
  const Currents loads{0.2e-3, 0.1e-3, 0.05e-3, 0.3e-3};
  return {{supply.flow(0, loads, 4.0), 4.0},              // no field
          {supply.flow(field(4.1), loads, 4.0), 4.0},     // too weak a field
          {supply.flow(field(5.0), loads, 4.0), 4.0},     // one that feeds the loads
          {supply.flow(field(7.5), loads, 1.0), 1.0},     // charging
          {supply.flow(field(6.5), loads, 4.95), 4.95}};  // full
}

/// The readings after `seconds`, from the closed forms.
PowerReadings readings(const Supply& supply, const Flow& flow, double start, double seconds) {
  const PowerParameters p = parameters();
  const double u = supply.capacitor(flow).after(start, seconds);
  return {p.capacitance * u,      supply.terminal(flow, u),
          supply.rail(flow, u),   supply.drawn(flow, u),
          supply.intake(flow, u), supply.load(flow, u),
          stored(p, start, u),    supply.books(flow, start, seconds)};
}

}  // namespace

TEST_CASE("the rates are the slopes of the readings") {
  const Supply supply(parameters());
  for (const auto& [flow, start] : flows(supply)) {
    const double seconds = 0.01;
    const double h = 1e-5;
    const PowerReadings before = readings(supply, flow, start, seconds - h);
    PowerReadings slopes = readings(supply, flow, start, seconds + h);
    sensor::visit_pairs(slopes, before, [=](double& x, double past) { x = (x - past) / (2 * h); });
    const PowerReadings rates = supply.rates(flow, supply.capacitor(flow).after(start, seconds));
    CAPTURE(start, flow.mode);
    int moving = 0;
    sensor::visit_pairs(rates, slopes, [&](double rate, double slope) {
      CHECK(rate == Approx(slope).epsilon(1e-6).margin(1e-10));
      moving += static_cast<int>(rate != 0);
    });
    CHECK(moving >= 8);
  }
}

TEST_CASE("no rate changes faster than its bound, from now on, and the bounds are not idle") {
  const Supply supply(parameters());
  for (const auto& [flow, start] : flows(supply)) {
    const PowerReadings bounds = supply.curvatures(flow, start);
    const Relaxation law = supply.capacitor(flow);
    CAPTURE(start, flow.mode);
    for (double seconds = 0; seconds < 1; seconds += 0.01) {
      const double h = 1e-4;
      PowerReadings change = supply.rates(flow, law.after(start, seconds + h));
      const PowerReadings before = supply.rates(flow, law.after(start, seconds));
      sensor::visit_pairs(change, before,
                          [=](double& x, double past) { x = std::abs(x - past) / h; });
      sensor::visit_pairs(change, bounds, [&](double curvature, double bound) {
        CHECK(curvature <= bound * (1 + 1e-9) + 1e-10);
        // a bound that is much too high would make promises short
        if (seconds == 0 && bound > 1e-9) CHECK(curvature > bound / 6);
      });
    }
  }
}
