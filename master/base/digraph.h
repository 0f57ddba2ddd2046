// Algorithms on directed graphs.
#ifndef STRIDE_MASTER_BASE_DIGRAPH_H
#define STRIDE_MASTER_BASE_DIGRAPH_H

#include <cstddef>
#include <span>
#include <vector>

namespace stride::core {

/// For each node the nodes that its edges lead to. An edge may lead back to its own node.
using Digraph = std::vector<std::vector<std::size_t>>;

/// The strongly connected components, each sorted, in topological order: an edge between two of
/// them leads from an earlier to a later one. Tarjan, "Depth-first search and linear graph
/// algorithms" (1972), without recursion. Linear in nodes and edges.
std::vector<std::vector<std::size_t>> strong_components(const Digraph& graph);

/// An order of all nodes in which few edges lead back. Eades, Lin, Smyth, "A fast and effective
/// heuristic for the feedback arc set problem" (1993). Where the heuristic has a choice, the lowest
/// node is taken.
std::vector<std::size_t> order_with_few_back_edges(const Digraph& graph);

/// Whether a strongly connected component holds a cycle: it has several nodes, or an edge from its
/// only node to itself.
bool is_cyclic(const Digraph& graph, const std::vector<std::size_t>& component);

/// The owner of a node that is not grouped with others.
inline constexpr std::size_t kOnItsOwn = static_cast<std::size_t>(-1);

/// The nodes of a graph without cycles, each behind its predecessors, in groups of nodes that have
/// the same owner. In few groups: an owner of which nothing is missing comes first, then what is
/// on its own, then another owner; the lowest of several.
std::vector<std::vector<std::size_t>> grouped_order(const Digraph& graph,
                                                    std::span<const std::size_t> owners);

}  // namespace stride::core

#endif
