#include "master/base/digraph.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace stride::core;

namespace {

using Groups = std::vector<std::vector<std::size_t>>;

Digraph random_graph(std::mt19937& generator, std::size_t nodes, std::size_t edges) {
  Digraph graph(nodes);
  for (std::size_t i = 0; i < edges; ++i) {
    graph[generator() % nodes].push_back(generator() % nodes);
  }
  return graph;
}

/// Whether a path of one edge at least leads from each node to each.
std::vector<std::vector<char>> reachability(const Digraph& graph) {
  std::vector<std::vector<char>> reaches(graph.size(), std::vector<char>(graph.size()));
  for (std::size_t i = 0; i < graph.size(); ++i) {
    for (const std::size_t k : graph[i]) reaches[i][k] = true;
  }
  for (std::size_t via = 0; via < graph.size(); ++via) {
    for (std::size_t i = 0; i < graph.size(); ++i) {
      for (std::size_t k = 0; k < graph.size(); ++k) {
        reaches[i][k] = reaches[i][k] || (reaches[i][via] && reaches[via][k]);
      }
    }
  }
  return reaches;
}

std::size_t back_edges(const Digraph& graph, const std::vector<std::size_t>& order) {
  std::vector<std::size_t> position(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) position[order[i]] = i;
  std::size_t count = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    for (const std::size_t k : graph[i]) count += position[k] <= position[i];
  }
  return count;
}

}  // namespace

TEST_CASE("strongly connected components are those that reachability gives, in order") {
  std::mt19937 generator(1);
  for (int round = 0; round < 200; ++round) {
    const std::size_t nodes = 1 + generator() % 12;
    const Digraph graph = random_graph(generator, nodes, generator() % 25);
    const auto reaches = reachability(graph);
    const auto components = strong_components(graph);
    std::vector<std::size_t> component_of(nodes, nodes);
    for (std::size_t c = 0; c < components.size(); ++c) {
      CHECK(std::is_sorted(components[c].begin(), components[c].end()));
      CHECK(is_cyclic(graph, components[c]) ==
            static_cast<bool>(reaches[components[c][0]][components[c][0]]));
      for (const std::size_t node : components[c]) component_of[node] = c;
    }
    for (std::size_t i = 0; i < nodes; ++i) {
      REQUIRE(component_of[i] < nodes);
      for (std::size_t k = 0; k < nodes; ++k) {
        const bool together = i == k || (reaches[i][k] && reaches[k][i]);
        CHECK(together == (component_of[i] == component_of[k]));
        if (reaches[i][k]) CHECK(component_of[i] <= component_of[k]);
      }
    }
  }
}

TEST_CASE("a chain of a hundred thousand nodes does not exhaust the stack") {
  Digraph graph(100'000);
  for (std::size_t i = 0; i + 1 < graph.size(); ++i) graph[i].push_back(i + 1);
  CHECK(strong_components(graph).size() == graph.size());
  graph.back().push_back(0);
  CHECK(strong_components(graph).size() == 1);
}

TEST_CASE("without cycles no edge leads back, and one cut opens a ring") {
  std::mt19937 generator(2);
  for (int round = 0; round < 100; ++round) {
    Digraph graph = random_graph(generator, 10, 30);
    for (std::size_t i = 0; i < graph.size(); ++i) {
      for (std::size_t& k : graph[i]) k = std::max(i, k);
      graph[i].erase(std::remove(graph[i].begin(), graph[i].end(), i), graph[i].end());
    }
    CHECK(back_edges(graph, order_with_few_back_edges(graph)) == 0);
  }
  CHECK(back_edges({{1}, {2}, {3}, {0}}, order_with_few_back_edges({{1}, {2}, {3}, {0}})) == 1);
  const Digraph star{{1, 2, 3}, {0}, {0}, {0}};
  CHECK(back_edges(star, order_with_few_back_edges(star)) == 3);
}

TEST_CASE("of any graph at most half of the edges lead back") {
  std::mt19937 generator(3);
  for (int round = 0; round < 100; ++round) {
    Digraph graph = random_graph(generator, 12, 60);
    std::size_t edges = 0;
    for (std::size_t i = 0; i < graph.size(); ++i) {
      graph[i].erase(std::remove(graph[i].begin(), graph[i].end(), i), graph[i].end());
      edges += graph[i].size();
    }
    const auto order = order_with_few_back_edges(graph);
    REQUIRE(order.size() == graph.size());
    CHECK(back_edges(graph, order) <= edges / 2);
  }
}

TEST_CASE("nodes of one owner are put together") {
  // 0 -> 1 -> 2, 0 -> 3; owner 0 has 0 and 2, owner 1 has 1 and 3
  const std::vector<std::size_t> owners{0, 1, 0, 1};
  CHECK(grouped_order({{1, 3}, {2}, {}, {}}, owners) == Groups{{0}, {1, 3}, {2}});
}

TEST_CASE("an owner of which something is missing waits for those of whom nothing is") {
  const std::vector<std::size_t> owners{0, 0, 1};
  CHECK(grouped_order({{}, {}, {1}}, owners) == Groups{{2}, {0, 1}});
}

TEST_CASE("what is on its own is in no group") {
  const std::vector<std::size_t> owners{kOnItsOwn, kOnItsOwn, 0, 0};
  CHECK(grouped_order({{2}, {3}, {}, {}}, owners) == Groups{{0}, {1}, {2, 3}});
}
