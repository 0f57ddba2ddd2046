#include "master/engine/model/system/known_names.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;
using Catch::Matchers::Contains;
using stride::tests::error_of;

namespace {

/// "name|value", or the name alone.
std::string split(const KnownNames& names, const std::string& text, bool may_lack_value = false) {
  const Assignment parts = names.split("--set", text, may_lack_value);
  return parts.value ? parts.name + "|" + *parts.value : parts.name;
}

}  // namespace

TEST_CASE("a text is split at the first '=' where no name is known") {
  CHECK(split({}, "a.x=1") == "a.x|1");
  CHECK(split({}, "a.x=b=c") == "a.x|b=c");
  CHECK(split({}, "a.x=") == "a.x|");
  CHECK(split({}, "a.x") == "a.x");
  CHECK(split({}, "=1") == "|1");
}

TEST_CASE("a text is split behind the longest name that is known") {
  KnownNames names;
  for (const char* name : {"a.x", "a.x=y", "a.v", "b=c.x", "a.s[1]=z"}) names.add(name, false);
  CHECK(split(names, "a.x=y=5") == "a.x=y|5");
  CHECK(split(names, "b=c.x=5") == "b=c.x|5");
  CHECK(split(names, "a.v=5") == "a.v|5");
  CHECK(split(names, "a.v[2]=5") == "a.v[2]|5");
  CHECK(split(names, "a.x=y[2]=5") == "a.x=y[2]|5");
  CHECK(split(names, "b=c.x", true) == "b=c.x");
  CHECK(split(names, "unknown=y=5") == "unknown|y=5");
}

TEST_CASE("a text that may be meant in two ways is an error") {
  KnownNames names;
  names.add("a.text", true);
  names.add("a.text=b", false);
  names.add("a.x", false);
  names.add("a.x=1", false);
  CHECK_THAT(error_of([&] { split(names, "a.text=b=5"); }),
             Contains("--set a.text=b=5: this may be for 'a.text' or for 'a.text=b'"));
  CHECK_THAT(error_of([&] { split(names, "a.x=1", true); }), Contains("for 'a.x' or for 'a.x=1'"));
  CHECK(split(names, "a.x=1=2") == "a.x=1|2");
}

TEST_CASE("the names of a system are those of its variables, and their aliases") {
  SystemDeclaration declaration;
  declaration.components = {
      {"a=b", Describe("m").add("k=1", ValueType::Float64, Causality::Parameter).done(), {}, {}}};
  const KnownNames names{System(declaration)};
  CHECK(split(names, "a=b.k=1=2") == "a=b.k=1|2");
}

TEST_CASE("a component that stands alone need not be named") {
  SystemDeclaration declaration;
  declaration.components = {
      {"m", Describe("m").add("k=1", ValueType::Float64, Causality::Parameter).done(), {}, {}}};
  const KnownNames names(System(declaration), "m");
  CHECK(split(names, "k=1=2") == "m.k=1|2");
  CHECK(split(names, "m.k=1=2") == "m.k=1|2");
  CHECK(split(names, "other=2") == "m.other|2");
  CHECK(stride::core::with_component("m", "m.x") == "m.x");
  CHECK(stride::core::with_component("m", "mx") == "m.mx");
  CHECK(stride::core::with_component("", "x") == "x");
}
