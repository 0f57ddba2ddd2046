// The part of System that checks and makes its connections.
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "master/engine/model/array_element.h"
#include "master/engine/model/number_range.h"
#include "master/engine/model/system/system.h"
#include "master/engine/model/system/unknown_variable.h"

namespace stride::core {
namespace {

/// SSP lets a local variable be connected as if it were an output; messages come from outputs only.
/// A time-based clock is an input that asks the master for ticks, and a source of them (FMI-LS-BUS
/// 1.0, "Time-based Tx Clocks").
bool is_source(const Variable& variable) {
  const bool is_local = variable.causality == Causality::Local && variable.is_unclocked_value();
  return is_local || variable.is_time_based_clock() || variable.causality == Causality::Output ||
         variable.causality == Causality::CalculatedParameter;
}

/// In SSP, start and end do not define which way a value goes; where connectors are not declared,
/// the variables do.
bool is_from_input_to_source(const Variable& start, const Variable& end) {
  const bool takes_value =
      start.causality == Causality::Input || start.causality == Causality::Parameter;
  return takes_value && !is_source(start) && is_source(end);
}

/// A parameter takes a value that is known when the unit is initialised, and a tunable one that of
/// another one, too. FMI 1.0 has no time at which it could.
bool may_take(const Variable& source, const Variable& parameter, const UnitDescription& unit) {
  const bool is_known =
      source.variability == Variability::Constant || source.variability == Variability::Fixed ||
      (source.variability == Variability::Tunable && parameter.variability == Variability::Tunable);
  return parameter.causality == Causality::Parameter && is_known &&
         !unit.fmi_version.starts_with("1.");
}

/// What to do about ends of which none gives a value, or none takes it.
const char* direction_hint(const Variable& source, const Variable& target) {
  if (source.causality == Causality::Input && target.causality == Causality::Input) {
    return "connect the output that both are to follow to each of them";
  }
  if (is_source(source) && is_source(target)) return "end the connection at an input";
  if (is_from_input_to_source(source, target)) {
    return "swap start and end of the connections, or declare the connectors with their kinds";
  }
  return "a connection starts at an output and ends at an input";
}

/// The variable that carries a value through a connection between clocked variables also needs its
/// clock connected.
std::vector<VariableId> clocks_of(const System& system, VariableId id) {
  const UnitDescription& description = *system.components()[id.component].description;
  std::vector<VariableId> clocks;
  for (const ValueReference reference : system.variable(id).clocks) {
    clocks.push_back({id.component, *description.find(reference)});
  }
  return clocks;
}

}  // namespace

void System::add_connections(const SystemDeclaration& declaration, Diagnostics& diagnostics) {
  find_message_clocks(declaration);
  DeclaredConnections declared;
  for (const ConnectionDeclaration& wanted : declaration.connections) {
    const std::optional<Ends> ends = find_ends(declaration, wanted, diagnostics);
    if (!ends) continue;
    diagnostics.attempt([&] {
      for (const Connection& connection : connect(wanted, *ends)) {
        add_connection(wanted, connection, declared);
      }
    });
  }
  std::ranges::sort(connections_, {}, &Connection::target);
  if (diagnostics.any()) return;  // a clock's connection may be among them
  for (const Connection& connection : connections_) {
    const ConnectionDeclaration& wanted = *declared.at(connection.target()).wanted;
    diagnostics.attempt([&] {
      check_message(wanted, connection);
      check_alike(declared, connection);
    });
    if (variable(connection.to).is_triggered_clock()) note_missing_data(wanted, connection);
  }
}

/// No two of those that are declared so far overlap, so only the neighbours of one more may.
void System::add_connection(const ConnectionDeclaration& wanted, const Connection& connection,
                            DeclaredConnections& declared) {
  const ElementRange target = connection.target();
  const auto behind = declared.lower_bound(target);
  auto same = declared.end();
  if (behind != declared.end() && behind->first.overlaps(target)) {
    same = behind;
  } else if (behind != declared.begin() && std::prev(behind)->first.overlaps(target)) {
    same = std::prev(behind);
  }
  if (same != declared.end()) {
    const auto& [first, place] = same->second;
    return add_second(wanted, connection, *first, connections_[place]);
  }
  declared.emplace_hint(behind, target, Declared{&wanted, connections_.size()});
  connections_.push_back(connection);
}

/// A unit that has few of them is another one than was meant.
void System::sum_up_misfits(const SystemDeclaration& declaration, Diagnostics& diagnostics) const {
  std::map<std::string, std::set<std::string>> expected;
  for (const ConnectionDeclaration& wanted : declaration.connections) {
    expected[wanted.from_component].insert(wanted.from_connector);
    expected[wanted.to_component].insert(wanted.to_connector);
  }
  for (const ComponentDeclaration& component : declaration.components) {
    std::set<std::string>& variables = expected[component.name];
    for (const ConnectorDeclaration& declared : component.connectors) {
      variables.insert(declared.name);
    }
    const auto known = static_cast<std::size_t>(std::ranges::count_if(
        variables, [&](const std::string& name) { return is_known(component.name, name); }));
    if (known == variables.size() || variables.size() == 1) continue;
    diagnostics.sum_up(component.name, component.where,
                       fmt::format("its model '{}' has {} of the {} variables that are expected",
                                   component.description->model_name,
                                   known == 0 ? "none" : std::to_string(known), variables.size()));
  }
}

/// Whether the name denotes anything that the unit has, be it with a wrong index.
bool System::is_known(const std::string& component, const std::string& connector) const {
  const std::optional<std::size_t> index = names_.component(component);
  if (!index) return false;
  try {
    const Context context{{}, component, connector, {}};
    return core::find_elements(names_, *index, *components_[*index].description, context)
        .has_value();
  } catch (const Error&) {
    return true;
  }
}

std::span<const Connection> System::connections_to(VariableId input) const {
  const auto found = std::ranges::equal_range(connections_, input, {}, &Connection::to);
  return {found.begin(), found.end()};
}

std::vector<ElementRange> System::unconnected_elements(VariableId input) const {
  std::vector<ElementRange> free;
  std::size_t next = 0;
  const auto skip_to = [&](std::size_t element) {
    if (element > next) free.push_back({input, next, element - next});
  };
  for (const Connection& connection : connections_to(input)) {
    skip_to(connection.to_first);
    next = connection.to_first + connection.size;
  }
  skip_to(variable(input).size);
  return free;
}

std::vector<VariableId> System::partly_connected_inputs() const {
  std::vector<VariableId> inputs;
  for (const Connection& connection : connections_) {
    const bool is_first = connections_to(connection.to).data() == &connection;
    if (!is_first || is_whole(connection.target())) continue;
    if (!unconnected_elements(connection.to).empty()) inputs.push_back(connection.to);
  }
  return inputs;
}

const Connection& System::connection_to(const ElementRange& target) const {
  return *std::ranges::lower_bound(connections_, target, {}, &Connection::target);
}

/// A tick without the values that both sides have for it is possible, and seldom meant.
void System::note_missing_data(const ConnectionDeclaration& wanted, const Connection& clocks) {
  const auto data_of = [&](VariableId clock, Causality causality) {
    const auto& variables = components_[clock.component].description->variables;
    std::vector<VariableId> data;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (variables[i].causality != causality) continue;
      if (variables[i].belongs_to(variable(clock).reference)) data.push_back({clock.component, i});
    }
    return data;
  };
  const std::vector<VariableId> sent = data_of(clocks.from, Causality::Output);
  const std::vector<VariableId> expected = data_of(clocks.to, Causality::Input);
  if (sent.empty() || expected.empty()) return;
  const auto is_connected = [&](VariableId input) { return !connections_to(input).empty(); };
  if (std::ranges::any_of(expected, is_connected)) return;
  warnings_.push_back(fmt::format(
      "{}the clock '{}' is connected to '{}', but none of the values that belong to it: it ticks, "
      "and brings no data\n  hint: connect '{}' to '{}', too",
      core::to_text(Context{wanted.where}), full_name(clocks.from), full_name(clocks.to),
      full_name(sent.front()), full_name(expected.front())));
}

/// Nothing if it is not there.
std::optional<VariableId> System::find_end(const std::string& component,
                                           const std::string& connector) const {
  const std::optional<std::size_t> index = names_.component(component);
  if (!index) return std::nullopt;
  const std::optional<std::size_t> place = names_.variable(*index, connector);
  if (!place) return std::nullopt;
  return VariableId{*index, *place};
}

/// What they send depends on it, so they are found before anything is checked.
void System::find_message_clocks(const SystemDeclaration& declaration) {
  for (const ConnectionDeclaration& wanted : declaration.connections) {
    const auto from = find_end(wanted.from_component, wanted.from_connector);
    const auto to = find_end(wanted.to_component, wanted.to_connector);
    if (!from || !to) continue;
    if (is_backwards(*from, *to)) message_clocks_.insert(*to);
    if (!variable(*from).is_time_based_clock()) continue;
    if (variable(*to).is_triggered_clock()) message_clocks_.insert(*from);
  }
}

/// Both, if they are there and nothing is wrong with them so far.
std::optional<System::Ends> System::find_ends(const SystemDeclaration& declaration,
                                              const ConnectionDeclaration& wanted,
                                              Diagnostics& diagnostics) {
  const auto find = [&](const std::string& component, const std::string& connector) {
    std::optional<ConnectorElements> end;
    if (diagnostics.mentions(component, connector)) return end;
    diagnostics.attempt([&] {
      end = find_elements({wanted.where, component, connector, {}}, &declaration);
    });
    return end;
  };
  auto from = find(wanted.from_component, wanted.from_connector);
  auto to = find(wanted.to_component, wanted.to_connector);
  if (!from || !to) return std::nullopt;
  const ElementRange& start = from->parts.front();
  const ElementRange& end = to->parts.front();
  if (is_backwards(start.id, end.id)) return Ends{std::move(*to), std::move(*from)};
  if (!wanted.via.empty() || !is_from_input_to_source(variable(start.id), variable(end.id))) {
    return Ends{std::move(*from), std::move(*to)};
  }
  warnings_.push_back(to_text({.where = wanted.where}) +
                      fmt::format("the connection starts at '{0}', which is {1}, and ends at "
                                  "'{2}', which is {3}: it is taken for one from '{2}' to '{0}'"
                                  "\n  hint: swap start and end, or declare both connectors with "
                                  "their kinds",
                                  range_name(start), core::name(variable(start.id).causality),
                                  range_name(end), core::name(variable(end.id).causality)));
  return Ends{std::move(*to), std::move(*from)};
}

/// A time-based and a triggered clock are inputs both, so connectors do not tell the direction.
bool System::is_backwards(VariableId from, VariableId to) const {
  const Variable& source = variable(from);
  return source.is_triggered_clock() && source.causality == Causality::Input &&
         variable(to).is_time_based_clock();
}

/// One that says the same once more is ignored.
void System::add_second(const ConnectionDeclaration& wanted, const Connection& connection,
                        const ConnectionDeclaration& first, const Connection& same) {
  const std::string source = range_name(connection.source());
  const std::string target = range_name(connection.target());
  if (same.source() == connection.source() && same.target() == connection.target() &&
      same.conversion == connection.conversion) {
    warnings_.push_back(to_text({.where = wanted.where}) +
                        fmt::format("the connection of '{}' to '{}' is there already, in line {}; "
                                    "this one is ignored",
                                    source, target, first.where.line));
    return;
  }
  const bool is_same_target = same.target() == connection.target();
  fail_input(
      {wanted.where,
       components_[connection.to.component].name,
       target.substr(prefix(connection.to).size()),
       {}},
      fmt::format("this input has two sources: '{}' here and '{}' in line {}{}", source,
                  range_name(same.source()), first.where.line,
                  is_same_target ? "" : fmt::format(", for '{}'", range_name(same.target()))),
      "remove one of the two connections");
}

/// A continuous input is written at communication points, except where its source belongs to a
/// clock: that changes it in Event Mode. An array is written as a whole.
void System::check_alike(const DeclaredConnections& declared, const Connection& connection) const {
  const Variable& input = variable(connection.to);
  if (is_whole(connection.target()) || input.variability != Variability::Continuous) return;
  const Connection& first = connections_to(connection.to).front();
  const bool is_first_sampled = is_sampled(first.from);
  if (is_sampled(connection.from) == is_first_sampled) return;
  fail_input(
      {declared.at(connection.target()).wanted->where,
       components_[connection.to.component].name,
       input.name,
       {}},
      fmt::format("'{}', which {} to a clock, is connected to '{}', and '{}', which {}, to "
                  "'{}' in line {}",
                  range_name(connection.source()), is_first_sampled ? "does not belong" : "belongs",
                  range_name(connection.target()), range_name(first.source()),
                  is_first_sampled ? "does" : "does not", range_name(first.target()),
                  declared.at(first.target()).wanted->where.line),
      "the elements of a continuous input change together: connect all of them to outputs "
      "that belong to clocks, or none");
}

/// What carries a message from clock to clock needs its clock connected, too.
void System::check_message(const ConnectionDeclaration& wanted,
                           const Connection& connection) const {
  if (is_sampled(connection.to)) return;
  const auto from_clocks = clocks_of(*this, connection.from);
  for (const VariableId to_clock : clocks_of(*this, connection.to)) {
    const std::span<const Connection> ticks = connections_to(to_clock);
    if (!ticks.empty() && std::ranges::count(from_clocks, ticks.front().from) > 0) continue;
    fail_input(
        {wanted.where, components_[connection.to.component].name, variable(connection.to).name, {}},
        fmt::format("its clock '{}' is not connected to the clock of '{}'", full_name(to_clock),
                    full_name(connection.from)),
        "a message needs two connections: one for its value, one for its clock");
  }
}

/// A message goes to a message. A value that is sampled at a time-based clock's ticks, on either
/// side, may be connected to any other value that is no message.
void System::check_clocked(const ConnectionDeclaration& wanted, const ElementRange& from_range,
                           const ElementRange& to_range) const {
  const VariableId from = from_range.id;
  const VariableId to = to_range.id;
  const std::string wire =
      fmt::format("'{}' to '{}'", range_name(from_range), range_name(to_range));
  const Context context{wanted.where, {}, {}, {}};
  if (variable(to).is_time_based_clock()) {
    fail_input(
        context,
        fmt::format("cannot connect {}: '{}' is a {} clock, which ticks by the time alone", wire,
                    full_name(to), core::name(variable(to).clock->variability)),
        "remove the connection; the master ticks such a clock at the times that its unit gives");
  }
  for (const ElementRange& range : {from_range, to_range}) {
    if (!is_message(range.id) || is_whole(range)) continue;
    fail_input(context,
               fmt::format("cannot connect {}: '{}' is a message, which is sent and received as a "
                           "whole",
                           wire, full_name(range.id)),
               "connect the whole array to another one");
  }
  if (is_message(from) == is_message(to)) return;
  const VariableId message = is_message(from) ? from : to;
  fail_input(context,
             fmt::format("cannot connect {}: '{}' is a message, which exists at the ticks of its "
                         "triggered clock only, and the other is not",
                         wire, full_name(message)),
             "connect a message, and its clock, to another message");
}

/// Clocks tick in Event Mode only, so without it a message would be lost without a word.
void System::check_event_mode(const ConnectionDeclaration& wanted, VariableId id) const {
  const Variable& connected = variable(id);
  if (connected.is_unclocked_value() || components_[id.component].description->has_event_mode)
    return;
  fail_input({wanted.where, components_[id.component].name, connected.name, {}},
             "this is a clock, or belongs to one, which ticks in Event Mode, and the unit has none "
             "(hasEventMode)",
             "use a unit that has Event Mode");
}

/// A column of whole numbers without a type in its heading is one of Float64.
void System::check_table_type(const Context& context, const ElementRange& from,
                              const ElementRange& to) const {
  const Variable& column = variable(from.id);
  const ValueType wanted = variable(to.id).type;
  const bool is_column = components_[from.id.component].is_table;
  if (!is_column || !is_real(column.type) || !is_integer(wanted)) return;
  const ValueType type = wanted == ValueType::Enumeration ? ValueType::Int64 : wanted;
  fail_input(context,
             fmt::format("cannot connect '{}' to '{}': the column is read as {}, and the input is "
                         "{}",
                         range_name(from), range_name(to), name_with_article(column.type),
                         name_with_article(wanted)),
             fmt::format("declare its type in its heading in the table: '{}: {}'", column.name,
                         core::name(type)));
}

void System::check_ends(const ConnectionDeclaration& wanted, const ElementRange& from,
                        const ElementRange& to) const {
  const Variable& source = variable(from.id);
  const Variable& target = variable(to.id);
  const std::string wire = fmt::format("'{}' to '{}'", range_name(from), range_name(to));
  const Context context{wanted.where, {}, {}, {}};
  if (!is_source(source)) {
    fail_input(context,
               fmt::format("cannot connect {}: '{}' is not an output but {}, and '{}' is {}", wire,
                           range_name(from), core::name(source.causality), range_name(to),
                           core::name(target.causality)),
               direction_hint(source, target));
  }
  const UnitDescription& unit = *components_[to.id.component].description;
  if (target.causality != Causality::Input && !may_take(source, target, unit)) {
    const bool is_parameter = target.causality == Causality::Parameter ||
                              target.causality == Causality::StructuralParameter;
    fail_input(context,
               fmt::format("cannot connect {}: '{}' is not an input but {}, and '{}' is {}", wire,
                           range_name(to), core::name(target.causality), range_name(from),
                           core::name(source.causality)),
               is_parameter ? "give the parameter its value in a <ssd:ParameterBinding>"
                            : direction_hint(source, target));
  }
  check_table_type(context, from, to);
  check_clocked(wanted, from, to);
  for (const ElementRange& end : {from, to}) check_event_mode(wanted, end.id);
}

/// Arrays may differ in their dimensions, if they have as many elements; the scalars of an array
/// are found by their indices, so there the dimensions are the same.
void System::check_shapes(const ConnectionDeclaration& wanted, const Ends& ends) const {
  const auto& [from, to] = ends;
  const bool has_scalars = from.are_scalars() || to.are_scalars();
  if (has_scalars ? from.dimensions == to.dimensions : from.size() == to.size()) return;
  fail_input({wanted.where, {}, {}, {}},
             fmt::format("cannot connect '{}' to '{}': {} and {}", elements_name(from),
                         elements_name(to), shape_text(from), shape_text(to)),
             from.dimensions.empty() != to.dimensions.empty()
                 ? "an element of an array is named by its indices, such as 'x[1]'"
                 : "");
}

}  // namespace stride::core
