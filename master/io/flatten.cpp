#include "master/io/flatten.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "master/core/suggest.h"

namespace stride::io {
namespace {

using core::ViaDeclaration;

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Where connections meet: a component's connector, a system's, or a signal of a dictionary.
struct Port {
  std::string path;  ///< for people: "arm.motor.torque"
  Flow flow = Flow::Unsaid;
  std::size_t component = kNone;  ///< of a component's connector
  std::string connector;
  core::Waypoint waypoint;              ///< of another
  std::vector<std::size_t> outgoing{};  ///< wires, once their directions are known
  std::vector<std::size_t> incoming{};

  bool is_component() const { return component != kNone; }
};

/// A connection that knows its direction.
struct Wire {
  std::size_t from, to;  ///< ports
  core::Passage passage;
  core::Location where;
};

/// The part that a port plays within a system.
enum class Role { Source, Sink, Either };

std::string joined(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

class Flattener {
 public:
  explicit Flattener(std::vector<std::string>& warnings) : warnings_(warnings) {}

  FlatSystem run(const SystemNode& root) {
    flat_.declaration.name = root.name;
    add_system(root, "");
    if (flat_.declaration.components.empty()) {
      core::fail_input({root.where, {}, {}, {}},
                       "the system has no component, so there is nothing to simulate");
    }
    for (std::size_t i = 0; i < wires_.size(); ++i) check_wire(i);
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (!ports_[i].is_component()) continue;
      std::vector<std::size_t> way;
      follow(i, way, [&](const std::vector<std::size_t>& found) { add_connection(found); });
    }
    add_parameters(root);
    add_outputs(root);
    return std::move(flat_);
  }

 private:
  // ---- Ports ----

  struct System {
    std::string prefix;
    const SystemNode* around = nullptr;
    std::map<std::string, std::size_t> ports;  ///< of its connectors
  };
  using PortKey = std::pair<const void*, std::string>;

  void add_system(const SystemNode& node, const std::string& prefix,
                  const SystemNode* around = nullptr) {
    System& system = systems_[&node];
    system.prefix = prefix;
    system.around = around;
    for (const Connector& connector : node.connectors) {
      const core::ConnectorDeclaration& declared = connector.declared;
      Port port{joined(prefix, declared.name), connector.flow, kNone, declared.name, {}};
      port.waypoint = {port.path, declared.type, declared.unit, declared.items,
                       connector.flow == Flow::In};
      system.ports.emplace(declared.name, ports_.size());
      ports_.push_back(std::move(port));
    }
    for (const ElementNode& element : node.elements) {
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
    for (const SystemConnection& connection : node.connections) add_wire(node, connection);
  }

  void add_component(const ElementNode& element, const std::string& path) {
    auto& components = flat_.declaration.components;
    const auto [twin, is_new] = names_.emplace(path, element.where);
    if (!is_new) {
      core::fail_input({element.where, {}, {}, {}},
                       fmt::format("two components are named '{}'; the first is in line {}", path,
                                   twin->second.line),
                       "components in systems are named by their paths, and a name may hold dots, "
                       "too; give one of them another name");
    }
    components_[&element] = components.size();
    core::ComponentDeclaration& component = components.emplace_back();
    component.name = path;
    component.where = element.where;
    for (const Connector& connector : element.connectors) {
      component.connectors.push_back(connector.declared);
    }
    flat_.sources.push_back(element.source);
  }

  /// What a component declares that is a system must be there.
  void check_connectors(const ElementNode& element, const std::string& path) const {
    const System& inside = systems_.at(element.system.get());
    for (const Connector& connector : element.connectors) {
      if (inside.ports.contains(connector.declared.name)) continue;
      fail_unknown(inside, path, connector.declared.name, connector.declared.where);
    }
  }

  [[noreturn]] static void fail_unknown(const System& system, const std::string& path,
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
  const SignalDictionary& find_dictionary(const SystemNode& system,
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
  std::pair<std::size_t, Role> find_port(const SystemNode& node, const ConnectionEnd& end,
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
    const auto element =
        std::find_if(node.elements.begin(), node.elements.end(),
                     [&](const ElementNode& other) { return other.name == end.element; });
    if (element == node.elements.end()) fail_no_element(node, end.element, where);
    const std::size_t port = find_port(*element, system, end.connector, where);
    const Flow flow = ports_[port].flow;
    return {port, flow == Flow::In ? Role::Sink : flow == Flow::Out ? Role::Source : Role::Either};
  }

  [[noreturn]] static void fail_no_element(const SystemNode& node, const std::string& name,
                                           const core::Location& where) {
    std::vector<std::string> names;
    for (const ElementNode& element : node.elements) names.push_back(element.name);
    core::fail_input({where, {}, {}, {}}, fmt::format("there is no component '{}'", name),
                     core::suggestion(name, names));
  }

  std::size_t find_port(const ElementNode& element, const System& system,
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
    Port port{joined(path, connector), Flow::Unsaid, components_.at(&element), connector, {}};
    for (const Connector& declared : element.connectors) {
      if (declared.declared.name == connector) port.flow = declared.flow;
    }
    ports_.push_back(std::move(port));
    return entry->second;
  }

  /// All references to a dictionary share its signals.
  std::size_t find_signal(const ElementNode& reference, const std::string& path,
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
    Port port{joined(path, name), Flow::Unsaid, kNone, name, {}};
    port.waypoint = {port.path, declared.type, declared.unit, declared.items, false};
    ports_.push_back(std::move(port));
    return shared->second;
  }

  // ---- Connections ----

  /// In SSP, start and end do not say which way a value goes: the kinds of the connectors do. Where
  /// they are left out, the start is the source.
  void add_wire(const SystemNode& node, const SystemConnection& connection) {
    auto [start, start_role] = find_port(node, connection.start, connection.where);
    auto [end, end_role] = find_port(node, connection.end, connection.where);
    const bool is_reversed = (start_role == Role::Sink && end_role != Role::Sink) ||
                             (start_role == Role::Either && end_role == Role::Source);
    if (start_role == end_role && start_role != Role::Either &&
        !(ports_[start].is_component() && ports_[end].is_component())) {
      core::fail_input(
          {connection.where, {}, {}, {}},
          fmt::format("cannot connect '{}' to '{}': a value {} both", ports_[start].path,
                      ports_[end].path, start_role == Role::Source ? "comes from" : "goes to"),
          "an input of a system leads to the inputs of its components, and their "
          "outputs to its outputs");
    }
    if (is_reversed) std::swap(start, end);
    ports_[start].outgoing.push_back(wires_.size());
    ports_[end].incoming.push_back(wires_.size());
    wires_.push_back({start, end, connection.passage, connection.where});
  }

  void check_wire(std::size_t wire) const {
    const Port& port = ports_[wires_[wire].to];
    if (port.is_component() || port.incoming.front() == wire) return;
    const Wire& first = wires_[port.incoming.front()];
    core::fail_input(
        {wires_[wire].where, {}, {}, {}},
        fmt::format("'{}' has two sources: '{}' here and '{}' in line {}", port.path,
                    ports_[wires_[wire].from].path, ports_[first.from].path, first.where.line),
        "remove one of the two connections");
  }

  /// Calls `found` with the wires to each component's connector behind the port.
  template <class Found>
  void follow(std::size_t port, std::vector<std::size_t>& way, Found&& found) const {
    for (const std::size_t next : ports_[port].outgoing) {
      const bool is_round = std::any_of(
          way.begin(), way.end(), [&](std::size_t w) { return wires_[w].from == wires_[next].to; });
      if (is_round) fail_round(wires_[next]);
      way.push_back(next);
      if (ports_[wires_[next].to].is_component()) {
        found(way);
      } else {
        follow(wires_[next].to, way, found);
      }
      way.pop_back();
    }
  }

  [[noreturn]] void fail_round(const Wire& wire) const {
    core::fail_input({wire.where, {}, {}, {}},
                     fmt::format("this connection leads from '{}' back to '{}' through connectors "
                                 "of systems alone, so no component says what the value is",
                                 ports_[wire.from].path, ports_[wire.to].path),
                     "remove one of the connections in the circle");
  }

  ViaDeclaration via(std::size_t wire) const {
    return {ports_[wires_[wire].to].waypoint, wires_[wire].passage};
  }

  void add_connection(const std::vector<std::size_t>& way) {
    const Wire& last = wires_[way.back()];
    const Port& from = ports_[wires_[way.front()].from];
    const Port& to = ports_[last.to];
    core::ConnectionDeclaration connection;
    connection.from_component = flat_.declaration.components[from.component].name;
    connection.from_connector = from.connector;
    connection.to_component = flat_.declaration.components[to.component].name;
    connection.to_connector = to.connector;
    connection.suppress_unit_conversion = last.passage.suppress_unit_conversion;
    connection.transformation = last.passage.transformation;
    connection.where = last.where;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) connection.via.push_back(via(way[i]));
    flat_.declaration.connections.push_back(std::move(connection));
  }

  /// What comes out of the root system.
  void add_outputs(const SystemNode& root) {
    for (const auto& connector : root.connectors) {
      if (connector.flow != Flow::Out) continue;
      core::OutputDeclaration output;
      output.where = connector.declared.where;
      std::size_t port = systems_.at(&root).ports.at(connector.declared.name);
      std::set<std::size_t> seen;
      while (!ports_[port].is_component() && !ports_[port].incoming.empty()) {
        const std::size_t wire = ports_[port].incoming.front();
        if (!seen.insert(wire).second) fail_round(wires_[wire]);
        output.via.insert(output.via.begin(), via(wire));
        port = wires_[wire].from;
      }
      if (!ports_[port].is_component()) continue;  // nothing is connected to it
      output.component = flat_.declaration.components[ports_[port].component].name;
      output.variable = ports_[port].connector;
      flat_.declaration.outputs.push_back(std::move(output));
    }
  }

  // ---- Parameters ----

  /// What is inside goes first, since what is bound to the outside replaces it.
  void add_parameters(const SystemNode& node) {
    for (const ElementNode& element : node.elements) {
      if (element.system) {
        add_parameters(*element.system);
        continue;
      }
      for (const ParameterValue& value : element.parameters) {
        add_start(value, components_.at(&element), value.name);
      }
    }
    for (const ParameterValue& value : node.parameters) {
      const std::size_t first = flat_.declaration.start_values.size();
      if (!apply(value, node, value.name)) tell_of_nobody(value, node);
      group(first);
    }
  }

  /// SSP 2.0, "ParameterBindings": the value is for all that has this name, and names may hold
  /// dots. Returns whether there is any.
  bool apply(const ParameterValue& value, const SystemNode& node, const std::string& name) {
    bool is_found = false;
    const auto& ports = systems_.at(&node).ports;
    if (const auto port = ports.find(name); port != ports.end()) {
      apply(value, port->second);
      is_found = true;
    }
    for (const ElementNode& element : node.elements) {
      if (!name.starts_with(element.name + ".")) continue;
      const std::string rest = name.substr(element.name.size() + 1);
      if (element.system) {
        is_found |= apply(value, *element.system, rest);
      } else if (element.dictionary.empty()) {
        add_start(value, components_.at(&element), rest);
        is_found = true;
      }
    }
    return is_found;
  }

  /// Values that one name is for.
  void group(std::size_t first) {
    auto& values = flat_.declaration.start_values;
    if (values.size() < first + 2) return;
    ++groups_;
    for (std::size_t i = first; i < values.size(); ++i) values[i].group = groups_;
  }

  core::StartDeclaration start(const ParameterValue& value, std::size_t component,
                               const std::string& variable) const {
    core::StartDeclaration start;
    start.component = flat_.declaration.components[component].name;
    start.variable = variable;
    start.value = value.value;
    start.unit = value.unit;
    start.where = value.where;
    start.suppress_unit_conversion = value.passage.suppress_unit_conversion;
    start.transformation = value.passage.transformation;
    start.is_optional = !value.is_required;
    return start;
  }

  void add_start(const ParameterValue& value, std::size_t component, const std::string& variable) {
    flat_.declaration.start_values.push_back(start(value, component, variable));
  }

  /// To whatever a connector of a system leads: an input to all that it feeds, an output to what
  /// feeds it.
  void apply(const ParameterValue& value, std::size_t port) {
    if (ports_[port].flow == Flow::Out) return apply_backward(value, port);
    const std::size_t before = flat_.declaration.start_values.size();
    std::vector<std::size_t> way;
    follow(port, way, [&](const std::vector<std::size_t>& found) {
      const Wire& last = wires_[found.back()];
      const Port& to = ports_[last.to];
      core::StartDeclaration start = this->start(value, to.component, to.connector);
      start.via.push_back({ports_[port].waypoint, value.passage});
      for (std::size_t i = 0; i + 1 < found.size(); ++i) start.via.push_back(via(found[i]));
      start.suppress_unit_conversion = last.passage.suppress_unit_conversion;
      start.transformation = last.passage.transformation;
      flat_.declaration.start_values.push_back(std::move(start));
    });
    if (flat_.declaration.start_values.size() == before) warn_of_open(value, port);
  }

  void apply_backward(const ParameterValue& value, std::size_t port) {
    std::vector<ViaDeclaration> via{{ports_[port].waypoint, value.passage}};
    std::set<std::size_t> seen;
    while (!ports_[port].is_component() && !ports_[port].incoming.empty()) {
      const Wire& wire = wires_[ports_[port].incoming.front()];
      if (wire.passage.transformation.kind != core::Transformation::Kind::None) {
        core::fail_input({value.where, {}, {}, {}},
                         fmt::format("'{}' is an output behind a transformation (line {}), so it "
                                     "cannot be given a start value",
                                     value.name, wire.passage.transformation.where.line),
                         "give the value to the component's variable");
      }
      if (!seen.insert(port).second) fail_round(wire);
      port = wire.from;
      via.push_back(
          {ports_[port].waypoint, core::Passage{wire.passage.suppress_unit_conversion, {}}});
    }
    if (!ports_[port].is_component()) return warn_of_open(value, port);
    core::StartDeclaration start =
        this->start(value, ports_[port].component, ports_[port].connector);
    start.suppress_unit_conversion = via.back().passage.suppress_unit_conversion;
    start.transformation = via.back().passage.transformation;
    via.pop_back();
    start.via = std::move(via);
    flat_.declaration.start_values.push_back(std::move(start));
  }

  void warn(const ParameterValue& value, const std::string& message) {
    warnings_.push_back(fmt::format("{}:{}: {}", value.where.file, value.where.line, message));
  }

  void warn_of_open(const ParameterValue& value, std::size_t port) {
    warn(value, fmt::format("the parameter '{}' is for the connector '{}', which leads to no "
                            "component",
                            value.name, ports_[port].path));
  }

  /// Where a name leads as long as it names systems, and what is left of it then.
  static std::pair<const SystemNode*, std::string> descend(const SystemNode& from,
                                                           std::string name) {
    const SystemNode* node = &from;
    const auto leads_on = [&](const ElementNode& element) {
      return element.system && name.starts_with(element.name + ".");
    };
    while (true) {
      const auto next = std::find_if(node->elements.begin(), node->elements.end(), leads_on);
      if (next == node->elements.end()) return {node, name};
      name.erase(0, next->name.size() + 1);
      node = next->system.get();
    }
  }

  void tell_of_nobody(const ParameterValue& value, const SystemNode& node) {
    const auto [at, rest] = descend(node, value.name);
    std::vector<std::string> names;
    for (const auto& [name, port] : systems_.at(at).ports) names.push_back(name);
    for (const ElementNode& element : at->elements) names.push_back(element.name);
    const std::string head = rest.substr(0, rest.find('.'));
    const std::string hint = core::suggestion(head, names);
    if (value.is_required) {
      const std::string before = value.name.substr(0, value.name.size() - rest.size());
      core::fail_input({value.where, {}, {}, {}},
                       fmt::format("there is no component '{}{}'", before, head), hint);
    }
    warn(value, fmt::format("the parameter '{}' belongs to no component and is passed over, as SSP "
                            "wants it; names read component.variable{}",
                            value.name, hint.empty() ? "" : "\n  hint: " + hint));
  }

  std::vector<std::string>& warnings_;
  FlatSystem flat_;
  std::map<std::string, core::Location> names_;  ///< of the components
  std::size_t groups_ = 0;
  std::vector<Port> ports_;
  std::vector<Wire> wires_;
  std::map<const SystemNode*, System> systems_;
  std::map<const ElementNode*, std::size_t> components_;
  std::map<const ElementNode*, const SignalDictionary*> dictionaries_;
  std::map<PortKey, std::size_t> shared_;  ///< of components and dictionaries
};

}  // namespace

FlatSystem flatten(const SystemNode& root, std::vector<std::string>& warnings) {
  return Flattener(warnings).run(root);
}

}  // namespace stride::io
