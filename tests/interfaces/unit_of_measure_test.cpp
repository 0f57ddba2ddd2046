#include <string>
#include <tuple>

#include <catch2/catch.hpp>

#include <stride/unit_of_measure.h>

using namespace stride;

namespace {

using Exponents = std::array<int, 8>;

constexpr Exponents kLength{0, 1, 0, 0, 0, 0, 0, 0};
constexpr Exponents kSpeed{0, 1, -1, 0, 0, 0, 0, 0};
constexpr Exponents kRotation{0, 0, -1, 0, 0, 0, 0, 1};
constexpr Exponents kPressure{1, -1, -2, 0, 0, 0, 0, 0};
constexpr Exponents kForce{1, 1, -2, 0, 0, 0, 0, 0};
constexpr Exponents kEnergy{1, 2, -2, 0, 0, 0, 0, 0};
constexpr Exponents kPower{1, 2, -3, 0, 0, 0, 0, 0};
constexpr Exponents kCharge{0, 0, 1, 1, 0, 0, 0, 0};
constexpr Exponents kTemperature{0, 0, 0, 0, 1, 0, 0, 0};

bool is_known(const std::string& name) { return find_unit_of_measure(name).has_value(); }

bool are_same(const std::string& one, const std::string& other) {
  const auto a = find_unit_of_measure(one);
  const auto b = find_unit_of_measure(other);
  return a && b && a->exponents == b->exponents &&
         static_cast<double>(a->factor) == static_cast<double>(b->factor) && a->offset == b->offset;
}

}  // namespace

TEST_CASE("units of measure that people use are exact where they are defined exactly") {
  const auto [name, exponents, factor] = GENERATE(table<std::string, Exponents, double>({
      {"km/h", kSpeed, 1 / 3.6},
      {"mph", kSpeed, 0.44704},
      {"rpm", kRotation, 0.10471975511965978},
      {"rev/min", kRotation, 0.10471975511965978},
      {"deg/s", kRotation, 0.017453292519943295},
      {"1/min", {0, 0, -1, 0, 0, 0, 0, 0}, 1 / 60.0},
      {"bar", kPressure, 1e5},
      {"kPa", kPressure, 1e3},
      {"psi", kPressure, 8896443230521 / 1290320000.0},
      {"kN", kForce, 1e3},
      {"lbf", kForce, 4.4482216152605},
      {"Nm", kEnergy, 1},
      {"N.m", kEnergy, 1},
      {"eV", kEnergy, 1.602176634e-19},
      {"kW.h", kEnergy, 3.6e6},
      {"kWh", kEnergy, 3.6e6},
      {"kW", kPower, 1e3},
      {"hp", kPower, 745.6998715822702},
      {"PS", kPower, 735.49875},
      {"A.h", kCharge, 3600},
      {"mA.h", kCharge, 3.6},
      {"L", {0, 3, 0, 0, 0, 0, 0, 0}, 1e-3},
      {"l/h", {0, 3, -1, 0, 0, 0, 0, 0}, 1 / 3.6e6},
      {"l/100km", {0, 2, 0, 0, 0, 0, 0, 0}, 1e-8},
      {"g", {1, 0, 0, 0, 0, 0, 0, 0}, 1e-3},
      {"mm", kLength, 1e-3},
      {"um", kLength, 1e-6},
      {"in", kLength, 0.0254},
      {"kg/m3", {1, -3, 0, 0, 0, 0, 0, 0}, 1},
      {"W/(m2.K)", {1, 0, -3, 0, -1, 0, 0, 0}, 1},
      {"m.s-2", {0, 1, -2, 0, 0, 0, 0, 0}, 1},
      {"N.h/km", {1, 0, -1, 0, 0, 0, 0, 0}, 3.6},
      {"%", {}, 0.01},
      {"1", {}, 1},
      {"-", {}, 1},
  }));
  CAPTURE(name);
  const auto unit = find_unit_of_measure(name);
  REQUIRE(unit);
  CHECK(unit->exponents == exponents);
  CHECK(static_cast<double>(unit->factor) == factor);
  CHECK(unit->offset == 0);
}

TEST_CASE("a temperature has an offset where it stands alone") {
  const auto fahrenheit = find_unit_of_measure("degF");
  CHECK(fahrenheit->exponents == kTemperature);
  CHECK(static_cast<double>(fahrenheit->factor) == 5 / 9.0);
  CHECK(static_cast<double>(fahrenheit->offset) == 255.37222222222223);
  CHECK(static_cast<double>(find_unit_of_measure("degC")->offset) == 273.15);
  CHECK(are_same("W/degC", "W/K"));
  CHECK(are_same("degC.m", "K.m"));
  CHECK(are_same("degC-1", "1/K"));
}

TEST_CASE("prefixes are those of SI, and whole symbols go before them") {
  CHECK(are_same("kOhm", "1000Ohm"));
  CHECK(are_same("daN", "10N"));
  CHECK(are_same("mm2", "mm.mm"));
  CHECK(are_same("min", "60s"));  // not a milli-inch
  CHECK(are_same("cd", "1cd"));   // not a centi-day
  CHECK(are_same("kg", "1000g"));
  CHECK_FALSE(is_known("kdegC"));
  CHECK_FALSE(is_known("kkg"));
  CHECK_FALSE(is_known("kmin"));
}

TEST_CASE("spellings of other tools are known") {
  CHECK(are_same("[m/s]", "m/s"));
  CHECK(are_same("\u00B5m", "um"));
  CHECK(are_same("k\u03A9", "kOhm"));
  CHECK(are_same("\u00B0C", "degC"));
  CHECK(are_same("\u00B0/s", "deg/s"));
  CHECK(are_same("m\u00B2", "m2"));
  CHECK(are_same("s\u207B\u00B9", "1/s"));
  CHECK(are_same("kg*m^2/s^2", "J"));
  CHECK(are_same("kg m2 / s2", "J"));
  CHECK(are_same("m s", "m.s"));  // not a millisecond
  CHECK(are_same("m/s/s", "m/s2"));
}

TEST_CASE("what has no meaning, or more than one, is not known") {
  const std::string name =
      GENERATE("", "furlong", "m/", "/m", "m.", "m)", "(m", "m^", "m-", "2", "0m", "1e3", "10^3.m",
               "J/kg.K", "m(1/2)", "m0.5", "m99", "[]", "m m m/ ",
               "((((((((((((((((((m))))))))))))))))))", "kt", "cal", "1e3m", "m\xC3");
  CAPTURE(name);
  CHECK_FALSE(is_known(name));
}

TEST_CASE("symbols of one's own are factors, too, and go before known ones") {
  const OwnUnitsOfMeasure own{{"furlong", {kLength, 201.168L}},
                              {"h", {{0, 0, 1, 0, 0, 0, 0, 0}, 3000}},
                              {"per cent of all", {{}, 0.01L}}};
  const auto speed = find_unit_of_measure("furlong/h", own);
  REQUIRE(speed);
  CHECK(speed->exponents == kSpeed);
  CHECK(static_cast<double>(speed->factor) == 0.067056);
  CHECK(find_unit_of_measure("1/furlong2", own));
  CHECK(find_unit_of_measure("per cent of all", own));
  CHECK_FALSE(find_unit_of_measure("kfurlong", own));
  CHECK_FALSE(find_unit_of_measure("furlong/fortnight", own));
}
