#include "master/engine/run/loops/evaluation_order.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/digraph.h"

namespace stride::core {
namespace {

constexpr std::size_t kMostPaths = 8;

/// Outputs of one component that depend on the same inputs.
struct Node {
  std::size_t component = 0;
  bool declared = true;
  std::vector<std::size_t> inputs;
  std::vector<VariableId> outputs;
};

/// The dependencies of a system as a graph: an edge leads from the node of an output to each node
/// that depends on an input which the output is connected to.
class Network {
 public:
  Network(const System& system, Phase phase) : system_(system) {
    add_nodes(Dependencies(system, phase), phase);
    for (const Connection& connection : system.connections()) {
      if (!carries_value(system, connection, phase)) continue;
      sources_[connection.to].push_back(&connection);
      targets_[connection.from].push_back(&connection);
    }
    graph_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (const VariableId input : inputs_of(i)) {
        dependants_[input].push_back(i);
        for (const Connection* source : sources(input)) {
          graph_[node_of_.at(source->from)].push_back(i);
        }
      }
    }
  }

  const System& system() const { return system_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  const Digraph& graph() const { return graph_; }

  std::vector<VariableId> inputs_of(std::size_t node) const {
    std::vector<VariableId> ids;
    for (const std::size_t input : nodes_[node].inputs) {
      ids.push_back({nodes_[node].component, input});
    }
    return ids;
  }
  /// The connections that end at the inputs of a node, sorted by target.
  std::vector<const Connection*> sources_of(std::size_t node) const {
    std::vector<const Connection*> all;
    for (const VariableId input : inputs_of(node)) {
      all.insert(all.end(), sources(input).begin(), sources(input).end());
    }
    return all;
  }
  std::size_t node_of(VariableId output) const { return node_of_.at(output); }
  /// The connections that begin at the output.
  const std::vector<const Connection*>& targets(VariableId output) const {
    return targets_.at(output);
  }
  /// The nodes that depend on the input.
  const std::vector<std::size_t>& dependants(VariableId input) const {
    static const std::vector<std::size_t> none;
    const auto found = dependants_.find(input);
    return found == dependants_.end() ? none : found->second;
  }

 private:
  /// Several, where they end at different elements.
  const std::vector<const Connection*>& sources(VariableId input) const {
    return sources_.at(input);
  }

  void add_nodes(const Dependencies& dependencies, Phase phase) {
    std::set<VariableId> outputs;
    for (const Connection& connection : system_.connections()) {
      if (carries_value(system_, connection, phase)) outputs.insert(connection.from);
    }
    std::map<std::tuple<std::size_t, bool, std::vector<std::size_t>>, std::size_t> known;
    for (const VariableId output : outputs) {
      const Dependencies::Inputs inputs = dependencies.inputs_of(output);
      const auto [entry, is_new] =
          known.try_emplace({output.component, inputs.declared, inputs.variables}, nodes_.size());
      if (is_new) {
        nodes_.push_back(
            {output.component,
             inputs.declared,
             inputs.declared ? inputs.variables : dependencies.all_inputs(output.component),
             {}});
      }
      nodes_[entry->second].outputs.push_back(output);
      node_of_[output] = entry->second;
    }
  }

  const System& system_;
  std::vector<Node> nodes_;
  Digraph graph_;
  std::map<VariableId, std::size_t> node_of_;  // of an output
  std::map<VariableId, std::vector<const Connection*>> sources_;
  std::map<VariableId, std::vector<const Connection*>> targets_;
  std::map<VariableId, std::vector<std::size_t>> dependants_;
};

OutputGroup make_group(const Network& network, const std::vector<std::size_t>& nodes) {
  OutputGroup group{network.nodes()[nodes.front()].component, {}};
  for (const std::size_t node : nodes) {
    const auto& outputs = network.nodes()[node].outputs;
    group.outputs.insert(group.outputs.end(), outputs.begin(), outputs.end());
  }
  std::sort(group.outputs.begin(), group.outputs.end());
  return group;
}

/// One strongly connected part of the network.
class LoopPlanner {
 public:
  LoopPlanner(const Network& network, const std::vector<std::size_t>& nodes)
      : network_(network), nodes_(nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) local_[nodes[i]] = i;
  }

  EvaluationBlock run() {
    find_tears();
    find_groups();
    find_paths();
    find_undeclared();
    return std::move(block_);
  }

 private:
  /// The edges within the loop, through those connections for which `keeps` returns true.
  template <class Keeps>
  Digraph inner_edges(Keeps&& keeps) const {
    Digraph graph(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (const Connection* connection : network_.sources_of(nodes_[i])) {
        const auto from = local_.find(network_.node_of(connection->from));
        if (from != local_.end() && keeps(*connection)) graph[from->second].push_back(i);
      }
    }
    return graph;
  }

  /// Without them, no edge leads back in the order.
  void find_tears() {
    const auto order =
        order_with_few_back_edges(inner_edges([](const Connection&) { return true; }));
    std::vector<std::size_t> position(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = i;
    using Key = std::tuple<ElementRange, double, double, NumberMap, NumberMap, ValueType>;
    std::map<Key, TearingVariable> tearing_variables;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (const Connection* connection : network_.sources_of(nodes_[i])) {
        const auto from = local_.find(network_.node_of(connection->from));
        if (from == local_.end()) continue;
        inner_.insert(connection->to);
        if (position[from->second] < position[i] || !torn_.insert(connection).second) continue;
        const Conversion& conversion = connection->conversion;
        TearingVariable& variable = tearing_variables[{
            connection->source(), conversion.linear.factor, conversion.linear.offset,
            conversion.map, conversion.truth, network_.system().variable(connection->to).type}];
        variable.source = connection->source();
        variable.conversion = conversion;
        variable.inputs.push_back(connection->target());
      }
    }
    for (auto& [key, variable] : tearing_variables) {
      std::sort(variable.inputs.begin(), variable.inputs.end());
      block_.tearing_variables.push_back(std::move(variable));
    }
    block_.inputs.assign(inner_.begin(), inner_.end());
  }

  void find_groups() {
    const Digraph graph =
        inner_edges([&](const Connection& connection) { return !torn_.contains(&connection); });
    std::vector<std::size_t> components;
    for (const std::size_t node : nodes_) components.push_back(network_.nodes()[node].component);
    for (std::vector<std::size_t>& group : grouped_order(graph, components)) {
      for (std::size_t& item : group) item = nodes_[item];
      block_.groups.push_back(make_group(network_, group));
    }
  }

  void find_paths() {
    std::set<const Connection*> seen;
    for (const TearingVariable& variable : block_.tearing_variables) {
      const Connection* torn = &network_.system().connection_to(variable.inputs.front());
      if (seen.contains(torn)) continue;
      if (block_.paths.size() == kMostPaths) {
        ++block_.unnamed_paths;
        continue;
      }
      std::vector<std::string> names{network_.system().range_name(torn->target())};
      for (const Connection* connection : shortest_path(torn)) {
        names.push_back(network_.system().range_name(connection->source()));
        names.push_back(network_.system().range_name(connection->target()));
        seen.insert(connection);
      }
      block_.paths.push_back(fmt::format("{}", fmt::join(names, " -> ")));
    }
  }

  /// From the end of a torn connection through the loop, with that connection as the last one.
  std::vector<const Connection*> shortest_path(const Connection* torn) const {
    std::map<std::size_t, const Connection*> reached_by;  // of a node
    std::vector<std::size_t> queue;
    const auto reach = [&](const Connection* through) {
      for (const std::size_t node : network_.dependants(through->to)) {
        if (local_.count(node) == 0 || !reached_by.emplace(node, through).second) continue;
        queue.push_back(node);
      }
    };
    reach(torn);
    for (std::size_t at = 0; !reached_by.contains(network_.node_of(torn->from)); ++at) {
      for (const VariableId output : network_.nodes()[queue[at]].outputs) {
        for (const Connection* connection : network_.targets(output)) reach(connection);
      }
    }
    std::vector<const Connection*> path{torn};
    for (const Connection* at = reached_by.at(network_.node_of(torn->from)); at != torn;
         at = reached_by.at(network_.node_of(at->from))) {
      path.push_back(at);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  void find_undeclared() {
    std::set<std::size_t> undeclared;
    for (const std::size_t node : nodes_) {
      if (!network_.nodes()[node].declared) undeclared.insert(network_.nodes()[node].component);
    }
    Digraph graph = inner_edges([](const Connection&) { return true; });
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!network_.nodes()[nodes_[i]].declared) graph[i].clear();
    }
    for (const auto& part : strong_components(graph)) {
      if (is_cyclic(graph, part)) return;
    }
    block_.undeclared.assign(undeclared.begin(), undeclared.end());
  }

  const Network& network_;
  const std::vector<std::size_t>& nodes_;
  std::map<std::size_t, std::size_t> local_;  // node -> its place in nodes_
  std::set<VariableId> inner_;                // inputs
  std::set<const Connection*> torn_;          // those of the tearing_variables
  EvaluationBlock block_;
};

}  // namespace

std::vector<EvaluationBlock> evaluation_order(const System& system, Phase phase) {
  const Network network(system, phase);
  auto parts = strong_components(network.graph());
  std::sort(parts.begin(), parts.end());  // in the order of the file
  std::vector<std::size_t> part_of(network.nodes().size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const std::size_t node : parts[i]) part_of[node] = i;
  }
  Digraph condensed(parts.size());
  std::vector<std::size_t> components(parts.size(), kOnItsOwn);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!is_cyclic(network.graph(), parts[i])) {
      components[i] = network.nodes()[parts[i].front()].component;
    }
    for (const std::size_t node : parts[i]) {
      for (const std::size_t successor : network.graph()[node]) {
        if (part_of[successor] != i) condensed[i].push_back(part_of[successor]);
      }
    }
  }
  std::vector<EvaluationBlock> blocks;
  for (const std::vector<std::size_t>& group : grouped_order(condensed, components)) {
    if (components[group.front()] == kOnItsOwn) {
      blocks.push_back(LoopPlanner(network, parts[group.front()]).run());
      continue;
    }
    std::vector<std::size_t> nodes;
    for (const std::size_t part : group) nodes.push_back(parts[part].front());
    blocks.emplace_back().groups.push_back(make_group(network, nodes));
  }
  return blocks;
}

std::string path_text(const EvaluationBlock& loop) {
  std::string text = fmt::format("{}", fmt::join(loop.paths, ", and "));
  if (loop.unnamed_paths > 0) text += fmt::format(", and {} more paths", loop.unnamed_paths);
  return text;
}

std::string undeclared_text(const System& system, const EvaluationBlock& loop) {
  if (loop.undeclared.empty()) return "";
  std::vector<std::string> names;
  for (const std::size_t i : loop.undeclared) names.push_back(system.components()[i].name);
  return fmt::format("{} {} no dependencies",
                     names.size() == 1 ? "unit " + quoted(names) : "units " + quoted(names),
                     names.size() == 1 ? "declares" : "declare");
}

}  // namespace stride::core
