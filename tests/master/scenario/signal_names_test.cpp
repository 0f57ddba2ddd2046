#include <catch2/catch.hpp>

#include "master/scenario/signal_selection.h"
#include "tests/master/ssp/support.h"

using namespace stride;
using namespace stride::io;

namespace {

NamedVariable named(const core::System& system, const std::string& name) {
  for (const NamedVariable& variable : named_variables(system)) {
    if (variable.name == name) return variable;
  }
  throw std::runtime_error("there is no " + name);
}

}  // namespace

TEST_CASE("all variables have names, but for the time; messages are told apart") {
  const core::System system = sample_system();
  CHECK(named_variables(system).size() == 24);
  CHECK_THROWS(named(system, "a.time"));
  for (const char* name : {"a.transmit.clock", "b, c.transmit.frame", "a.tick"}) {
    CHECK(named(system, name).is_message);
  }
  for (const char* name : {"a.distance", "b, c.gain", "a.label"}) {
    CHECK_FALSE(named(system, name).is_message);
  }
  CHECK_FALSE(named(sampled_system(), "s.u").is_message);
}

TEST_CASE("a variable is meant by its name, an alias, and globs of both") {
  const core::System system = sample_system();
  const NamedVariable distance = named(system, "a.distance");
  for (const char* pattern : {"a.distance", "a.range", "*.dist*", "a.ran?e", "*"}) {
    CHECK(is_meant(system, distance.id, pattern));
  }
  for (const char* pattern : {"distance", "b.range", "a.dist", ""}) {
    CHECK_FALSE(is_meant(system, distance.id, pattern));
  }
}
