#include <catch2/catch.hpp>

#include "master/scenario/signal_selection.h"
#include "tests/master/ssp/support.h"

using namespace stride;
using namespace stride::io;
using Catch::Contains;

namespace {

using Names = std::vector<std::string>;

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

TEST_CASE("A signal may stand in several plots, and be named by an alias") {
  CHECK(selected({plot("One", {"a.range"}), plot("Two", {"a.distance"})}) ==
        std::vector<Plot>{{"One", {"a.distance"}}, {"Two", {"a.distance"}}});
}

TEST_CASE("Of an array each element is drawn") {
  CHECK(selected({plot("Place", {"a.position"})}) ==
        std::vector<Plot>{{"Place", {"a.position[1]", "a.position[2]", "a.position[3]"}}});
}

TEST_CASE("A pattern that matches nothing recorded is refused where it stands") {
  CHECK_THROWS_WITH(
      selected({plot("Height", {"a.distance", "a.distnace"})}),
      Contains("x.ssd:9: the plot 'Height' wants 'a.distnace', which matches no signal that is "
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
