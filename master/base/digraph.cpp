#include "master/base/digraph.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace stride::core {
namespace {

constexpr std::size_t kUnseen = static_cast<std::size_t>(-1);

class Tarjan {
 public:
  explicit Tarjan(const Digraph& graph)
      : graph_(graph), index_(graph.size(), kUnseen), low_(graph.size()), on_stack_(graph.size()) {}

  std::vector<std::vector<std::size_t>> run() {
    for (std::size_t node = 0; node < graph_.size(); ++node) {
      if (index_[node] == kUnseen) explore(node);
    }
    std::reverse(components_.begin(), components_.end());
    return std::move(components_);
  }

 private:
  struct Visit {
    std::size_t node;
    std::size_t next_edge;
  };

  void explore(std::size_t root) {
    enter(root);
    while (!visits_.empty()) {
      Visit& visit = visits_.back();
      const std::size_t node = visit.node;
      if (visit.next_edge < graph_[node].size()) {
        follow(node, graph_[node][visit.next_edge++]);
      } else {
        visits_.pop_back();
        if (low_[node] == index_[node]) pop_component(node);
        if (!visits_.empty()) lower(visits_.back().node, low_[node]);
      }
    }
  }

  void enter(std::size_t node) {
    index_[node] = low_[node] = next_index_++;
    stack_.push_back(node);
    on_stack_[node] = true;
    visits_.push_back({node, 0});
  }

  void follow(std::size_t node, std::size_t successor) {
    if (index_[successor] == kUnseen) {
      enter(successor);
    } else if (on_stack_[successor]) {
      lower(node, index_[successor]);
    }
  }

  void lower(std::size_t node, std::size_t bound) { low_[node] = std::min(low_[node], bound); }

  void pop_component(std::size_t root) {
    const auto begin = std::find(stack_.rbegin(), stack_.rend(), root).base() - 1;
    std::vector<std::size_t> component(begin, stack_.end());
    stack_.erase(begin, stack_.end());
    for (const std::size_t node : component) on_stack_[node] = false;
    std::sort(component.begin(), component.end());
    components_.push_back(std::move(component));
  }

  const Digraph& graph_;
  std::vector<std::size_t> index_;  ///< the order in which nodes are met
  std::vector<std::size_t> low_;    ///< the lowest index that is reached from there
  std::vector<char> on_stack_;
  std::vector<std::size_t> stack_;
  std::vector<Visit> visits_;
  std::vector<std::vector<std::size_t>> components_;
  std::size_t next_index_ = 0;
};

/// Takes nodes from a graph one by one: those without successors to the end of the order, those
/// without predecessors to its beginning, and otherwise the one with the greatest surplus of edges
/// that leave it.
class EadesLinSmyth {
 public:
  explicit EadesLinSmyth(const Digraph& graph)
      : graph_(graph), predecessors_(graph.size()), degrees_(graph.size()), taken_(graph.size()) {
    for (std::size_t node = 0; node < graph.size(); ++node) {
      for (const std::size_t successor : graph[node]) {
        if (successor == node) continue;
        predecessors_[successor].push_back(node);
        ++degrees_[node].out;
        ++degrees_[successor].in;
      }
    }
    for (std::size_t node = 0; node < graph.size(); ++node) queue_.insert(key(node));
  }

  std::vector<std::size_t> run() {
    std::vector<std::size_t> front;
    std::vector<std::size_t> back;
    while (!queue_.empty()) {
      const auto [rank, unused, node] = *queue_.begin();
      (rank == kSink ? back : front).push_back(node);
      take(node);
    }
    front.insert(front.end(), back.rbegin(), back.rend());
    return front;
  }

 private:
  enum Rank { kSink, kSource, kBetween };
  struct Degree {
    std::ptrdiff_t in = 0, out = 0;
  };
  using Key = std::tuple<Rank, std::ptrdiff_t, std::size_t>;  // first is what is taken first

  Key key(std::size_t node) const {
    const Degree& degree = degrees_[node];
    if (degree.out == 0) return {kSink, 0, node};
    if (degree.in == 0) return {kSource, 0, node};
    return {kBetween, degree.in - degree.out, node};
  }

  void take(std::size_t node) {
    queue_.erase(key(node));
    taken_[node] = true;
    for (const std::size_t other : graph_[node]) change(other, &Degree::in);
    for (const std::size_t other : predecessors_[node]) change(other, &Degree::out);
  }

  void change(std::size_t node, std::ptrdiff_t Degree::*side) {
    if (taken_[node]) return;
    queue_.erase(key(node));
    --(degrees_[node].*side);
    queue_.insert(key(node));
  }

  const Digraph& graph_;
  Digraph predecessors_;
  std::vector<Degree> degrees_;
  std::set<Key> queue_;
  std::vector<char> taken_;
};

class Grouping {
 public:
  Grouping(const Digraph& graph, std::span<const std::size_t> owners)
      : graph_(graph), owners_(owners), pending_(graph.size()) {
    for (std::size_t node = 0; node < graph.size(); ++node) {
      ++remaining_[owners[node]];
      for (const std::size_t successor : graph[node]) ++pending_[successor];
    }
    for (std::size_t node = 0; node < graph.size(); ++node) {
      if (pending_[node] == 0) make_ready(node);
    }
  }

  std::vector<std::vector<std::size_t>> run() {
    std::vector<std::vector<std::size_t>> groups;
    while (!ready_.empty()) {
      groups.push_back(take());
      for (const std::size_t node : groups.back()) {
        for (const std::size_t successor : graph_[node]) {
          if (--pending_[successor] == 0) make_ready(successor);
        }
      }
    }
    return groups;
  }

 private:
  void make_ready(std::size_t node) {
    const std::size_t owner = owners_[node];
    ready_[owner].insert(node);
    if (owner != kOnItsOwn && ready_[owner].size() == remaining_[owner]) complete_.insert(owner);
  }

  std::vector<std::size_t> take() {
    const bool alone = complete_.empty() && ready_.count(kOnItsOwn) != 0;
    const std::size_t owner = alone               ? kOnItsOwn
                              : complete_.empty() ? ready_.begin()->first
                                                  : *complete_.begin();
    std::set<std::size_t>& nodes = ready_[owner];
    const auto end = alone ? std::next(nodes.begin()) : nodes.end();
    std::vector<std::size_t> taken(nodes.begin(), end);
    nodes.erase(nodes.begin(), end);
    remaining_[owner] -= taken.size();
    complete_.erase(owner);
    if (nodes.empty()) ready_.erase(owner);
    return taken;
  }

  const Digraph& graph_;
  std::span<const std::size_t> owners_;
  std::vector<std::size_t> pending_;                    // predecessors of a node
  std::map<std::size_t, std::size_t> remaining_;        // nodes of an owner
  std::map<std::size_t, std::set<std::size_t>> ready_;  // likewise, those without predecessors
  std::set<std::size_t> complete_;                      // owners all of whose nodes are ready
};

}  // namespace

std::vector<std::vector<std::size_t>> strong_components(const Digraph& graph) {
  return Tarjan(graph).run();
}

std::vector<std::size_t> order_with_few_back_edges(const Digraph& graph) {
  return EadesLinSmyth(graph).run();
}

bool is_cyclic(const Digraph& graph, const std::vector<std::size_t>& component) {
  const auto& edges = graph[component.front()];
  return component.size() > 1 ||
         std::find(edges.begin(), edges.end(), component.front()) != edges.end();
}

std::vector<std::vector<std::size_t>> grouped_order(const Digraph& graph,
                                                    std::span<const std::size_t> owners) {
  return Grouping(graph, owners).run();
}

}  // namespace stride::core
