// Units of measure, and conversions between them.
#ifndef STRIDE_MASTER_ENGINE_MODEL_UNIT_OF_MEASURE_H
#define STRIDE_MASTER_ENGINE_MODEL_UNIT_OF_MEASURE_H

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <stride/unit_of_measure.h>

namespace stride::xml {
class Element;
}

namespace stride::core {

using stride::BaseUnitOfMeasure;
using UnitsOfMeasure = stride::OwnUnitsOfMeasure;

/// Whether both mean the same, as far as doubles tell.
bool is_same(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b);
/// Likewise, apart from the rounding of a definition's factors.
bool is_nearly_same(const BaseUnitOfMeasure& a, const BaseUnitOfMeasure& b);

/// The attributes of a <BaseUnit>.
inline constexpr auto kBaseUnitAttributes = [] {
  std::array<std::string_view, kUnitOfMeasureBases.size() + 2> names{"factor", "offset"};
  for (std::size_t i = 0; i < kUnitOfMeasureBases.size(); ++i)
    names[i + 2] = kUnitOfMeasureBases[i];
  return names;
}();

/// Reads a <BaseUnit>. Throws Error (Input) for what is no finite number, and for the factor 0.
BaseUnitOfMeasure read_base_unit(const xml::Element& element);

/// A unit of measure by its name; an empty name: none is declared. Without a meaning of its own it
/// is what find_unit_of_measure() knows by that name.
struct UnitOfMeasure {
  std::string name{};
  std::optional<BaseUnitOfMeasure> meaning{};
};

/// What these definitions make of a name: that of its own, or where it is not known without them
/// either, that of its factors, such as "furlong/s" where there is a "furlong".
std::optional<BaseUnitOfMeasure> find_defined(const UnitsOfMeasure& units, const std::string& name);

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

/// Known names of units of measure into which this one can be converted, itself first; only itself
/// where its meaning is unknown, and none where it has no name.
std::vector<std::string> convertible_names(const UnitOfMeasure& unit);

/// Names that are known without a definition, without those of prefixes that are rarely meant.
std::vector<std::string> known_unit_names();

/// "; nothing defines 'foo'" of a unit of measure without a meaning; else empty.
std::string undefined_text(const UnitOfMeasure& unit);

/// What to write in place of a text that is a number and a unit of measure, "90km/h", for a value
/// in `unit`; empty for other texts. `is_difference`: of temperatures, say.
std::string number_with_unit_hint(const std::string& text, const UnitOfMeasure& unit,
                                  bool is_difference);

}  // namespace stride::core

#endif
