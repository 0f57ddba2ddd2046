// Units of measure, and conversions between them.
#ifndef STRIDE_MASTER_MODEL_UNIT_OF_MEASURE_H
#define STRIDE_MASTER_MODEL_UNIT_OF_MEASURE_H

#include <map>
#include <optional>
#include <string>

#include <stride/unit_of_measure.h>

namespace stride::xml {
class Element;
}

namespace stride::core {

using stride::BaseUnitOfMeasure;
using UnitsOfMeasure = std::map<std::string, BaseUnitOfMeasure>;

/// Whether both mean the same, as far as doubles tell.
bool is_same(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b);

/// Reads a <BaseUnit>. Throws Error (Input) for what is no finite number, and for the factor 0.
BaseUnitOfMeasure read_base_unit(const xml::Element& element);

/// A unit of measure by its name; an empty name: none is declared. Without a meaning of its own it
/// is what find_unit_of_measure() knows by that name.
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

/// The meaning of its own, or else the one that is known by the name.
std::optional<BaseUnitOfMeasure> meaning_of(const UnitOfMeasure& unit);

/// How values in one unit become values in another. Where one side has none, or both have one name
/// and one of them no meaning of its own, they are taken as they are; nothing if they cannot be
/// converted into each other.
std::optional<LinearConversion> convert(const UnitOfMeasure& from, const UnitOfMeasure& to);

}  // namespace stride::core

#endif
