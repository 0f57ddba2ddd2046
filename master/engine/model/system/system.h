// The system: components and connections, checked once and never changed afterwards.
#ifndef STRIDE_MASTER_ENGINE_MODEL_SYSTEM_SYSTEM_H
#define STRIDE_MASTER_ENGINE_MODEL_SYSTEM_SYSTEM_H

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "master/base/diagnostics.h"
#include "master/base/error.h"
#include "master/base/limited_warnings.h"
#include "master/engine/model/conversion.h"
#include "master/engine/model/description.h"
#include "master/engine/model/system/connector_elements.h"
#include "master/engine/model/system/name_index.h"
#include "master/engine/model/system_declaration.h"
#include "master/engine/model/time/interval.h"
#include "master/engine/model/values.h"
#include "master/engine/model/variable_id.h"
#include "master/engine/model/way.h"

namespace stride::core {

struct Component {
  std::string name;
  std::shared_ptr<const UnitDescription> description;
  /// Whether its unit is instantiated with earlyReturnAllowed.
  bool early_return_allowed = true;
  /// Whether its process can be saved, instead of a state that the unit does not have.
  bool has_snapshots = false;
  /// Those that the scenario defines; may be null.
  std::shared_ptr<const UnitsOfMeasure> units_of_measure{};
  /// The step that it is called with, whatever the other components' steps are.
  std::optional<Interval> own_step{};
  bool is_table = false;  ///< see ComponentDeclaration

  /// Whether it is called at the ends of its own steps only. What may return early is called at
  /// each communication point, so that its events are exact; its own step is its longest one.
  bool keeps_own_step() const { return own_step && !may_return_early(); }
  bool may_return_early() const { return early_return_allowed && description->may_return_early; }
  bool can_save_state() const { return description->can_save_state || has_snapshots; }
};
/// Each element of `from` is connected to the one of `to` that has the same place in its range.
struct Connection {
  VariableId from;
  VariableId to;
  Conversion conversion;
  std::size_t from_first = 0;  ///< element
  std::size_t to_first = 0;
  std::size_t size = 1;  ///< the number of elements
  /// Units of measure differ on the way, and suppressUnitConversion leaves the numbers as they are.
  bool keeps_number = false;

  ElementRange source() const { return {from, from_first, size}; }
  ElementRange target() const { return {to, to_first, size}; }
};
/// A connector of a system: a component's variable, or an element of one, converted, with another
/// name; or a value that is given to it.
struct SystemOutput {
  VariableId from;
  Conversion conversion;
  Variable variable;  ///< its name, type, size and unit
  std::size_t from_first = 0;
  bool is_inner = false;                 ///< not an output of the outermost system
  std::optional<ValueBlock> constant{};  ///< has no `from` then
};
struct StartValue {
  VariableId id;
  ValueBlock value;  ///< of all elements
  /// Elements that no value was given for, ascending: they keep the unit's own.
  std::vector<std::size_t> kept{};

  /// The value with the elements that are kept, of those that the unit has.
  ValueBlock over(const ValueBlock& own) const;
};

/// An immutable, valid system. Components are in the order of the file, connections are sorted by
/// target; no two of them lead to the same element.
class System {
 public:
  /// Checks names, types, causality, units, sizes, clocks and that each input has one source at
  /// most. Throws Error of the kind Input with file and line, and with the nearest name where a
  /// name is unknown; several mistakes are one Error, with a line for each.
  explicit System(const SystemDeclaration& declaration);

  /// The same system with the steps, snapshots and early returns of these components, which are
  /// those of its declaration. Nothing else depends on them, so nothing is checked again.
  System with_stepping(std::span<const ComponentDeclaration> components) &&;

  /// The descriptions of the components, with the sizes that structural parameters give. Throws
  /// Error as the constructor does, for these parameters.
  static std::vector<std::shared_ptr<const UnitDescription>> sized_descriptions(
      const SystemDeclaration& declaration);

  const std::string& name() const { return name_; }
  const std::vector<Component>& components() const { return components_; }
  /// The index of the component with this name. Throws Error (Input) at `where`, with the nearest
  /// name, if there is none.
  std::size_t find_component(const std::string& name, const Location& where) const;
  const std::vector<Connection>& connections() const { return connections_; }
  /// Those that end at the input: several, where they end at different elements.
  std::span<const Connection> connections_to(VariableId input) const;
  /// Inputs of which some elements are connected, and others are not, sorted.
  std::vector<VariableId> partly_connected_inputs() const;
  /// The elements of the input that no connection leads to.
  std::vector<ElementRange> unconnected_elements(VariableId input) const;
  /// The one whose target() this is. It has to be there.
  const Connection& connection_to(const ElementRange& target) const;
  const std::vector<StartValue>& start_values() const { return start_values_; }
  /// Outputs of the system, then connectors of systems in it; see output_id() for their ids. None
  /// is a message.
  const std::vector<SystemOutput>& outputs() const { return outputs_; }
  VariableId output_id(std::size_t output) const { return {components_.size(), output}; }
  bool is_output(VariableId id) const { return id.component == components_.size(); }
  /// Of the variables that share one value in their unit the first one; else the variable itself.
  VariableId value_owner(VariableId id) const;
  /// In which a start value for these elements is given.
  UnitOfMeasure start_unit(const StartDeclaration& declaration, const ElementRange& part) const;
  /// Those of structural parameters, sorted by component; the sizes of the components' arrays, in
  /// their descriptions, follow from them.
  const std::vector<StartValue>& structural_values() const { return structural_values_; }
  /// What was ignored, or taken for something that it is not by the standards, as text.
  const std::vector<std::string>& warnings() const { return warnings_; }

  const Variable& variable(VariableId id) const {
    if (is_output(id)) return outputs_[id.variable].variable;
    return components_[id.component].description->variables[id.variable];
  }
  /// Whether the variable belongs to time-based clocks only; see UnitDescription::is_sampled().
  bool is_sampled(VariableId id) const;
  /// Whether the variable is a message: as UnitDescription::is_message() says, or an output that
  /// belongs to a time-based clock which is connected to a triggered one.
  bool is_message(VariableId id) const;
  /// Whether the variable's messages are reported: it is one, or a clock that carries none,
  /// triggered or connected to a triggered one.
  bool is_reported(VariableId id) const;
  /// Whether the variable is a signal: neither a clock nor a message. Outputs of the system are.
  bool is_signal(VariableId id) const;
  /// Whether it is a time-based clock that is connected to a triggered one.
  bool ticks_triggered(VariableId id) const { return message_clocks_.contains(id); }
  /// The unit of measure of a component's variable, or of its connector; with its meaning, if that
  /// is defined.
  UnitOfMeasure unit_of_measure(VariableId id) const { return path_connector(whole(id)).unit; }
  /// "component.variable"; of an output of the system its name.
  std::string full_name(VariableId id) const { return prefix(id) + variable(id).name; }
  /// Likewise, with its indices if it is an element of an array: "component.variable[2]".
  std::string range_name(const ElementRange& range) const;
  /// Likewise; of scalars that stand for an array "component.array".
  std::string elements_name(const ConnectorElements& elements) const;
  bool is_whole(const ElementRange& range) const { return range.size == variable(range.id).size; }
  /// "component.", or empty for an output of the system.
  std::string prefix(VariableId id) const;

 private:
  System() = default;
  void add_components(const SystemDeclaration& declaration);
  void add_connections(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void sum_up_misfits(const SystemDeclaration& declaration, Diagnostics& diagnostics) const;
  void note_same_names(const SystemDeclaration& declaration);
  void note_same_names(const SystemDeclaration& declaration, std::size_t outer, std::size_t inner,
                       LimitedWarnings& twice) const;
  void note_shadowed(const OutputDeclaration& output);
  void add_outputs(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void add_output(const OutputDeclaration& output, const SystemDeclaration& declaration);
  void add_output(const OutputDeclaration& declaration, const ElementRange& from,
                  const std::string& name);
  void add_if_right(const OutputDeclaration& output, const SystemDeclaration& declaration);
  void add_constant(const OutputDeclaration& output);
  /// A start value and what it is for.
  struct Target {
    const StartDeclaration* declaration;
    ConnectorElements elements;
  };
  /// What a variable, or those that share its value, have of start values so far.
  struct GivenElements {
    VariableId id;  ///< the last one that was given a value
    ValueBlock value;
    std::vector<bool> is_given;
    std::vector<std::pair<ElementRange, const StartDeclaration*>> givers{};
  };
  using GivenValues = std::map<VariableId, GivenElements>;  ///< by value_owner()
  bool is_structural(const StartDeclaration& declaration) const;
  std::optional<Target> find_target(const StartDeclaration& declaration) const;
  std::vector<Target> find_targets(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void add_structural_values(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void add_start_values(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void check_value_dimensions(const Target& target) const;
  void give(const Target& target, GivenValues& values);
  void give(const StartDeclaration& declaration, const ElementRange& part, const ValueBlock& value,
            GivenValues& values);
  void check_giver(const StartDeclaration& declaration, const ElementRange& part,
                   const ValueBlock& value, const GivenElements& given);
  bool is_same_value(const ElementRange& part, const ValueBlock& value,
                     const GivenElements& given) const;
  Way way_of(const StartDeclaration& declaration, const ElementRange& part) const;
  void note_unit(const Way& way, const Location& where);
  static std::vector<StartValue> listed(GivenValues values);
  void resize(const StartDeclaration& declaration, VariableId structural_parameter,
              std::size_t size);
  [[noreturn]] void fail_unknown(const Context& context, const UnitDescription& description,
                                 const SystemDeclaration* expecting);
  void check_connectors(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void check_inputs(const SystemDeclaration& declaration, Diagnostics& diagnostics);
  void check_way(const std::vector<ViaDeclaration>& via, const ConnectorElements& end);
  void check_connector(const SystemDeclaration& declaration, std::size_t component,
                       const ConnectorDeclaration& connector);
  void check_dimensions(const Context& context, const ConnectorDeclaration& connector,
                        const ConnectorElements& elements) const;
  void check_element(const Context& context, const ConnectorDeclaration& connector,
                     const ElementRange& element);
  void note_other_kin(const Context& context, const ConnectorDeclaration& connector,
                      const Variable& variable);
  void check_clocks(const ComponentDeclaration& component) const;
  void find_message_clocks(const SystemDeclaration& declaration);
  std::optional<VariableId> find_end(const std::string& component,
                                     const std::string& connector) const;
  void check_clocked(const ConnectionDeclaration& declaration, const ElementRange& from,
                     const ElementRange& to) const;
  void check_event_mode(const ConnectionDeclaration& declaration, VariableId id) const;
  void check_message(const ConnectionDeclaration& declaration, const Connection& connection) const;
  void note_missing_data(const ConnectionDeclaration& declaration, const Connection& clocks);
  using Ends = std::pair<ConnectorElements, ConnectorElements>;
  ConnectorElements find_elements(const Context& context, const SystemDeclaration* expecting);
  bool is_known(const std::string& component, const std::string& connector) const;
  std::optional<Ends> find_ends(const SystemDeclaration& declaration,
                                const ConnectionDeclaration& wanted, Diagnostics& diagnostics);
  /// Where the connections come from, until they are sorted: by their targets.
  struct Declared {
    const ConnectionDeclaration* wanted;
    std::size_t place;
  };
  using DeclaredConnections = std::map<ElementRange, Declared>;
  void add_connection(const ConnectionDeclaration& declaration, const Connection& connection,
                      DeclaredConnections& declared);
  void add_second(const ConnectionDeclaration& declaration, const Connection& connection,
                  const ConnectionDeclaration& first, const Connection& same);
  void check_alike(const DeclaredConnections& declared, const Connection& connection) const;
  bool is_backwards(VariableId from, VariableId to) const;
  std::vector<Connection> connect(const ConnectionDeclaration& declaration, const Ends& ends);
  void check_shapes(const ConnectionDeclaration& declaration, const Ends& ends) const;
  Conversion converted_on(const std::vector<PathConnector>& path,
                          const std::vector<PathSegment>& segments, const Location& where);
  void note_items(const std::vector<PathConnector>& path, const std::vector<PathSegment>& segments,
                  const Location& where);
  void note_difference(const std::vector<PathConnector>& path,
                       const std::vector<PathSegment>& segments, const LinearConversion& linear,
                       const Location& where);
  void check_table_type(const Context& context, const ElementRange& from,
                        const ElementRange& to) const;
  void check_ends(const ConnectionDeclaration& declaration, const ElementRange& from,
                  const ElementRange& to) const;
  void adopt_units();
  UnitOfMeasure known_unit(UnitOfMeasure unit, std::size_t component) const;
  PathConnector path_connector(const ElementRange& element) const;
  std::optional<PathConnector> declared_connector(const ElementRange& element) const;
  ElementRange whole(VariableId id) const { return {id, 0, variable(id).size}; }
  void note_missing(const StartDeclaration& declaration);
  void note_replaced(const Target& target);
  ValueBlock start_value(const StartDeclaration& declaration, const ElementRange& part,
                         const std::string& text);

  std::string name_;
  std::vector<Component> components_;
  NameIndex names_;
  std::vector<Connection> connections_;
  std::vector<StartValue> start_values_;
  std::vector<SystemOutput> outputs_;
  std::vector<StartValue> structural_values_;
  std::vector<std::string> warnings_;
  std::map<ElementRange, UnitOfMeasure> connector_units_;  ///< of variables that have none
  std::map<ElementRange, UnitOfMeasure> other_units_;      ///< of connectors, not their variables'
  std::set<VariableId> message_clocks_;  ///< time-based clocks that are connected to triggered ones
  std::size_t unknown_variables_ = 0;    ///< reported so far
  std::set<std::string> misfits_;        ///< connectors of systems that were reported
  /// Of connectors of systems without one, in which their value is taken, and by what.
  std::map<std::string, std::pair<UnitOfMeasure, std::string>> taken_units_;
  std::set<std::string> ambiguous_units_;  ///< such connectors that were reported
};

}  // namespace stride::core

#endif
