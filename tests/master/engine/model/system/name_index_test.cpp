#include "master/engine/model/system/name_index.h"

#include <catch2/catch.hpp>

using namespace stride::core;

namespace {

std::shared_ptr<const UnitDescription> described(std::initializer_list<Variable> variables) {
  UnitDescription description;
  description.variables = variables;
  return std::make_shared<const UnitDescription>(std::move(description));
}

Variable variable(const std::string& name, std::vector<std::string> aliases = {}) {
  Variable variable;
  variable.name = name;
  variable.aliases = std::move(aliases);
  return variable;
}

}  // namespace

TEST_CASE("components and their variables are found by name and alias") {
  NameIndex names;
  const auto shared = described({variable("u"), variable("y", {"out", "u"})});
  CHECK(names.add("a", shared));
  CHECK(names.add("b", described({variable("x")})));
  CHECK(names.add("c", shared));
  CHECK(names.component("a") == 0);
  CHECK(names.component("c") == 2);
  CHECK_FALSE(names.component("d"));
  CHECK(names.variable(2, "y") == 1);
  CHECK(names.variable(2, "out") == 1);
  CHECK(names.variable(1, "x") == 0);
  CHECK_FALSE(names.variable(1, "y"));
}

TEST_CASE("of several of one name the first is found") {
  NameIndex names;
  CHECK(names.add("a", described({variable("x", {"y"}), variable("y")})));
  CHECK(names.variable(0, "y") == 0);
  CHECK_FALSE(names.add("a", described({variable("z")})));
  CHECK(names.component("a") == 0);
}

TEST_CASE("a copy of the index is independent of it") {
  NameIndex copy;
  {
    NameIndex names;
    names.add("a", described({variable("x")}));
    copy = names;
  }
  CHECK(copy.variable(0, "x") == 0);
}

TEST_CASE("a name is found in another form of its letters, too") {
  NameIndex names;
  names.add("a", described({variable("Gr\u00F6\u00DFe")}));
  CHECK(names.variable(0, "Gro\u0308\u00DFe") == 0);
  CHECK_FALSE(names.variable(0, "Gra\u0308\u00DFe"));
  names.add("b", described({variable("x"), variable("su\u0308\u00DF")}));
  CHECK(names.variable(1, "s\u00FC\u00DF") == 1);
  CHECK(names.variable(1, "su\u0308\u00DF") == 1);
}
