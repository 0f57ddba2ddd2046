// Units of measure, and conversions between them.
#ifndef STRIDE_MASTER_MODEL_UNIT_OF_MEASURE_H
#define STRIDE_MASTER_MODEL_UNIT_OF_MEASURE_H

#include <array>
#include <optional>
#include <string>

namespace stride::xml {
class Element;
}

namespace stride::core {

/// value in SI base units = factor * value + offset. exponents of kg, m, s, A, K, mol, cd, rad.
struct BaseUnitOfMeasure {
  std::array<int, 8> exponents{};
  double factor = 1;
  double offset = 0;
};

/// The attributes of a <BaseUnit> of FMI and SSP, in the order of BaseUnitOfMeasure::exponents.
inline constexpr std::array<const char*, 8> kBaseUnits{"kg", "m",   "s",  "A",
                                                       "K",  "mol", "cd", "rad"};

/// Reads a <BaseUnit>. Throws Error (Input) for what is no finite number, and for the factor 0.
BaseUnitOfMeasure read_base_unit(const xml::Element& element);

/// A unit of measure by its name; an empty name: none is declared. Without a meaning it equals
/// those of the same name only, which may be in brackets.
struct UnitOfMeasure {
  std::string name{};
  std::optional<BaseUnitOfMeasure> meaning{};
};

/// target = factor * source + offset
struct LinearConversion {
  double factor = 1;
  double offset = 0;
  bool is_identity() const { return factor == 1 && offset == 0; }
  bool operator==(const LinearConversion&) const = default;
};

/// How values in one unit become values in another. Where one side has none they are taken as they
/// are; nothing if they cannot be converted into each other.
std::optional<LinearConversion> convert(const UnitOfMeasure& from, const UnitOfMeasure& to);

}  // namespace stride::core

#endif
