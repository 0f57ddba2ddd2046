#include "master/engine/model/system/system.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/limited_warnings.h"
#include "master/base/text/suggest.h"
#include "master/engine/model/array_element.h"
#include "master/engine/model/item_match.h"
#include "master/engine/model/item_text.h"
#include "master/engine/model/number_range.h"
#include "master/engine/model/system/declared_dimensions.h"
#include "master/engine/model/system/unknown_variable.h"
#include "master/engine/model/way.h"

namespace stride::core {
namespace {

/// Hints at near names: each compares a name with those of all variables of a unit. They are enough
/// for all warnings and for the mistakes that Diagnostics shows.
constexpr std::size_t kMostHints = 120;

/// Whether suppressUnitConversion changes what a value becomes.
bool suppresses_conversion(const Way& way) {
  const std::vector<PathConnector> path = completed(way.path);
  for (std::size_t i = 0; i < way.segments.size(); ++i) {
    if (!way.segments[i].suppress_unit_conversion) continue;
    const auto conversion = convert(path[i].unit, path[i + 1].unit);
    if (!conversion || !conversion->is_identity()) return true;
  }
  return false;
}

/// The first one that is not an item of the unit's Enumeration, if that has items; or empty.
std::string other_item(const EnumerationItems& declared, const EnumerationItems& items) {
  for (const auto& item : declared) {
    const bool is_known = items.empty() || std::ranges::find(items, item) != items.end();
    if (!is_known) return fmt::format("'{}' ({})", item.first, item.second);
  }
  return "";
}

}  // namespace

std::vector<std::shared_ptr<const UnitDescription>> System::sized_descriptions(
    const SystemDeclaration& declaration) {
  System system;
  Diagnostics diagnostics;
  system.add_components(declaration);
  system.add_structural_values(declaration, diagnostics);
  diagnostics.raise();
  std::vector<std::shared_ptr<const UnitDescription>> descriptions;
  for (const Component& component : system.components_) {
    descriptions.push_back(component.description);
  }
  return descriptions;
}

/// Mistakes are reported together, except those that follow from others.
System::System(const SystemDeclaration& declaration) : name_(declaration.name) {
  Diagnostics diagnostics;
  add_components(declaration);
  add_structural_values(declaration, diagnostics);
  diagnostics.raise();
  check_connectors(declaration, diagnostics);
  add_connections(declaration, diagnostics);
  check_inputs(declaration, diagnostics);
  add_start_values(declaration, diagnostics);
  if (diagnostics.any()) sum_up_misfits(declaration, diagnostics);
  diagnostics.raise();
  add_outputs(declaration, diagnostics);
  diagnostics.raise();
  note_same_names(declaration);
}

System System::with_stepping(std::span<const ComponentDeclaration> components) && {
  for (std::size_t i = 0; i < components.size(); ++i) {
    components_[i].early_return_allowed = components[i].early_return_allowed;
    components_[i].has_snapshots = components[i].has_snapshots;
    components_[i].own_step = components[i].own_step;
  }
  return std::move(*this);
}

std::string System::prefix(VariableId id) const {
  return is_output(id) ? "" : components_[id.component].name + ".";
}

std::string System::range_name(const ElementRange& range) const {
  if (is_whole(range)) return full_name(range.id);
  return prefix(range.id) + element_name(variable(range.id), range.first);
}

std::string System::elements_name(const ConnectorElements& elements) const {
  const ElementRange& first = elements.parts.front();
  if (!elements.are_scalars()) return range_name(first);
  const std::string scalar = full_name(first.id);
  return scalar.substr(0, scalar.rfind('['));
}

bool System::is_sampled(VariableId id) const {
  return !is_output(id) && !is_message(id) &&
         components_[id.component].description->is_sampled(variable(id));
}

bool System::is_message(VariableId id) const {
  if (is_output(id)) return false;
  const UnitDescription& description = *components_[id.component].description;
  if (message_clocks_.empty() || variable(id).causality != Causality::Output) {
    return description.is_message(variable(id));
  }
  return description.is_message(variable(id)) ||
         std::ranges::any_of(variable(id).clocks, [&](ValueReference clock) {
           return ticks_triggered({id.component, *description.find(clock)});
         });
}

bool System::is_reported(VariableId id) const {
  if (is_output(id)) return false;
  if (variable(id).type != ValueType::Clock) return is_message(id);
  const UnitDescription& description = *components_[id.component].description;
  if (!ticks_triggered(id)) return description.is_reported(variable(id));
  return std::ranges::none_of(description.variables, [&](const Variable& carried) {
    return carried.causality == Causality::Output && carried.belongs_to(variable(id).reference);
  });
}

bool System::is_signal(VariableId id) const {
  return is_output(id) || (variable(id).type != ValueType::Clock && !is_message(id));
}

void System::add_components(const SystemDeclaration& declaration) {
  if (declaration.components.empty()) {
    fail_input({}, "the system has no component, so there is nothing to simulate");
  }
  for (const ComponentDeclaration& component : declaration.components) {
    if (!names_.add(component.name, component.description)) {
      fail_input({component.where}, fmt::format("two components are named '{}'", component.name),
                 "give one of them another name");
    }
    check_clocks(component);
    components_.push_back({component.name, component.description, component.early_return_allowed,
                           component.has_snapshots, component.units_of_measure, component.own_step,
                           component.is_table});
  }
}

/// With the sizes that arrays have by the values of structural parameters.
void System::check_connectors(const SystemDeclaration& declaration, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < declaration.components.size(); ++i) {
    for (const ConnectorDeclaration& connector : declaration.components[i].connectors) {
      diagnostics.attempt([&] { check_connector(declaration, i, connector); });
    }
  }
  adopt_units();
}

/// A variable without a unit of measure is shown in the one that its connector declares.
void System::adopt_units() {
  std::map<std::size_t, std::shared_ptr<UnitDescription>> changed;
  for (const auto& [element, unit] : connector_units_) {
    if (!is_whole(element)) continue;
    auto& description = changed[element.id.component];
    if (!description) {
      description =
          std::make_shared<UnitDescription>(*components_[element.id.component].description);
    }
    description->variables[element.id.variable].unit = unit.name;
  }
  for (auto& [component, description] : changed) {
    components_[component].description = std::move(description);
  }
}

/// With the meaning that the unit's description gives to its name, or else the scenario.
UnitOfMeasure System::known_unit(UnitOfMeasure unit, std::size_t component) const {
  if (unit.meaning || unit.name.empty()) return unit;
  const Component& owner = components_[component];
  unit.meaning = find_defined(owner.description->units_of_measure, unit.name);
  if (!unit.meaning && owner.units_of_measure) {
    unit.meaning = find_defined(*owner.units_of_measure, unit.name);
  }
  return unit;
}

void System::check_connector(const SystemDeclaration& declaration, std::size_t component,
                             const ConnectorDeclaration& connector) {
  const Context context{connector.where, components_[component].name, connector.name, {}};
  const ConnectorElements elements = find_elements(context, &declaration);
  check_dimensions(context, connector, elements);
  for (const ElementRange& element : elements.parts) check_element(context, connector, element);
}

void System::check_dimensions(const Context& context, const ConnectorDeclaration& connector,
                              const ConnectorElements& elements) const {
  if (connector.dimensions.empty()) return;
  if (are_same(connector.dimensions, elements.dimensions)) return;
  fail_input(
      context,
      fmt::format("the connector has the dimensions {}, the unit has {}",
                  dimensions_text(connector.dimensions),
                  elements.dimensions.empty() ? "a scalar" : dimensions_text(elements.dimensions)));
}

void System::check_inputs(const SystemDeclaration& declaration, Diagnostics& diagnostics) {
  for (const InputDeclaration& wanted : declaration.inputs) {
    if (diagnostics.mentions(wanted.component, wanted.variable)) continue;
    diagnostics.attempt([&] {
      const Context context{wanted.where, wanted.component, wanted.variable, {}};
      check_way(wanted.via, find_elements(context, nullptr));
    });
  }
}

/// The sizes of connectors of systems; of arrays only the number of elements has to be the same.
void System::check_way(const std::vector<ViaDeclaration>& via, const ConnectorElements& end) {
  for (const ViaDeclaration& connector : via) {
    const std::optional<std::vector<Dimension>> declared = known_sizes(connector.dimensions);
    if (!declared || declared->empty() || element_count(*declared) == end.size()) continue;
    if (!misfits_.insert(connector.connector.name).second) continue;
    fail_input({connector.where, {}, {}, {}},
               fmt::format("the connector '{}' of a system has the dimensions {}, and '{}', which "
                           "it is connected to, is {}",
                           connector.connector.name, dimensions_text(connector.dimensions),
                           elements_name(end), shape_text(end)),
               "correct the size of its <ssc:Dimension>, or the connection");
  }
}

void System::check_element(const Context& context, const ConnectorDeclaration& connector,
                           const ElementRange& element) {
  const Variable& variable = this->variable(element.id);
  if (connector.causality && *connector.causality != variable.causality) {
    fail_input(context,
               fmt::format("the connector has {}, the unit has {}",
                           core::name(*connector.causality), core::name(variable.causality)));
  }
  if (connector.type && *connector.type != variable.type) {
    fail_input(context, fmt::format("the connector has {}, the unit has {}",
                                    core::name(*connector.type), core::name(variable.type)));
  }
  note_other_kin(context, connector, variable);
  if (const std::string other = other_item(connector.items, variable.items); !other.empty()) {
    warnings_.push_back(
        to_text(context) +
        fmt::format("the connector's Enumeration has the item {}, and the unit's has not: {}; the "
                    "unit's items are used",
                    other, item_text(variable.items)));
  }
  if (connector.unit.name.empty()) return;
  const std::size_t component = element.id.component;
  const UnitOfMeasure unit = known_unit(connector.unit, component);
  const auto conversion = convert(unit, known_unit({variable.unit}, component));
  if (!conversion) {
    fail_input(context, fmt::format("the connector is in '{}', the unit's variable in '{}'",
                                    unit.name, variable.unit));
  }
  if (!is_real(variable.type)) return;
  if (variable.unit.empty()) {
    connector_units_[element] = unit;
  } else if (!conversion->is_identity()) {
    other_units_[element] = unit;
  }
}

/// A warning only: the type of a connector of SSP 1.0 does not change what is exchanged.
void System::note_other_kin(const Context& context, const ConnectorDeclaration& connector,
                            const Variable& variable) {
  if (!connector.kin) return;
  const bool is_kin = is_real(*connector.kin) ? is_real(variable.type) : is_integer(variable.type);
  if (is_kin) return;
  warnings_.push_back(to_text(context) +
                      fmt::format("the connector has {}, the unit has {}, which is used",
                                  is_real(*connector.kin) ? "Real" : "Integer",
                                  core::name(variable.type)));
}

void System::check_clocks(const ComponentDeclaration& component) const {
  const UnitDescription& description = *component.description;
  if (description.has_event_mode) return;
  for (const Variable& variable : description.variables) {
    if (!variable.is_time_based_clock()) continue;
    fail_input({component.where, component.name, variable.name, {}},
               fmt::format("this is a {} clock, which ticks in Event Mode, and the unit has none "
                           "(hasEventMode)",
                           core::name(variable.clock->variability)),
               "use a unit that has Event Mode");
  }
}

std::size_t System::find_component(const std::string& name, const Location& where) const {
  if (const auto found = names_.component(name)) return *found;
  std::vector<std::string> names;
  for (const Component& component : components_) names.push_back(component.name);
  fail_input({where}, fmt::format("there is no component '{}'", name), suggestion(name, names));
}

/// If it is not there, the error contains what the declaration, if there is one, expects.
ConnectorElements System::find_elements(const Context& context,
                                        const SystemDeclaration* expecting) {
  const std::size_t index = find_component(context.unit, context.where);
  const UnitDescription& description = *components_[index].description;
  check_unambiguous(context, description);
  if (auto found = core::find_elements(names_, index, description, context)) return *found;
  fail_unknown(context, description, expecting);
}

void System::fail_unknown(const Context& context, const UnitDescription& description,
                          const SystemDeclaration* expecting) {
  const bool has_hint = ++unknown_variables_ <= kMostHints;
  fail_unknown_variable(context, description, expecting, has_hint);
}

/// In the unit that the variable has, or else in the one that a connector declares, its own or that
/// of the whole array.
PathConnector System::path_connector(const ElementRange& element) const {
  const Variable& end = variable(element.id);
  auto declared = connector_units_.find(element);
  if (declared == connector_units_.end()) declared = connector_units_.find(whole(element.id));
  return {range_name(element),
          end.type,
          declared != connector_units_.end() ? declared->second
                                             : known_unit({end.unit}, element.id.component),
          end.items,
          false,
          end.is_relative};
}

/// A connector that has another unit of measure than its variable: SSP takes the variable's only
/// where the connector declares none.
std::optional<PathConnector> System::declared_connector(const ElementRange& element) const {
  auto declared = other_units_.find(element);
  if (declared == other_units_.end()) declared = other_units_.find(whole(element.id));
  if (declared == other_units_.end()) return std::nullopt;
  PathConnector connector = path_connector(element);
  connector.unit = declared->second;
  return connector;
}

/// Element by element where one end consists of scalars.
std::vector<Connection> System::connect(const ConnectionDeclaration& wanted, const Ends& ends) {
  check_ends(wanted, ends.first.parts.front(), ends.second.parts.front());
  check_way(wanted.via, ends.first);
  check_shapes(wanted, ends);
  const std::size_t count = std::max(ends.first.parts.size(), ends.second.parts.size());
  const auto part = [&](const ConnectorElements& end, std::size_t i) -> ElementRange {
    if (end.parts.size() == count) return end.parts[i];
    return {end.parts.front().id, end.parts.front().first + i, 1};
  };
  std::vector<Connection> made;
  for (std::size_t i = 0; i < count; ++i) {
    const ElementRange from = part(ends.first, i);
    const ElementRange to = part(ends.second, i);
    check_ends(wanted, from, to);
    Way way(path_connector(from));
    if (auto declared = declared_connector(from)) way.go(*std::move(declared), PathSegment{});
    if (auto declared = declared_connector(to)) {
      way.go(wanted, *std::move(declared));
      way.go(path_connector(to), PathSegment{});
    } else {
      way.go(wanted, path_connector(to));
    }
    made.push_back({from.id, to.id, converted_on(way.path, way.segments, wanted.where), from.first,
                    to.first, to.size, suppresses_conversion(way)});
  }
  return made;
}

/// With a warning for each change of type that the standards do not define, and where the offset of
/// a unit of measure is left out on the word of one end alone.
Conversion System::converted_on(const std::vector<PathConnector>& path,
                                const std::vector<PathSegment>& segments, const Location& where) {
  Conversion conversion = compose(path, segments, {where, {}, {}, {}});
  if (mixes_differences(path)) note_difference(path, segments, conversion.linear, where);
  note_items(path, segments, where);
  const bool has_boolean = std::ranges::any_of(
      path, [](const PathConnector& connector) { return connector.type == ValueType::Boolean; });
  if (!has_boolean) return conversion;
  const std::vector<PathConnector> whole = completed(path);
  for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
    const std::string becomes = boolean_conversion(*whole[i].type, *whole[i + 1].type);
    if (becomes.empty()) continue;
    warnings_.push_back(
        to_text({.where = where}) +
        fmt::format("'{}', a value of the type {}, is connected to '{}' of the type {}: {}",
                    whole[i].name, core::name(*whole[i].type), whole[i + 1].name,
                    core::name(*whole[i + 1].type), becomes));
  }
  return conversion;
}

/// Where items of two enumerations meet by their names although their numbers differ, or by their
/// numbers although their names do.
void System::note_items(const std::vector<PathConnector>& path,
                        const std::vector<PathSegment>& segments, const Location& where) {
  if (path.front().items.empty()) return;
  const std::vector<PathConnector> whole = completed(path);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i].transformation.kind != Transformation::Kind::None) continue;
    const auto& [from, to] = std::tie(whole[i], whole[i + 1]);
    if (from.type != ValueType::Enumeration || to.type != ValueType::Enumeration) continue;
    const ItemMatch match = match_items(from.items, to.items);
    if (match.by_name.empty() && match.renamed.empty()) continue;
    const std::string wire = to_text({.where = where}) +
                             fmt::format("the Enumerations of '{}' and '{}' ", from.name, to.name);
    warnings_.push_back(
        wire +
        (match.by_name.empty()
             ? fmt::format("have items of the same numbers and other names: {}\n  hint: if that is "
                           "not meant, map them in an <ssc:EnumerationMappingTransformation>",
                           fmt::join(match.renamed, ", "))
             : std::string("have items of the same names and other numbers: they are mapped by "
                           "their names\n  hint: if the numbers are to stay, use an "
                           "<ssc:IntegerMappingTransformation>")));
  }
}

void System::note_difference(const std::vector<PathConnector>& path,
                             const std::vector<PathSegment>& segments,
                             const LinearConversion& linear, const Location& where) {
  std::vector<PathConnector> absolute = path;
  for (PathConnector& connector : absolute) connector.is_relative = false;
  if (compose(absolute, segments, {where, {}, {}, {}}).linear == linear) return;
  const bool from_difference = *path.front().is_relative;
  const PathConnector& difference = from_difference ? path.front() : path.back();
  const PathConnector& other = from_difference ? path.back() : path.front();
  warnings_.push_back(
      to_text({.where = where}) +
      fmt::format("'{}' is declared as a difference (relativeQuantity=\"true\"), and '{}' is not: "
                  "the values are converted from '{}' to '{}' as differences, without an offset\n"
                  "  hint: if they are absolute, set suppressUnitConversion=\"true\" and convert "
                  "them by an <ssc:LinearTransformation>",
                  difference.name, other.name, first_unit(path).name, last_unit(path).name));
}

}  // namespace stride::core
