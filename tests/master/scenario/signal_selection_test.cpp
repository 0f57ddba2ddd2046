#include "master/scenario/signal_selection.h"

#include <catch2/catch.hpp>

#include "tests/master/ssp/support.h"

using namespace stride;
using namespace stride::io;
using Catch::Contains;

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

using Names = std::vector<std::string>;

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

TEST_CASE("A glob passes over messages; a message alone is refused") {
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
