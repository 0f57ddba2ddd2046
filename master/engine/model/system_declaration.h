// A system as written, by name, unchecked.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_DECLARATION_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_DECLARATION_H

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/conversion.h"
#include "master/engine/model/description.h"
#include "master/engine/model/time/interval.h"
#include "master/engine/model/values.h"

namespace stride::core {

/// A dimension that a connector declares: its size, or the connector that has it.
struct DimensionDeclaration {
  std::optional<std::size_t> size;
  std::string size_connector;
};
struct ConnectorDeclaration {
  std::string name;
  std::optional<ValueType> type;
  std::optional<Causality> causality;
  UnitOfMeasure unit;
  Location where{};
  EnumerationItems items{};  ///< of its Enumeration, if that is declared
  /// Where `type` leaves the width open, as SSP 1.0 does: Float64 for any floating-point number,
  /// Int32 for any integer.
  std::optional<ValueType> kin{};
  std::vector<DimensionDeclaration> dimensions{};  ///< none: not checked
};
struct ComponentDeclaration {
  std::string name;
  std::shared_ptr<const UnitDescription> description;
  std::vector<ConnectorDeclaration> connectors;  ///< may be empty: resolved against the description
  Location where{};
  bool early_return_allowed = true;
  bool has_snapshots = false;
  /// For names that the description does not define; may be null.
  std::shared_ptr<const UnitsOfMeasure> units_of_measure{};
  std::optional<Interval> own_step{};
  bool is_table = false;  ///< its unit plays a table, whose headings decide the types

  bool may_return_early() const { return early_return_allowed && description->may_return_early; }
};
/// A connector of an enclosing or nested system on a connection, and the conversion before it.
struct ViaDeclaration {
  PathConnector connector;
  PathSegment segment;
  std::vector<DimensionDeclaration> dimensions{};  ///< none: not checked
  Location where{};                                ///< of the connector
};
/// A connector is a variable, an element of an array ("m[1,2]"), or an array of which the unit has
/// the elements as scalars: see find_elements().
struct ConnectionDeclaration {
  std::string from_component, from_connector;
  std::string to_component, to_connector;
  bool suppress_unit_conversion = false;
  Location where{};
  Transformation transformation{};    ///< on the way from the last of `via`, as is the above
  std::vector<ViaDeclaration> via{};  ///< connectors of systems in between
};
/// What a connector of a system that no component feeds leads to.
struct InputDeclaration {
  std::string component, variable;
  std::vector<ViaDeclaration> via;  ///< the first one is that connector
  Location where{};                 ///< of the last connection
};
/// A connector of a system whose value can be recorded: that of a component's variable, or, without
/// one, the one that is given to the first of `via`.
struct OutputDeclaration {
  std::string component, variable;
  std::vector<ViaDeclaration> via;  ///< the last one is the connector itself, by its path
  Location where{};
  bool is_inner = false;  ///< not an output of the outermost system: recorded on demand
  std::string value{};
  UnitOfMeasure unit{};     ///< in which the value is given
  bool is_integer = false;  ///< for an Enumeration, the value is the number of an item
};
/// A start value of what a connector may be: see ConnectionDeclaration.
struct StartDeclaration {
  std::string component, variable;
  std::string value;
  UnitOfMeasure unit;  ///< in which the value is given; no name = the variable's own
  Location where{};
  bool suppress_unit_conversion = false;
  Transformation transformation{};
  std::vector<ViaDeclaration> via{};
  std::vector<DimensionDeclaration> dimensions{};  ///< of the value; none: not checked
  /// Whether it is ignored, with a warning, if there is no such variable.
  bool is_optional = false;
  /// Start values with the same non-zero group come from one declaration; at least one of them must
  /// have a target.
  std::size_t group = 0;
  /// Start values with the same non-zero number have the same precedence, so for one variable they
  /// must not differ. The others are ordered.
  std::size_t rank = 0;
  bool is_integer = false;  ///< for an Enumeration, the value has numbers of items, not names
};
struct SystemDeclaration {
  std::string name;
  std::vector<ComponentDeclaration> components;
  std::vector<ConnectionDeclaration> connections;
  std::vector<StartDeclaration> start_values;  ///< a later one replaces an earlier one
  std::vector<OutputDeclaration> outputs{};
  std::vector<InputDeclaration> inputs{};  ///< have no value of their own: they are checked only
};

}  // namespace stride::core

#endif
