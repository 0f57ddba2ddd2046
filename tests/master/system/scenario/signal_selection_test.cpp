#include "master/system/scenario/signal_selection.h"

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;
using Names = std::vector<std::string>;

namespace {

NamedVariable named(const core::System& system, const std::string& name) {
  for (const NamedVariable& variable : named_variables(system)) {
    if (variable.name == name) return variable;
  }
  throw std::runtime_error("there is no " + name);
}

}  // namespace

TEST_CASE("all variables but the time have names; messages are distinguished") {
  const core::System system = sample_system();
  CHECK(named_variables(system).size() == 24);
  CHECK_THROWS(named(system, "a.time"));
  for (const char* name : {"a.transmit.clock", "b, c.transmit.frame", "a.tick"}) {
    CHECK_FALSE(named(system, name).is_signal);
  }
  for (const char* name : {"a.distance", "b, c.gain", "a.label"}) {
    CHECK(named(system, name).is_signal);
  }
  CHECK(named(sampled_system(), "s.u").is_signal);
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

TEST_CASE("a finder finds what is meant, by plain names and by globs") {
  const core::System system = sample_system();
  const VariableFinder finder(system);
  for (const std::string pattern : {"a.distance", "a.range", "b, c.range", "a.transmit.clock",
                                    "a.time", "none", "", "*.dist*", "a.ran?e", "*", "a.dist"}) {
    CAPTURE(pattern);
    std::vector<std::string> expected, found;
    for (const NamedVariable& variable : finder.all()) {
      if (is_meant(system, variable.id, pattern)) expected.push_back(variable.name);
    }
    for (const NamedVariable* variable : finder.meant(pattern, {})) found.push_back(variable->name);
    CHECK(found == expected);
  }
}

namespace {

std::vector<std::string> selected(const std::vector<std::string>& patterns) {
  const core::System system = sample_system();
  std::vector<SignalPattern> wanted;
  for (const std::string& pattern : patterns) wanted.push_back({pattern, {"x.ssd", 12}});
  std::vector<std::string> names;
  for (const core::VariableId id : select_signals(system, wanted)) {
    names.push_back(system.full_name(id));
  }
  return names;
}

}  // namespace

TEST_CASE("Without a pattern all outputs are recorded, but no messages") {
  CHECK(selected({}) == Names{"a.distance", "a.led", "a.frames.count", "a.position", "a.label",
                              "a.digest", "a.mode", "b, c.distance", "b, c.led",
                              "b, c.frames.count", "b, c.position", "b, c.label", "b, c.digest",
                              "b, c.mode"});
}

TEST_CASE("The order is that of the patterns, and nothing comes twice") {
  CHECK(selected({"*.led", "a.d*", "*.d*"}) ==
        Names{"a.led", "b, c.led", "a.distance", "a.digest", "b, c.distance", "b, c.digest"});
}

TEST_CASE("Inputs and parameters can be recorded, too") {
  CHECK(selected({"a.gain", "a.temperature"}) == Names{"a.gain", "a.temperature"});
}

TEST_CASE("A glob skips messages; a message by name is refused") {
  CHECK(selected({"a.t*"}) == Names{"a.temperature"});
  CHECK_THROWS_WITH(selected({"a.transmit.frame"}),
                    Contains("x.ssd:12: 'a.transmit.frame' cannot be recorded as a signal") &&
                        Contains("each of its messages is in events.csv"));
  CHECK_THROWS_WITH(selected({"a.tick"}), Contains("'a.tick' cannot be recorded as a signal"));
}

TEST_CASE("An alias is another name of its variable") {
  CHECK(selected({"a.range"}) == Names{"a.distance"});
  CHECK(selected({"*.ran?e"}) == Names{"a.distance", "b, c.distance"});
}

TEST_CASE("A pattern that matches nothing is refused, and the nearest name suggested") {
  CHECK_THROWS_WITH(selected({"a.distnace"}),
                    Contains("x.ssd:12: 'a.distnace' matches no variable to record") &&
                        Contains("did you mean 'a.distance'?"));
  CHECK_THROWS_WITH(selected({"a.led", "nothing.*"}), Contains("'nothing.*' matches no variable"));
  CHECK_THROWS_WITH(selected({"a.time"}), Contains("'a.time' matches no variable"));
}

TEST_CASE("What is sampled at the ticks of a time-based clock is a signal, the clock is not") {
  const core::System system = sampled_system();
  const auto outputs = select_signals(system, {});
  REQUIRE(outputs.size() == 1);
  CHECK(system.full_name(outputs[0]) == "s.y");
  const std::vector<SignalPattern> all = {{"s.*", {"x.ssd", 12}}};
  CHECK(select_signals(system, all).size() == 2);
  const std::vector<SignalPattern> clock = {{"s.tick", {"x.ssd", 12}}};
  CHECK_THROWS_WITH(select_signals(system, clock), Contains("cannot be recorded as a signal"));
}

namespace {

PlotPattern plot(const std::string& title, const Names& signals) {
  PlotPattern made{title, {}};
  for (const std::string& text : signals) made.signals.push_back({text, {"x.ssd", 9}});
  return made;
}

std::vector<Plot> selected(const std::vector<PlotPattern>& patterns) {
  const core::System system = sample_system();
  return select_plots(system, select_signals(system, {}), patterns);
}

}  // namespace

TEST_CASE("A plot has what its patterns match, in their order and once") {
  CHECK(selected({plot("Heights", {"b, c.d*", "*.distance"}), plot("Light", {"a.led"})}) ==
        std::vector<Plot>{{"Heights", {"b, c.distance", "b, c.digest", "a.distance"}},
                          {"Light", {"a.led"}}});
}

TEST_CASE("A signal may be in several plots, and be named by an alias") {
  CHECK(selected({plot("One", {"a.range"}), plot("Two", {"a.distance"})}) ==
        std::vector<Plot>{{"One", {"a.distance"}}, {"Two", {"a.distance"}}});
}

TEST_CASE("Of an array each element is drawn") {
  CHECK(selected({plot("Place", {"a.position"})}) ==
        std::vector<Plot>{{"Place", {"a.position[1]", "a.position[2]", "a.position[3]"}}});
}

TEST_CASE("A pattern that matches no recorded signal is refused at its line") {
  CHECK_THROWS_WITH(
      selected({plot("Height", {"a.distance", "a.distnace"})}),
      Contains("x.ssd:9: the plot 'Height' names 'a.distnace', which matches no signal that is "
               "recorded") &&
          Contains("did you mean 'a.distance'?"));
  CHECK_THROWS_WITH(selected({plot("Gain", {"a.gain"})}), Contains("matches no signal"));
}

TEST_CASE("Where other signals are recorded, what is left of the plots is drawn") {
  const core::System system = sample_system();
  const std::vector<core::VariableId> recorded = {{0, 1}};
  const std::vector<PlotPattern> patterns = {plot("Height", {"a.distance", "a.led"}),
                                             plot("Light", {"a.led"})};
  CHECK(remaining_plots(system, recorded, patterns) ==
        std::vector<Plot>{{"Height", {"a.distance"}}});
}
