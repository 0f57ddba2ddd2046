#include "master/loader/fmu/fmi2/input_derivatives.h"

#include <functional>
#include <random>

#include <catch2/catch.hpp>

using stride::importer::InputDerivatives;

namespace {

using Function = std::function<double(double)>;

void compute(InputDerivatives& derivatives, const std::vector<Function>& inputs, double step) {
  std::vector<fmi2ValueReference> references;
  for (fmi2ValueReference i = 0; i < inputs.size(); ++i) references.push_back(7 + i);
  for (int k = 0; k < InputDerivatives::kSamples; ++k) {
    derivatives.begin_sample(k);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const double value = inputs[i](InputDerivatives::instant(k, step));
      derivatives.add(&references[i], {&value, 1});
    }
  }
  derivatives.compute(step);
}

}  // namespace

TEST_CASE("the derivatives of polynomials up to the second degree are exact") {
  std::mt19937 random(20261121);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int i = 0; i < 200; ++i) {
    const double a = number(random), b = number(random), c = number(random);
    const double step = std::exp(3 * number(random));
    CAPTURE(a, b, c, step);
    InputDerivatives derivatives;
    compute(derivatives, {[&](double t) { return a + b * t + c * t * t; }}, step);
    REQUIRE(derivatives.values().size() == 2);
    CHECK(derivatives.references() == std::vector<fmi2ValueReference>{7, 7});
    CHECK(derivatives.orders() == std::vector<fmi2Integer>{1, 2});
    // what matters is what they do to the value at the end of the step
    const double scale = 1e-13 * (std::abs(a) + std::abs(b * step) + std::abs(c * step * step));
    CHECK(derivatives.values()[0] * step == Approx(b * step).margin(20 * scale));
    CHECK(derivatives.values()[1] * step * step == Approx(2 * c * step * step).margin(20 * scale));
  }
}

TEST_CASE(
    "without curvature there is no second derivative, and once there was one there always is") {
  InputDerivatives derivatives;
  const Function constant = [](double) { return 0.1; };
  const Function line = [](double t) { return 1.0 / 3 - t / 7; };
  compute(derivatives, {constant, line}, 0.3);
  CHECK(derivatives.references() == std::vector<fmi2ValueReference>{7, 8});
  CHECK(derivatives.orders() == std::vector<fmi2Integer>{1, 1});
  CHECK(derivatives.values()[0] == 0);
  CHECK(derivatives.values()[1] == Approx(-1.0 / 7));

  compute(derivatives, {constant, [](double t) { return t * t; }}, 0.3);
  CHECK(derivatives.references() == std::vector<fmi2ValueReference>{7, 8, 7, 8});
  CHECK(derivatives.orders() == std::vector<fmi2Integer>{1, 1, 2, 2});
  CHECK(derivatives.values()[1] == Approx(0).margin(1e-15));
  CHECK(derivatives.values()[2] == 0);
  CHECK(derivatives.values()[3] == Approx(2));

  compute(derivatives, {constant, constant}, 0.3);
  CHECK(derivatives.values() == std::vector<double>{0, 0, 0, 0});
}

TEST_CASE("what is infinite, or no number, has no derivatives") {
  InputDerivatives derivatives;
  const double infinity = std::numeric_limits<double>::infinity();
  compute(derivatives, {[&](double) { return infinity; }, [&](double t) { return t / 0.0; }}, 0.5);
  CHECK(derivatives.values() == std::vector<double>{0, 0});
}

TEST_CASE("without inputs there is nothing to set") {
  InputDerivatives derivatives;
  compute(derivatives, {}, 1);
  CHECK(derivatives.references().empty());
  CHECK(derivatives.values().empty());
}
