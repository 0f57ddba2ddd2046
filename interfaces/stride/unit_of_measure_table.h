// The symbols of units of measure that are known by name. Factors are exact by their definitions:
// the SI brochure (9th edition), the international yard and pound, and Modelica.Units.
#ifndef STRIDE_UNIT_OF_MEASURE_TABLE_H
#define STRIDE_UNIT_OF_MEASURE_TABLE_H

#include <array>
#include <string_view>

namespace stride {

/// value in SI base units = factor * value + offset; the exponents are those of
/// kUnitOfMeasureBases.
struct BaseUnitOfMeasure {
  std::array<int, 8> exponents{};
  long double factor = 1;
  long double offset = 0;
};

/// The attributes of a <BaseUnit> of FMI and SSP.
inline constexpr std::array<const char*, 8> kUnitOfMeasureBases{"kg", "m",   "s",  "A",
                                                                "K",  "mol", "cd", "rad"};

struct UnitOfMeasureSymbol {
  std::string_view symbol;
  BaseUnitOfMeasure unit;
  bool takes_prefix = false;
};

namespace detail {

inline constexpr bool kTakesPrefix = true;
inline constexpr long double kPi = 3.14159265358979323846264338327950288L;
inline constexpr long double kFoot = 0.3048L;
inline constexpr long double kInch = 0.0254L;
inline constexpr long double kPound = 0.45359237L;
inline constexpr long double kGravity = 9.80665L;
inline constexpr long double kPoundForce = 4.4482216152605L;
inline constexpr long double kMercury = 133322.387415L;  ///< [Pa/m], conventional

}  // namespace detail

// symbol, {{kg, m, s, A, K, mol, cd, rad}, factor, offset}
inline constexpr UnitOfMeasureSymbol kUnitOfMeasureSymbols[] = {
    // SI, with and without names of their own
    {"kg", {{1, 0, 0, 0, 0, 0, 0, 0}}},
    {"g", {{1, 0, 0, 0, 0, 0, 0, 0}, 0.001L}, detail::kTakesPrefix},
    {"m", {{0, 1, 0, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"s", {{0, 0, 1, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"A", {{0, 0, 0, 1, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"K", {{0, 0, 0, 0, 1, 0, 0, 0}}, detail::kTakesPrefix},
    {"mol", {{0, 0, 0, 0, 0, 1, 0, 0}}, detail::kTakesPrefix},
    {"cd", {{0, 0, 0, 0, 0, 0, 1, 0}}, detail::kTakesPrefix},
    {"rad", {{0, 0, 0, 0, 0, 0, 0, 1}}, detail::kTakesPrefix},
    {"sr", {}, detail::kTakesPrefix},
    {"Hz", {{0, 0, -1, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"N", {{1, 1, -2, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"Pa", {{1, -1, -2, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"J", {{1, 2, -2, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"W", {{1, 2, -3, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"C", {{0, 0, 1, 1, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"V", {{1, 2, -3, -1, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"F", {{-1, -2, 4, 2, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"Ohm", {{1, 2, -3, -2, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"ohm", {{1, 2, -3, -2, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"S", {{-1, -2, 3, 2, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"Wb", {{1, 2, -2, -1, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"T", {{1, 0, -2, -1, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"H", {{1, 2, -2, -2, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"lm", {{0, 0, 0, 0, 0, 0, 1, 0}}, detail::kTakesPrefix},
    {"lx", {{0, -2, 0, 0, 0, 0, 1, 0}}, detail::kTakesPrefix},
    {"Bq", {{0, 0, -1, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"Gy", {{0, 2, -2, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"Sv", {{0, 2, -2, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"kat", {{0, 0, -1, 0, 0, 1, 0, 0}}, detail::kTakesPrefix},
    // ratios
    {"%", {{}, 0.01L}},
    {"ppm", {{}, 1e-6L}},
    {"ppb", {{}, 1e-9L}},
    // time and frequency
    {"sec", {{0, 0, 1, 0, 0, 0, 0, 0}}},
    {"min", {{0, 0, 1, 0, 0, 0, 0, 0}, 60}},
    {"h", {{0, 0, 1, 0, 0, 0, 0, 0}, 3600}},
    {"hr", {{0, 0, 1, 0, 0, 0, 0, 0}, 3600}},
    {"d", {{0, 0, 1, 0, 0, 0, 0, 0}, 86400}},
    {"day", {{0, 0, 1, 0, 0, 0, 0, 0}, 86400}},
    // angles and rotation
    {"deg", {{0, 0, 0, 0, 0, 0, 0, 1}, detail::kPi / 180}, detail::kTakesPrefix},
    {"arcmin", {{0, 0, 0, 0, 0, 0, 0, 1}, detail::kPi / 10800}},
    {"arcsec", {{0, 0, 0, 0, 0, 0, 0, 1}, detail::kPi / 648000}},
    {"gon", {{0, 0, 0, 0, 0, 0, 0, 1}, detail::kPi / 200}},
    {"rev", {{0, 0, 0, 0, 0, 0, 0, 1}, 2 * detail::kPi}},
    {"r", {{0, 0, 0, 0, 0, 0, 0, 1}, 2 * detail::kPi}},
    {"rpm", {{0, 0, -1, 0, 0, 0, 0, 1}, detail::kPi / 30}},
    {"rps", {{0, 0, -1, 0, 0, 0, 0, 1}, 2 * detail::kPi}},
    // temperature
    {"degC", {{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15L}},
    {"degF", {{0, 0, 0, 0, 1, 0, 0, 0}, 5 / 9.0L, 459.67L * 5 / 9}},
    {"degRk", {{0, 0, 0, 0, 1, 0, 0, 0}, 5 / 9.0L}},
    // length, area, volume
    {"in", {{0, 1, 0, 0, 0, 0, 0, 0}, detail::kInch}},
    {"inch", {{0, 1, 0, 0, 0, 0, 0, 0}, detail::kInch}},
    {"ft", {{0, 1, 0, 0, 0, 0, 0, 0}, detail::kFoot}},
    {"yd", {{0, 1, 0, 0, 0, 0, 0, 0}, 3 * detail::kFoot}},
    {"mi", {{0, 1, 0, 0, 0, 0, 0, 0}, 5280 * detail::kFoot}},
    {"mile", {{0, 1, 0, 0, 0, 0, 0, 0}, 5280 * detail::kFoot}},
    {"nmi", {{0, 1, 0, 0, 0, 0, 0, 0}, 1852}},
    {"ha", {{0, 2, 0, 0, 0, 0, 0, 0}, 10000}},
    {"l", {{0, 3, 0, 0, 0, 0, 0, 0}, 0.001L}, detail::kTakesPrefix},
    {"L", {{0, 3, 0, 0, 0, 0, 0, 0}, 0.001L}, detail::kTakesPrefix},
    // speed
    {"kph", {{0, 1, -1, 0, 0, 0, 0, 0}, 1000 / 3600.0L}},
    {"kmh", {{0, 1, -1, 0, 0, 0, 0, 0}, 1000 / 3600.0L}},
    {"mph", {{0, 1, -1, 0, 0, 0, 0, 0}, 0.44704L}},
    {"kn", {{0, 1, -1, 0, 0, 0, 0, 0}, 1852 / 3600.0L}},
    {"knot", {{0, 1, -1, 0, 0, 0, 0, 0}, 1852 / 3600.0L}},
    // mass, force, torque
    {"t", {{1, 0, 0, 0, 0, 0, 0, 0}, 1000}},
    {"lb", {{1, 0, 0, 0, 0, 0, 0, 0}, detail::kPound}},
    {"lbm", {{1, 0, 0, 0, 0, 0, 0, 0}, detail::kPound}},
    {"oz", {{1, 0, 0, 0, 0, 0, 0, 0}, detail::kPound / 16}},
    {"u", {{1, 0, 0, 0, 0, 0, 0, 0}, 1.66053906892e-27L}},
    {"Da", {{1, 0, 0, 0, 0, 0, 0, 0}, 1.66053906892e-27L}, detail::kTakesPrefix},
    {"kgf", {{1, 1, -2, 0, 0, 0, 0, 0}, detail::kGravity}},
    {"lbf", {{1, 1, -2, 0, 0, 0, 0, 0}, detail::kPoundForce}},
    {"Nm", {{1, 2, -2, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    // pressure and viscosity
    {"bar", {{1, -1, -2, 0, 0, 0, 0, 0}, 100000}, detail::kTakesPrefix},
    {"atm", {{1, -1, -2, 0, 0, 0, 0, 0}, 101325}},
    {"Torr", {{1, -1, -2, 0, 0, 0, 0, 0}, 101325 / 760.0L}, detail::kTakesPrefix},
    {"mmHg", {{1, -1, -2, 0, 0, 0, 0, 0}, detail::kMercury / 1000}},
    {"inHg", {{1, -1, -2, 0, 0, 0, 0, 0}, detail::kMercury* detail::kInch}},
    {"psi",
     {{1, -1, -2, 0, 0, 0, 0, 0}, detail::kPoundForce / (detail::kInch * detail::kInch)},
     detail::kTakesPrefix},
    {"P", {{1, -1, -1, 0, 0, 0, 0, 0}, 0.1L}, detail::kTakesPrefix},
    {"St", {{0, 2, -1, 0, 0, 0, 0, 0}, 0.0001L}, detail::kTakesPrefix},
    // energy, power, charge
    {"eV", {{1, 2, -2, 0, 0, 0, 0, 0}, 1.602176634e-19L}, detail::kTakesPrefix},
    {"Wh", {{1, 2, -2, 0, 0, 0, 0, 0}, 3600}, detail::kTakesPrefix},
    {"Btu", {{1, 2, -2, 0, 0, 0, 0, 0}, 1055.05585262L}},
    {"BTU", {{1, 2, -2, 0, 0, 0, 0, 0}, 1055.05585262L}},
    {"VA", {{1, 2, -3, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"var", {{1, 2, -3, 0, 0, 0, 0, 0}}, detail::kTakesPrefix},
    {"hp", {{1, 2, -3, 0, 0, 0, 0, 0}, 550 * detail::kFoot* detail::kPoundForce}},
    {"PS", {{1, 2, -3, 0, 0, 0, 0, 0}, 75 * detail::kGravity}},
    {"Ah", {{0, 0, 1, 1, 0, 0, 0, 0}, 3600}, detail::kTakesPrefix},
};

struct UnitOfMeasurePrefix {
  std::string_view symbol;
  long double power;
  bool is_fraction = false;  ///< it divides by the power, which a decimal fraction would round
};

inline constexpr UnitOfMeasurePrefix kUnitOfMeasurePrefixes[] = {
    {"Y", 1e24L},       {"Z", 1e21L},       {"E", 1e18L},       {"P", 1e15L},
    {"T", 1e12L},       {"G", 1e9L},        {"M", 1e6L},        {"k", 1e3L},
    {"h", 1e2L},        {"da", 1e1L},       {"d", 1e1L, true},  {"c", 1e2L, true},
    {"m", 1e3L, true},  {"u", 1e6L, true},  {"n", 1e9L, true},  {"p", 1e12L, true},
    {"f", 1e15L, true}, {"a", 1e18L, true}, {"z", 1e21L, true}, {"y", 1e24L, true},
};

struct UnitOfMeasureSpelling {
  std::string_view written, plain;
};

/// In UTF-8.
inline constexpr UnitOfMeasureSpelling kUnitOfMeasureSpellings[] = {
    {"\u00B5", "u"},     {"\u03BC", "u"},     {"\u03A9", "Ohm"}, {"\u2126", "Ohm"},
    {"\u00B0C", "degC"}, {"\u00B0F", "degF"}, {"\u00B0", "deg"}, {"\u00B7", "."},
    {"\u22C5", "."},     {"**", "^"},         {"*", "."},        {"\u207B", "^-"},
    {"\u2212", "-"},     {"\u00B9", "^1"},    {"\u00B2", "^2"},  {"\u00B3", "^3"},
    {"\u2074", "^4"},
};

}  // namespace stride

#endif
