#include "master/system/ssp/flatten.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/limited_warnings.h"
#include "master/base/text/suggest.h"
#include "master/engine/model/array_element.h"
#include "master/system/ssp/port_graph.h"

namespace stride::ssp {
namespace {

using core::ViaDeclaration;

class Flattener {
 public:
  Flattener(const SystemNode& root, std::vector<std::string>& warnings)
      : root_(root),
        graph_(root),
        ports_(graph_.ports()),
        connections_(graph_.connections()),
        warnings_(warnings),
        unmatched_(warnings, "parameters that belong to no component, and are ignored, too"),
        open_(warnings, "parameters for connectors that lead to no component"),
        unrecorded_(warnings, "outputs of the system that are not recorded") {
    warnings.insert(warnings.end(), graph_.warnings().begin(), graph_.warnings().end());
  }

  FlatSystem run() {
    flat_.declaration.name = root_.name;
    if (graph_.components().empty()) {
      core::fail_input({root_.where, {}, {}, {}},
                       "the system has no component, so there is nothing to simulate");
    }
    for (const PortGraph::Component& component : graph_.components()) add_component(component);
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (!ports_[i].is_component()) continue;
      graph_.follow(i, [&](const PortGraph::Way& found) { add_connection(found); });
    }
    add_parameters(root_);
    unmatched_.finish();
    open_.finish();
    add_start_values();
    add_outputs();
    unrecorded_.finish();
    add_inputs();
    return std::move(flat_);
  }

 private:
  /// A start value, and how many connections lead to its variable from what it is given to.
  struct Start {
    core::StartDeclaration declaration;
    std::size_t connections = 0;

    auto precedence() const { return std::pair(!declaration.is_optional, connections); }
  };

  void add_component(const PortGraph::Component& component) {
    core::ComponentDeclaration& declared = flat_.declaration.components.emplace_back();
    declared.name = component.path;
    declared.where = component.node->where;
    for (const Connector& connector : component.node->connectors) {
      declared.connectors.push_back(connector.declared);
    }
    declared.units_of_measure = component.node->units_of_measure;
    flat_.sources.push_back(component.node->source);
  }

  ViaDeclaration via(std::size_t connection) const {
    return via(ports_[connections_[connection].to], connections_[connection].segment);
  }
  static ViaDeclaration via(const Port& port, const core::PathSegment& segment) {
    return {port.path_connector, segment, port.dimensions, port.where};
  }
  /// Likewise, with a type where SSP 1.0 leaves the width open.
  static ViaDeclaration typed(ViaDeclaration via, const Port& port) {
    if (!via.connector.type) via.connector.type = port.kin;
    return via;
  }

  void add_connection(const PortGraph::Way& way) {
    const PortConnection& last = connections_[way.back()];
    const Port& from = ports_[connections_[way.front()].from];
    const Port& to = ports_[last.to];
    core::ConnectionDeclaration connection;
    connection.from_component = flat_.declaration.components[from.component].name;
    connection.from_connector = from.connector;
    connection.to_component = flat_.declaration.components[to.component].name;
    connection.to_connector = to.connector;
    connection.suppress_unit_conversion = last.segment.suppress_unit_conversion;
    connection.transformation = last.segment.transformation;
    connection.where = last.where;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) connection.via.push_back(via(way[i]));
    flat_.declaration.connections.push_back(std::move(connection));
  }

  /// What comes out of the root system, and the connectors of the systems in it.
  void add_outputs() {
    for (const Connector& connector : root_.connectors) {
      if (connector.flow == Flow::Out) add_output(root_, connector, false);
    }
    add_inner_outputs(root_);
  }

  void add_inner_outputs(const SystemNode& node) {
    for (const ElementNode& element : node.elements) {
      if (!element.system) continue;
      for (const Connector& connector : element.system->connectors) {
        add_output(*element.system, connector, true);
      }
      add_inner_outputs(*element.system);
    }
  }

  void add_output(const SystemNode& node, const Connector& connector, bool is_inner) {
    const std::size_t port = graph_.connectors(node).at(connector.declared.name);
    const std::optional<PortGraph::Way> found =
        is_inner ? graph_.find_way_to(port) : graph_.way_to(port);
    if (!found) return;  // an error where it is connected to something
    const PortGraph::Way& way = *found;
    const std::size_t origin = way.empty() ? port : connections_[way.front()].from;
    core::OutputDeclaration output;
    output.where = connector.declared.where;
    output.is_inner = is_inner;
    if (!ports_[origin].is_component()) return add_constant(origin, way, std::move(output));
    output.component = flat_.declaration.components[ports_[origin].component].name;
    output.variable = ports_[origin].connector;
    for (const std::size_t connection : way) output.via.push_back(via(connection));
    flat_.declaration.outputs.push_back(std::move(output));
  }

  /// Of a connector that no component feeds: the value that is given to it, or to one before it.
  void add_constant(std::size_t origin, const PortGraph::Way& way, core::OutputDeclaration output) {
    std::vector<std::size_t> ports{origin};
    for (const std::size_t connection : way) ports.push_back(connections_[connection].to);
    const auto first = deciding(ports);
    if (first == ports.end()) return note_unrecorded(origin, way, output);
    const ParameterValue& value = *given_.at(*first);
    output.value = value.value;
    output.unit = value.unit;
    output.is_integer = value.is_integer;
    output.via.push_back(typed(via(ports_[*first], value.segment), ports_[*first]));
    for (auto i = static_cast<std::size_t>(first - ports.begin()); i < way.size(); ++i) {
      output.via.push_back(typed(via(way[i]), ports_[ports[i + 1]]));
    }
    flat_.declaration.outputs.push_back(std::move(output));
  }

  /// Outputs of the root system are recorded unless something else is chosen; those inside are on
  /// demand.
  void note_unrecorded(std::size_t origin, const PortGraph::Way& way,
                       const core::OutputDeclaration& output) {
    if (output.is_inner || !unrecorded_.count()) return;
    const std::string& name = ports_[way.empty() ? origin : connections_[way.back()].to].path;
    unrecorded_.add(
        core::to_text({.where = output.where}) +
        (way.empty()
             ? fmt::format("nothing is connected to the output '{}', so it is not recorded", name)
             : fmt::format("the output '{}' is not recorded, since the input '{}' that it "
                           "is connected to has no value\n  hint: give it one, by --set "
                           "{}=VALUE or a parameter of the system",
                           name, ports_[origin].path, ports_[origin].path)));
  }

  /// The first of the ports, one behind the other, that has a value, by the command line or else by
  /// the file.
  std::vector<std::size_t>::const_iterator deciding(const std::vector<std::size_t>& ports) const {
    const auto is_given = [&](std::size_t port) { return given_.contains(port); };
    const auto is_required = [&](std::size_t port) {
      return is_given(port) && given_.at(port)->is_required;
    };
    const auto required = std::ranges::find_if(ports, is_required);
    return required != ports.end() ? required : std::ranges::find_if(ports, is_given);
  }

  /// What no component feeds, such as the inputs of the root system.
  void add_inputs() {
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (ports_[i].is_component() || !ports_[i].incoming.empty()) continue;
      graph_.follow(i, [&](const PortGraph::Way& way) {
        const PortConnection& last = connections_[way.back()];
        const Port& to = ports_[last.to];
        core::InputDeclaration& input = flat_.declaration.inputs.emplace_back();
        input.component = flat_.declaration.components[to.component].name;
        input.variable = to.connector;
        input.where = last.where;
        input.via.push_back(via(ports_[i], {}));
        for (std::size_t w = 0; w + 1 < way.size(); ++w) input.via.push_back(via(way[w]));
      });
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
        begin_value(&element, value);
        add_start(value, graph_.component(element), value.name);
      }
    }
    for (const ParameterValue& value : node.parameters) {
      begin_value(&node, value);
      const std::size_t first = starts_.size();
      if (!apply(value, node, value.name)) report_unmatched(value, node);
      group(first);
    }
  }

  /// Those of one binding of an element have one rank.
  void begin_value(const void* owner, const ParameterValue& value) {
    const auto binding = std::tuple(owner, value.binding, value.is_required);
    if (value.binding == 0 || binding != binding_) ++rank_;
    binding_ = binding;
  }

  /// SSP 2.0, "ParameterBindings": the value is for all that has this name, and names may hold
  /// dots. Returns whether there is any.
  bool apply(const ParameterValue& value, const SystemNode& node, const std::string& name) {
    bool is_found = false;
    const auto& ports = graph_.connectors(node);
    const auto indexed = core::indexed_name(name);
    if (const auto port = ports.find(name); port != ports.end()) {
      apply(value, port->second);
      is_found = true;
    } else if (const auto array = indexed ? ports.find(indexed->array) : port; array != port) {
      apply(value, array->second, indexed->brackets);
      is_found = true;
    }
    const auto& elements = graph_.elements(node);
    for (std::size_t dot = name.find('.'); dot != name.npos; dot = name.find('.', dot + 1)) {
      const auto element = elements.find(std::string_view(name).substr(0, dot));
      if (element == elements.end()) continue;
      is_found |= apply(value, *element->second, name.substr(dot + 1));
    }
    return is_found;
  }

  bool apply(const ParameterValue& value, const ElementNode& element, const std::string& name) {
    if (element.system) return apply(value, *element.system, name);
    if (!element.dictionary.empty()) return false;
    add_start(value, graph_.component(element), name);
    return true;
  }

  /// Values that one name is for.
  void group(std::size_t first) {
    if (starts_.size() < first + 2) return;
    ++groups_;
    for (std::size_t i = first; i < starts_.size(); ++i) starts_[i].declaration.group = groups_;
  }

  core::StartDeclaration start(const ParameterValue& value, std::size_t component,
                               const std::string& variable) const {
    core::StartDeclaration start;
    start.component = flat_.declaration.components[component].name;
    start.variable = variable;
    start.value = value.value;
    start.unit = value.unit;
    start.where = value.where;
    start.suppress_unit_conversion = value.segment.suppress_unit_conversion;
    start.transformation = value.segment.transformation;
    start.is_optional = !value.is_required;
    start.dimensions = value.dimensions;
    start.is_integer = value.is_integer;
    start.rank = rank_;
    return start;
  }

  void add_start(const ParameterValue& value, std::size_t component, const std::string& variable) {
    starts_.push_back({start(value, component, variable)});
  }

  /// To whatever a connector of a system leads: an input to all that it feeds, an output to what
  /// feeds it. `indices`: those behind its name.
  void apply(const ParameterValue& value, std::size_t port, const std::string& indices = "") {
    if (ports_[port].flow == Flow::Out) return apply_backward(value, port, indices);
    if (indices.empty()) given_[port] = &value;
    const std::size_t before = starts_.size();
    graph_.follow(port, [&](const PortGraph::Way& found) {
      const PortConnection& last = connections_[found.back()];
      const Port& to = ports_[last.to];
      core::StartDeclaration start = this->start(value, to.component, to.connector + indices);
      start.via.push_back({ports_[port].path_connector, value.segment});
      for (std::size_t i = 0; i + 1 < found.size(); ++i) start.via.push_back(via(found[i]));
      start.suppress_unit_conversion = last.segment.suppress_unit_conversion;
      start.transformation = last.segment.transformation;
      starts_.push_back({std::move(start), found.size()});
    });
    if (starts_.size() == before && !leads_out(port)) report_open(value, port);
  }

  /// Whether an output of the root system has the value of the port.
  bool leads_out(std::size_t port) const {
    const auto& connectors = graph_.connectors(root_);
    return std::ranges::any_of(root_.connectors, [&](const Connector& connector) {
      if (connector.flow != Flow::Out) return false;
      const PortGraph::Way way = graph_.way_to(connectors.at(connector.declared.name));
      return std::ranges::any_of(
          way, [&](std::size_t connection) { return connections_[connection].from == port; });
    });
  }

  void apply_backward(const ParameterValue& value, std::size_t port, const std::string& indices) {
    std::vector<ViaDeclaration> via{{ports_[port].path_connector, value.segment}};
    const PortGraph::Way way = graph_.way_to(port);
    for (auto connection = way.rbegin(); connection != way.rend(); ++connection) {
      const auto& [from, to, segment, where] = connections_[*connection];
      if (segment.transformation.kind != core::Transformation::Kind::None) {
        core::fail_input({value.where, {}, {}, {}},
                         fmt::format("'{}' is an output behind a transformation (line {}), so it "
                                     "cannot be given a start value",
                                     value.name, segment.transformation.where.line),
                         "give the value to the component's variable");
      }
      port = from;
      via.push_back(
          {ports_[port].path_connector, core::PathSegment{segment.suppress_unit_conversion, {}}});
    }
    if (!ports_[port].is_component()) return report_open(value, port);
    core::StartDeclaration start =
        this->start(value, ports_[port].component, ports_[port].connector + indices);
    start.suppress_unit_conversion = via.back().segment.suppress_unit_conversion;
    start.transformation = via.back().segment.transformation;
    via.pop_back();
    start.via = std::move(via);
    starts_.push_back({std::move(start)});
  }

  /// A later one replaces an earlier one. A connector decides the value of what it is connected to,
  /// so the connector comes after it, and the command line after the file.
  void add_start_values() {
    std::ranges::stable_sort(starts_, {}, &Start::precedence);
    note_overruled();
    number_ranks();
    for (Start& start : starts_) {
      flat_.declaration.start_values.push_back(std::move(start.declaration));
    }
  }

  /// Of values of one binding, those that come through more connections have precedence.
  void number_ranks() {
    std::size_t number = 0;
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      const std::size_t rank = starts_[i].declaration.rank;
      const bool is_next =
          i == 0 || rank != last_rank_ || starts_[i].precedence() != starts_[i - 1].precedence();
      last_rank_ = rank;
      if (is_next) ++number;
      starts_[i].declaration.rank = number;
    }
  }

  /// Values of the command line that another one replaces through a connection.
  void note_overruled() {
    std::map<std::pair<std::string, std::string>, const Start*> deciding;
    for (const Start& start : starts_) {
      const core::StartDeclaration& value = start.declaration;
      if (!value.is_optional) deciding[{value.component, value.variable}] = &start;
    }
    for (const Start& start : starts_) {
      const core::StartDeclaration& value = start.declaration;
      if (value.is_optional) continue;
      const Start& last = *deciding.at({value.component, value.variable});
      if (last.connections == start.connections) continue;
      warnings_.push_back(
          core::to_text({.where = value.where}) +
          fmt::format("the value is not used, since '{}.{}' is connected to '{}', which has one "
                      "by {}",
                      value.component, value.variable, last.declaration.via.front().connector.name,
                      last.declaration.where.file));
    }
  }

  static std::string warning(const ParameterValue& value, const std::string& message) {
    return core::to_text({.where = value.where}) + message;
  }

  void report_open(const ParameterValue& value, std::size_t port) {
    const auto mistake = [&] {
      return fmt::format(
          "the parameter '{}' is for the connector '{}', which leads to no component", value.name,
          ports_[port].path);
    };
    if (value.is_required) core::fail_input({value.where, {}, {}, {}}, mistake());
    if (open_.count()) open_.add(warning(value, mistake()));
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

  /// The parameter of an element is meant by a name with a dot, so no connectors are listed then.
  std::string name_hint(const SystemNode& node, const std::string& name) const {
    std::vector<std::string> connectors, elements;
    for (const auto& [connector, port] : graph_.connectors(node)) connectors.push_back(connector);
    for (const ElementNode& element : node.elements) elements.push_back(element.name);
    if (!core::nearest(name, connectors).empty()) return core::suggestion(name, connectors);
    const std::size_t dot = name.find('.');
    if (dot != name.npos) return core::suggestion(name.substr(0, dot), elements);
    elements.insert(elements.begin(), connectors.begin(), connectors.end());
    const std::string hint = core::suggestion(name, elements);
    return hint + (hint.ends_with('?') ? " Names" : "; names") +
           " of parameters read component.variable";
  }

  /// After some, others are only counted: each would be compared with the names of all elements.
  void report_unmatched(const ParameterValue& value, const SystemNode& node) {
    if (!value.is_required && !unmatched_.count()) return;
    const auto [at, rest] = descend(node, value.name);
    const std::string head = rest.substr(0, rest.find('.'));
    const std::string hint = name_hint(*at, rest);
    if (value.is_required) {
      const std::string before = value.name.substr(0, value.name.size() - rest.size());
      core::fail_input({value.where, {}, {}, {}},
                       fmt::format("there is no component '{}{}'", before, head), hint);
    }
    unmatched_.add(
        warning(value, fmt::format("the parameter '{}' belongs to no component and is ignored, as "
                                   "SSP requires; names read component.variable{}",
                                   value.name, hint.empty() ? "" : "\n  hint: " + hint)));
  }

  const SystemNode& root_;
  PortGraph graph_;
  const std::vector<Port>& ports_;
  const std::vector<PortConnection>& connections_;
  std::vector<std::string>& warnings_;
  core::LimitedWarnings unmatched_, open_, unrecorded_;
  FlatSystem flat_;
  std::vector<Start> starts_;
  std::map<std::size_t, const ParameterValue*> given_;  ///< by port, the last one
  std::size_t groups_ = 0;
  std::size_t rank_ = 0, last_rank_ = 0;
  std::tuple<const void*, std::size_t, bool> binding_{};  ///< of the last value
};

}  // namespace

FlatSystem flatten(const SystemNode& root, std::vector<std::string>& warnings) {
  return Flattener(root, warnings).run();
}

}  // namespace stride::ssp
