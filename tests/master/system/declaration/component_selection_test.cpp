#include "master/system/declaration/component_selection.h"

#include <catch2/catch.hpp>

using namespace stride::core;
using namespace stride::scenario;
using Catch::Contains;

namespace {

std::vector<std::size_t> selected_components(const std::vector<std::string>& patterns) {
  std::vector<ComponentPattern> wanted;
  for (const std::string& pattern : patterns) wanted.push_back({pattern, {"x.ssd", 7}});
  const std::vector<std::string> names = {"a", "b, c"};
  return select_components(names, wanted);
}

using Places = std::vector<std::size_t>;

}  // namespace

TEST_CASE("Components are selected by name or glob, each once and in their order") {
  CHECK(selected_components({}) == Places{});
  CHECK(selected_components({"a"}) == Places{0});
  CHECK(selected_components({"*c", "?", "a"}) == Places{0, 1});
}

TEST_CASE("A selector finds names, several of one name, and names by a glob") {
  const std::vector<std::string> names = {"a", "b", "a", "c*"};
  const ComponentSelector selector(names);
  CHECK(selector.select({"a"}) == Places{0, 2});
  CHECK(selector.select({"[!a]"}) == Places{1});
  CHECK(selector.select({"c*"}) == Places{3});
  CHECK_THROWS_WITH(selector.select({"d"}), Contains("'d' matches no component"));
}

TEST_CASE("A pattern that matches no component is refused with its place") {
  CHECK_THROWS_WITH(selected_components({"a", "x*"}),
                    Contains("x.ssd:7: 'x*' matches no component"));
}
