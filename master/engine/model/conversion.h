// The conversion of output values to input values: units of measure, SSP transformations, types.
#ifndef STRIDE_MASTER_ENGINE_MODEL_CONVERSION_H
#define STRIDE_MASTER_ENGINE_MODEL_CONVERSION_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/description.h"
#include "master/engine/model/transformation.h"
#include "master/engine/model/unit_of_measure.h"

namespace stride::core {

/// The conversion of each element.
struct Conversion {
  LinearConversion linear;  ///< of Float32 and Float64 only
  NumberMap map;    ///< of integers, Enumeration and Boolean (0 and 1) only, before `linear`
  NumberMap truth;  ///< of what an integer, mapped, is as a Boolean: 0 or 1
  /// The values that the target, an Enumeration, may have; empty: nothing is to be checked.
  std::vector<std::int64_t> valid;

  bool is_identity() const { return linear.is_identity() && map.empty() && truth.empty(); }
  bool operator==(const Conversion&) const = default;
};

/// The mapped number.
std::int64_t mapped(const NumberMap& map, std::int64_t value);

/// Between two connectors of a path: an ssd:Connection or an ssm:MappingEntry.
struct PathSegment {
  bool suppress_unit_conversion = false;
  Transformation transformation{};
};

/// A connector on the path of a value, as far as it is declared.
struct PathConnector {
  std::string name{};  ///< for messages
  std::optional<ValueType> type{};
  UnitOfMeasure unit{};
  EnumerationItems items{};
  /// Undeclared attributes are those of the next connector, else of the previous one.
  bool takes_after_next = false;
  /// Of a unit's variable: whether it is a difference (relativeQuantity).
  std::optional<bool> is_relative{};
};

/// The path with inherited attributes filled in. The type of the first or the last connector must
/// be known.
std::vector<PathConnector> completed(std::vector<PathConnector> path);

/// The unit of measure of the first connector that has one, which those before it take on.
UnitOfMeasure first_unit(const std::vector<PathConnector>& path);
/// Likewise of the last one, which those behind it have.
UnitOfMeasure last_unit(const std::vector<PathConnector>& path);

/// Whether one end of a path is declared as a difference, and the other one as none.
bool mixes_differences(const std::vector<PathConnector>& path);

/// Composes the segments between the connectors of a path, of which there is one more. Where one of
/// them is a difference, all are, and the offsets of their units are left out. Items that nothing
/// maps are matched by match_items(). Throws Error
/// (Input) at `context`, or at the transformation that is wrong, for units that cannot be converted
/// into each other, types that cannot or could lose something, and transformations that do not fit
/// the types. A Boolean becomes a number, 1 or 0, and a whole number at the end of the path a
/// Boolean: see boolean_conversion().
Conversion compose(const std::vector<PathConnector>& path, std::span<const PathSegment> segments,
                   const Context& context);

/// Likewise for a value that is given as text, whose type and enumeration need not be known, and is
/// taken for one that the first transformation is for: the text behind all mappings, and what to do
/// with its numbers. `is_integer`: it has numbers of items, not names.
struct TextConversion {
  std::string text;
  LinearConversion linear;
};
TextConversion compose_text(const std::string& text, const std::vector<PathConnector>& path,
                            std::span<const PathSegment> segments, const Context& context,
                            bool is_integer = false);

/// Whether each value of `from` is representable in `to`. An Enumeration converts if all of its
/// items do.
bool converts_without_loss(ValueType from, ValueType to, const EnumerationItems& items);

/// What values become between a Boolean and a number, which neither FMI nor SSP defines: "true
/// becomes 1, false 0", "0 becomes false, any other number true". Empty for other types, and those
/// that are not converted.
std::string boolean_conversion(ValueType from, ValueType to);

}  // namespace stride::core

#endif
