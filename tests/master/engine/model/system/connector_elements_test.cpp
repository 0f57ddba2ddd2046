#include "master/engine/model/system/connector_elements.h"

#include <memory>

#include <catch2/catch.hpp>

using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

class UnitNames {
 public:
  explicit UnitNames(std::vector<std::pair<std::string, std::vector<Dimension>>> variables) {
    auto description = std::make_shared<UnitDescription>();
    for (auto& [name, dimensions] : variables) {
      Variable& variable = description->variables.emplace_back();
      variable.name = name;
      variable.size = element_count(dimensions).value();
      variable.dimensions = std::move(dimensions);
    }
    description_ = description;
    names_.add("unit", description_);
  }

  std::optional<ConnectorElements> find(const std::string& name) const {
    return find_elements(names_, 0, *description_, {{"s.ssd", 7}, "unit", name, {}});
  }
  /// Of each part the variable and the first element.
  std::vector<std::pair<std::size_t, std::size_t>> parts(const std::string& name) const {
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    const ConnectorElements found = find(name).value();
    for (const ElementRange& part : found.parts) parts.emplace_back(part.id.variable, part.first);
    return parts;
  }
  std::string reason(const std::string& name) const {
    try {
      find(name);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }

 private:
  std::shared_ptr<const UnitDescription> description_;
  NameIndex names_;
};

using PartPlaces = std::vector<std::pair<std::size_t, std::size_t>>;

}  // namespace

TEST_CASE("a name is that of a variable, of an element, or of an array of scalars") {
  const UnitNames names({{"m", {2, 3}}, {"x[2]", {}}, {"x[1]", {}}, {"x[1].y", {}}, {"z", {}}});
  CHECK(names.find("m")->size() == 6);
  CHECK(names.find("m")->dimensions == std::vector<std::size_t>{2, 3});
  CHECK(names.parts("m[2,1]") == PartPlaces{{0, 3}});
  CHECK(names.find("m[2,1]")->dimensions.empty());
  CHECK(names.parts("x[2]") == PartPlaces{{1, 0}});
  CHECK(names.parts("x") == PartPlaces{{2, 0}, {1, 0}});
  CHECK(names.find("x")->dimensions == std::vector<std::size_t>{2});
  CHECK_FALSE(names.find("w"));
  CHECK_FALSE(names.find("w[1]"));
  CHECK_FALSE(names.find("x[3]"));
  CHECK_THAT(names.reason("z[1]"), Contains("'z' is a scalar"));
}

TEST_CASE("an element of an element is an error that says so") {
  const UnitNames names({{"y", {3}}, {"x[2]", {}}});
  CHECK_THAT(names.reason("y[1][1]"), Contains("'y[1]' is an element of the array 'y' already") &&
                                          Contains("give the indices once"));
  CHECK_THAT(names.reason("x[2][1]"), Contains("'x[2]' is a scalar, so it has no element [1]"));
  CHECK_FALSE(names.find("z[1][1]"));
}

TEST_CASE("a variable that is named like an element is preferred to the element") {
  const UnitNames names({{"x", {3}}, {"x[2]", {}}});
  CHECK(names.parts("x[2]") == PartPlaces{{1, 0}});
  CHECK(names.parts("x[3]") == PartPlaces{{0, 2}});
  CHECK(names.parts("x") == PartPlaces{{0, 0}});
}

TEST_CASE("scalars are in row-major order, whatever that of their names") {
  std::vector<std::pair<std::string, std::vector<Dimension>>> scalars;
  for (int column = 11; column >= 1; --column) {
    for (const int row : {2, 1}) {
      scalars.push_back({"m[" + std::to_string(row) + "," + std::to_string(column) + "]", {}});
    }
  }
  const UnitNames names(scalars);
  CHECK(names.find("m")->dimensions == std::vector<std::size_t>{2, 11});
  const PartPlaces parts = names.parts("m");
  REQUIRE(parts.size() == 22);
  for (std::size_t i = 0; i < 11; ++i) {
    CHECK(parts[i] == std::pair<std::size_t, std::size_t>{21 - 2 * i, 0});
    CHECK(parts[11 + i] == std::pair<std::size_t, std::size_t>{20 - 2 * i, 0});
  }
}

TEST_CASE("scalars that are no whole array are an error") {
  CHECK_THAT(UnitNames({{"x[1]", {}}, {"x[3]", {}}}).reason("x"),
             Contains("'x[2]' is not among them"));
  CHECK_THAT(UnitNames({{"x[2]", {}}, {"z", {}}}).reason("x"),
             Contains("'x[1]' is not among them"));
  CHECK_THAT(UnitNames({{"x[1,1]", {}}, {"x[1,2]", {}}, {"x[2,1]", {}}}).reason("x"),
             Contains("'x[2,2]' is not among them"));
  CHECK_THAT(UnitNames({{"x[4000000000,4000000000]", {}}, {"x[1,1]", {}}}).reason("x"),
             Contains("'x[1,2]' is not among them"));
  CHECK_THAT(UnitNames({{"x[0]", {}}, {"x[1]", {}}}).reason("x"),
             Contains("have the index 0") && Contains("start at 1"));
  CHECK_THAT(UnitNames({{"x[1]", {}}, {"x[1,1]", {}}}).reason("x"), Contains("number of indices"));
  CHECK_THAT(UnitNames({{"x[1]", {2}}, {"x[2]", {}}}).reason("x"), Contains("'x[1]' is an array"));
}
