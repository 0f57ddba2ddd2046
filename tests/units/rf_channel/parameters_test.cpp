#include "units/rf_channel/parameters.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

using namespace rf_channel;

TEST_CASE("The defaults are in range") { CHECK_NOTHROW(check({})); }

TEST_CASE("What is out of range is refused with its name, its value and the range") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  using Change = std::function<void(Parameters&)>;
  const auto [name, range, change] = GENERATE_COPY(table<std::string, std::string, Change>({
      {"reader.antenna_gain is 101", "-100 to 100 dB",
       [](auto& p) { p.reader.antenna_gain = 101; }},
      {"tag.noise_figure is -1", "0 to 100 dB", [](auto& p) { p.tags[0].radio.noise_figure = -1; }},
      {"tag.interference is -1", "0 or more", [](auto& p) { p.tags[0].radio.interference = -1; }},
      {"reader.sensitivity is nan", "0 or more", [](auto& p) { p.reader.sensitivity = kNan; }},
      {"tag.transmit_power is -2", "0 or more", [](auto& p) { p.tags[0].transmit_power = -2; }},
      {"door.transmit_power is -2", "0 or more",
       [](auto& p) {
         p.tags[0] = {{"door"}, {}, -2};
       }},
      {"frequency is 2.45", "1e8 to 1e11 Hz", [](auto& p) { p.frequency = 2.45; }},
      {"ground.height is nan", "a finite number", [](auto& p) { p.ground.height = kNan; }},
      {"ground.permittivity is 0.9", "1 or more", [](auto& p) { p.ground.permittivity = 0.9; }},
      {"ground.conductivity is -1", "0 or more", [](auto& p) { p.ground.conductivity = -1; }},
      {"no tag", "one at least", [](auto& p) { p.tags.clear(); }},
  }));
  Parameters parameters;
  change(parameters);
  CHECK_THROWS_WITH(check(parameters), Catch::Contains(name) && Catch::Contains(range));
}

TEST_CASE("A receiver of 2 MHz has -111 dBm of thermal noise, and its noise figure more") {
  Radio radio;
  radio.noise_figure = 0.0;
  CHECK(10.0 * std::log10(noise_power(radio, 2e6) / 1e-3) == Approx(-110.97).margin(0.01));
  radio.noise_figure = 7.0;
  CHECK(10.0 * std::log10(noise_power(radio, 2e6) / 1e-3) == Approx(-103.97).margin(0.01));
  radio.interference = 1e-9;
  CHECK(noise_power(radio, 2e6) == Approx(1e-9).epsilon(1e-3));
}
