#include "master/system/ssp/port_graph.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/engine/model/array_element.h"

namespace stride::ssp {
namespace {

std::string joined(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

[[noreturn]] void fail_no_element(const SystemNode& node, const std::string& name,
                                  const core::Location& where) {
  std::vector<std::string> names;
  for (const ElementNode& element : node.elements) names.push_back(element.name);
  core::fail_input({where, {}, {}, {}}, fmt::format("there is no component '{}'", name),
                   core::suggestion(name, names));
}

bool does_the_same(const core::PathSegment& a, const core::PathSegment& b) {
  const auto parts = [](const core::PathSegment& segment) {
    const core::Transformation& t = segment.transformation;
    return std::tie(segment.suppress_unit_conversion, t.kind, t.linear, t.numbers, t.names);
  };
  return parts(a) == parts(b);
}

}  // namespace

PortGraph::PortGraph(const SystemNode& root) {
  add_system(root, "", nullptr);
  for (std::size_t i = 0; i < connections_.size(); ++i) check_connection(i);
  for (std::size_t i = root.connectors.size(); i < ports_.size(); ++i) warn_of_dead_end(ports_[i]);
}

// ---- Ports ----

void PortGraph::add_system(const SystemNode& node, const std::string& prefix,
                           const SystemNode* around) {
  System& system = systems_[&node];
  system.prefix = prefix;
  system.around = around;
  for (const Connector& connector : node.connectors) {
    const core::ConnectorDeclaration& declared = connector.declared;
    Port port{joined(prefix, declared.name), connector.flow, Port::kNone, declared.name, {}};
    port.path_connector = {port.path, declared.type, declared.unit, declared.items,
                           connector.flow == Flow::In};
    port.kin = declared.kin;
    port.dimensions = declared.dimensions;
    port.where = declared.where;
    system.ports.emplace(declared.name, ports_.size());
    ports_.push_back(std::move(port));
  }
  for (const ElementNode& element : node.elements) {
    system.elements.emplace(element.name, &element);
    const std::string path = joined(prefix, element.name);
    if (element.system) {
      add_system(*element.system, path, &node);
      check_connectors(element, path);
    } else if (!element.dictionary.empty()) {
      dictionaries_[&element] = &find_dictionary(node, element);
    } else {
      add_component(element, path);
    }
  }
  for (const SystemConnection& connection : node.connections) add_connection(node, connection);
}

void PortGraph::add_component(const ElementNode& element, const std::string& path) {
  const auto [twin, is_new] = names_.emplace(path, element.where);
  if (!is_new) {
    core::fail_input({element.where, {}, {}, {}},
                     fmt::format("two components are named '{}'; the first is in line {}", path,
                                 twin->second.line),
                     "components in systems are named by their paths, and a name may hold dots, "
                     "too; give one of them another name");
  }
  for (const Connector& connector : element.connectors) {
    declared_flows_[{&element, connector.declared.name}] = connector.flow;
  }
  places_[&element] = components_.size();
  components_.push_back({&element, path});
}

/// What a component declares that is a system must be there.
void PortGraph::check_connectors(const ElementNode& element, const std::string& path) const {
  const System& inside = systems_.at(element.system.get());
  for (const Connector& connector : element.connectors) {
    if (inside.ports.contains(connector.declared.name)) continue;
    fail_unknown(inside, path, connector.declared.name, connector.declared.where);
  }
}

void PortGraph::fail_unknown(const System& system, const std::string& path,
                             const std::string& connector, const core::Location& where) {
  std::vector<std::string> names;
  for (const auto& [name, port] : system.ports) names.push_back(name);
  core::fail_input(
      {where, {}, {}, {}},
      path.empty() ? fmt::format("the system itself has no connector '{}'", connector)
                   : fmt::format("the system '{}' has no connector '{}'", path, connector),
      names.empty() ? "declare it in its <ssd:Connectors>" : core::suggestion(connector, names));
}

/// The names of dictionaries are looked up from the inside to the outside.
const SignalDictionary& PortGraph::find_dictionary(const SystemNode& system,
                                                   const ElementNode& reference) const {
  std::vector<std::string> names;
  for (const SystemNode* at = &system; at != nullptr; at = systems_.at(at).around) {
    const auto found = at->dictionaries.find(reference.dictionary);
    if (found != at->dictionaries.end()) return found->second;
    for (const auto& [name, dictionary] : at->dictionaries) names.push_back(name);
  }
  core::fail_input({reference.where, {}, {}, {}},
                   fmt::format("there is no signal dictionary '{}' in this system or around it",
                               reference.dictionary),
                   core::suggestion(reference.dictionary, names));
}

/// The port of a connector, and its part within the system.
std::pair<std::size_t, PortGraph::Role> PortGraph::find_end(const SystemNode& node,
                                                            const ConnectionEnd& end,
                                                            const core::Location& where) {
  const System& system = systems_.at(&node);
  if (end.element.empty()) {
    const auto found = system.ports.find(end.connector);
    if (found == system.ports.end()) fail_unknown(system, system.prefix, end.connector, where);
    const Flow flow = ports_[found->second].flow;
    return {found->second, flow == Flow::In    ? Role::Source
                           : flow == Flow::Out ? Role::Sink
                                               : Role::Either};
  }
  const auto element = system.elements.find(end.element);
  if (element == system.elements.end()) fail_no_element(node, end.element, where);
  const std::size_t port = find_port(*element->second, system, end.connector, where);
  const Flow flow = ports_[port].flow;
  return {port, flow == Flow::In ? Role::Sink : flow == Flow::Out ? Role::Source : Role::Either};
}

std::size_t PortGraph::find_port(const ElementNode& element, const System& system,
                                 const std::string& connector, const core::Location& where) {
  const std::string path = joined(system.prefix, element.name);
  if (element.system) {
    const System& inside = systems_.at(element.system.get());
    const auto found = inside.ports.find(connector);
    if (found == inside.ports.end()) fail_unknown(inside, path, connector, where);
    return found->second;
  }
  if (!element.dictionary.empty()) return find_signal(element, path, connector, where);
  const auto [entry, is_new] = shared_.try_emplace({&element, connector}, ports_.size());
  if (!is_new) return entry->second;
  Port port{joined(path, connector), Flow::Unsaid, places_.at(&element), connector, {}};
  auto declared = declared_flows_.find({&element, connector});
  const auto indexed = core::indexed_name(connector);
  if (declared == declared_flows_.end() && indexed) {
    declared = declared_flows_.find({&element, indexed->array});
  }
  if (declared != declared_flows_.end()) port.flow = declared->second;
  ports_.push_back(std::move(port));
  return entry->second;
}

/// All references to a dictionary share its signals.
std::size_t PortGraph::find_signal(const ElementNode& reference, const std::string& path,
                                   const std::string& name, const core::Location& where) {
  const SignalDictionary& dictionary = *dictionaries_.at(&reference);
  const auto entry = dictionary.entries.find(name);
  if (entry == dictionary.entries.end()) {
    std::vector<std::string> names;
    for (const auto& [known, declared] : dictionary.entries) names.push_back(known);
    core::fail_input({where, {}, {}, {}},
                     fmt::format("the signal dictionary '{}', which '{}' refers to, has no "
                                 "entry '{}'",
                                 reference.dictionary, path, name),
                     core::suggestion(name, names));
  }
  const auto [shared, is_new] = shared_.try_emplace({&dictionary, name}, ports_.size());
  if (!is_new) return shared->second;
  const core::ConnectorDeclaration& declared = entry->second;
  Port port{joined(path, name), Flow::Unsaid, Port::kNone, name, {}};
  port.path_connector = {port.path, declared.type, declared.unit, declared.items, false};
  port.dimensions = declared.dimensions;
  port.where = declared.where;
  ports_.push_back(std::move(port));
  return shared->second;
}

// ---- Connections ----

/// In SSP, start and end do not define which way a value goes: the kinds of the connectors do.
/// Where they are left out, the start is the source. A clock that is an input of a unit may be the
/// source of ticks: that of a time-based one.
void PortGraph::add_connection(const SystemNode& node, const SystemConnection& connection) {
  auto [start, start_role] = find_end(node, connection.start, connection.where);
  auto [end, end_role] = find_end(node, connection.end, connection.where);
  const bool is_one_component = ports_[start].is_component() != ports_[end].is_component();
  if (start_role == Role::Sink && end_role == Role::Sink && is_one_component &&
      (is_clock(start) || is_clock(end))) {
    (ports_[start].is_component() ? start_role : end_role) = Role::Source;
  }
  const bool is_reversed = (start_role == Role::Sink && end_role != Role::Sink) ||
                           (start_role == Role::Either && end_role == Role::Source);
  if (start_role == end_role && start_role != Role::Either &&
      !(ports_[start].is_component() && ports_[end].is_component())) {
    fail_direction(start, end, start_role, connection.where);
  }
  if (is_reversed) std::swap(start, end);
  PortConnection added{start, end, connection.segment, connection.where};
  if (is_there(added)) return;
  ports_[start].outgoing.push_back(connections_.size());
  ports_[end].incoming.push_back(connections_.size());
  connections_.push_back(std::move(added));
}

/// Whether a connector of a system is declared as one.
bool PortGraph::is_clock(std::size_t port) const {
  return ports_[port].path_connector.type == core::ValueType::Clock;
}

/// Whether the same is done to the same value on the way to a system's connector; with a warning.
/// What leads to a component is compared as a whole.
bool PortGraph::is_there(const PortConnection& connection) {
  const Port& to = ports_[connection.to];
  if (to.is_component() || to.incoming.empty()) return false;
  const PortConnection& first = connections_[to.incoming.front()];
  if (first.from != connection.from || !does_the_same(first.segment, connection.segment)) {
    return false;
  }
  warnings_.push_back(core::to_text({.where = connection.where}) +
                      fmt::format("the connection of '{}' to '{}' is there already, in line {}; "
                                  "this one is ignored",
                                  ports_[connection.from].path, to.path, first.where.line));
  return true;
}

void PortGraph::fail_direction(std::size_t start, std::size_t end, Role role,
                               const core::Location& where) const {
  const bool are_clocks = is_clock(start) || is_clock(end);
  core::fail_input(
      {where, {}, {}, {}},
      fmt::format("cannot connect '{}' to '{}': a value {} both", ports_[start].path,
                  ports_[end].path, role == Role::Source ? "comes from" : "goes to"),
      are_clocks ? "the connector of a system that a time-based clock's ticks come from is of the "
                   "kind output, and that of a triggered clock that they go to of the kind input"
                 : "an input of a system leads to the inputs of its components, and their outputs "
                   "to its outputs");
}

/// Of a connection that begins or ends at a connector of a system, or at a signal of a dictionary,
/// on whose other side there is none. An input without a source has its start value, and an output
/// may be of no use.
void PortGraph::warn_of_dead_end(const Port& port) {
  if (port.is_component() || port.incoming.empty() == port.outgoing.empty()) return;
  if (port.incoming.empty() && port.flow != Flow::In) {
    const PortConnection& first = connections_[port.outgoing.front()];
    const bool is_connector = port.flow == Flow::Out;
    warnings_.push_back(
        core::to_text({.where = first.where}) +
        fmt::format("the {} '{}' has no source, so '{}' gets no value from it\n  hint: {}",
                    is_connector ? "connector" : "signal", port.path, ports_[first.to].path,
                    is_connector ? "connect an output inside of the system to it"
                                 : "end the connection of its source at it, or declare the "
                                   "connectors with their kinds"));
  } else if (port.outgoing.empty() && port.flow == Flow::In) {
    const PortConnection& last = connections_[port.incoming.front()];
    warnings_.push_back(
        core::to_text({.where = last.where}) +
        fmt::format("the connector '{}' is connected to nothing inside of its system, so the value "
                    "of '{}' goes nowhere\n  hint: connect it to an input inside of the system",
                    port.path, ports_[last.from].path));
  }
}

void PortGraph::check_connection(std::size_t connection) const {
  const Port& port = ports_[connections_[connection].to];
  if (port.is_component() || port.incoming.front() == connection) return;
  const PortConnection& first = connections_[port.incoming.front()];
  core::fail_input({connections_[connection].where, {}, {}, {}},
                   fmt::format("'{}' has two sources: '{}' here and '{}' in line {}", port.path,
                               ports_[connections_[connection].from].path, ports_[first.from].path,
                               first.where.line),
                   "remove one of the two connections");
}

// ---- Ways ----

void PortGraph::follow(std::size_t port, const std::function<void(const Way&)>& found) const {
  Way way;
  follow(port, way, found);
}

void PortGraph::follow(std::size_t port, Way& way,
                       const std::function<void(const Way&)>& found) const {
  for (const std::size_t next : ports_[port].outgoing) {
    const bool is_round = std::any_of(way.begin(), way.end(), [&](std::size_t w) {
      return connections_[w].from == connections_[next].to;
    });
    if (is_round) fail_round(connections_[next]);
    way.push_back(next);
    if (ports_[connections_[next].to].is_component()) {
      found(way);
    } else {
      follow(connections_[next].to, way, found);
    }
    way.pop_back();
  }
}

PortGraph::Way PortGraph::way_to(std::size_t port) const {
  auto [way, round] = trace(port);
  if (round) fail_round(connections_[*round]);
  return std::move(way);
}

std::optional<PortGraph::Way> PortGraph::find_way_to(std::size_t port) const {
  auto [way, round] = trace(port);
  return round ? std::nullopt : std::optional(std::move(way));
}

std::pair<PortGraph::Way, std::optional<std::size_t>> PortGraph::trace(std::size_t port) const {
  Way way;
  std::set<std::size_t> seen;
  while (!ports_[port].is_component() && !ports_[port].incoming.empty()) {
    const std::size_t connection = ports_[port].incoming.front();
    if (!seen.insert(connection).second) return {std::move(way), connection};
    way.insert(way.begin(), connection);
    port = connections_[connection].from;
  }
  return {std::move(way), std::nullopt};
}

void PortGraph::fail_round(const PortConnection& connection) const {
  core::fail_input({connection.where, {}, {}, {}},
                   fmt::format("this connection leads from '{}' back to '{}' through connectors "
                               "of systems alone, so no component provides the value",
                               ports_[connection.from].path, ports_[connection.to].path),
                   "remove one of the connections in the circle");
}

}  // namespace stride::ssp
