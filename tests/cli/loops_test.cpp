// Algebraic loops and direct feed-through, with units of the kit behind the whole of FMI.
#include <cmath>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Units a and b that feed each other.
Workspace ring(const std::string& a, const std::string& b, const std::string& y = "y") {
  return Workspace(Parts{component("a", a) + component("b", b),
                         connection("a." + y, "b.u") + connection("b.y", "a.u")});
}

Workspace feedthrough_ring() { return ring("feedthrough.fmu", "feedthrough.fmu"); }

Arguments settings(std::initializer_list<std::string> settings, Arguments arguments = {}) {
  arguments.push_back("--quiet");
  for (const std::string& setting : settings) {
    arguments.push_back("--set");
    arguments.push_back(setting);
  }
  return arguments;
}

double value(const Workspace& workspace, const std::string& time, const std::string& signal) {
  const Csv signals = workspace.signals();
  return signals.number(signals.row_at(time), signals.column(signal));
}

void run_well(const Workspace& workspace, const Arguments& arguments) {
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
}

std::string failure(const Workspace& workspace, const Arguments& arguments) {
  const Outcome outcome = workspace.run(arguments);
  CHECK(outcome.exit_code == 1);
  return outcome.err;
}

constexpr double kCosine = 0.73908513321516064;  // x = cos x

}  // namespace

TEST_CASE("a linear loop begins at its fixed point, also where plain iteration diverges") {
  const std::string slope = GENERATE("0.4", "-0.75", "-3", "100");
  const Workspace workspace = feedthrough_ring();
  run_well(workspace, settings({"a.slope=" + slope, "a.offset=4", "b.slope=2", "b.offset=-1"},
                               {"--stop", "0.000001"}));
  const double a = std::stod(slope);
  const double expected = (4 - a) / (1 - 2 * a);  // y = a (2 y - 1) + 4
  CHECK(value(workspace, "0", "a.y") == Approx(expected).epsilon(1e-12));
  CHECK(value(workspace, "0", "b.y") == Approx(2 * expected - 1).epsilon(1e-12));
}

TEST_CASE("a loop that is not linear") {
  const Workspace workspace = feedthrough_ring();
  run_well(workspace, settings({"a.cosine=true", "b.slope=1"}, {"--stop", "0"}));
  CHECK(std::abs(value(workspace, "0", "a.y") - kCosine) < 1e-12);
}

TEST_CASE("a loop without a fixed point is an error that says how to break it") {
  CHECK_THAT(
      failure(feedthrough_ring(), settings({"a.offset=1"})),
      Contains("at 0 s: no solution of the algebraic loop a.u -> a.y -> b.u -> b.y -> a.u") &&
          Contains("a residual of 1") && Contains("breaks the loop"));
}

TEST_CASE("a Boolean loop that flips for ever is an error, one that does not is none") {
  const Workspace workspace = ring("inverter.fmu", "inverter.fmu");
  CHECK_THAT(failure(workspace, settings({"b.inverts=false"})),
             Contains("no solution of the algebraic loop a.u -> a.y -> b.u -> b.y -> a.u") &&
                 Contains("the loop returns "));
  run_well(workspace, settings({}));
  CHECK(value(workspace, "1", "a.y") != value(workspace, "1", "b.y"));
}

TEST_CASE("a loop follows a jump at the jump's own instant") {
  const Workspace workspace = feedthrough_ring();
  run_well(workspace, settings({"a.slope=0.5", "a.offset=1", "b.slope=-0.9", "a.jump_at=0.12345",
                                "a.jump_to=7"},
                               {"--stop", "0.2"}));
  const double before = 1 / 1.45;
  const double after = 7 / 1.45;
  CHECK(value(workspace, "0", "a.y") == Approx(before).epsilon(1e-12));
  CHECK(value(workspace, "0.123", "a.y") == Approx(before).epsilon(1e-12));
  CHECK(value(workspace, "0.12345", "a.y") == Approx(after).epsilon(1e-12));
  CHECK(value(workspace, "0.12345", "b.y") == Approx(-0.9 * after).epsilon(1e-12));
  CHECK(value(workspace, "0.2", "a.y") == Approx(after).epsilon(1e-12));
}

TEST_CASE("at a jump, too, plain iteration need not converge") {
  const Workspace workspace = feedthrough_ring();
  run_well(workspace,
           settings({"a.slope=-3", "a.offset=1", "b.slope=2", "a.jump_at=0.0005", "a.jump_to=7"},
                    {"--stop", "0.0005"}));
  CHECK(value(workspace, "0", "a.y") == Approx(1.0 / 7).epsilon(1e-12));
  CHECK(value(workspace, "0.0005", "a.y") == Approx(1).epsilon(1e-12));
}

TEST_CASE("a jump goes through a chain at once, and each unit of it has an event") {
  const Workspace workspace(Parts{component("c", "feedthrough.fmu") +
                                      component("b", "feedthrough.fmu") +
                                      component("a", "feedthrough.fmu"),
                                  connection("a.y", "b.u") + connection("b.y", "c.u")});
  run_well(workspace, settings({"a.jump_at=0.12345", "a.jump_to=7"}, {"--stop", "0.2"}));
  CHECK(value(workspace, "0.123", "c.y") == 0);
  CHECK(value(workspace, "0.12345", "c.y") == 7);
  CHECK(value(workspace, "0.123", "c.events") == 1);
  CHECK(value(workspace, "0.12345", "c.events") == 2);
  CHECK(value(workspace, "0.2", "c.events") == 2);
}

TEST_CASE("an undeclared dependency that does not exist needs no search") {
  const Workspace workspace = ring("undeclared.fmu", "feedthrough.fmu", "constant");
  run_well(workspace, settings({"b.slope=3"}, {"--stop", "0"}));
  CHECK(value(workspace, "0", "b.y") == 15);
  CHECK(value(workspace, "0", "a.doubled") == 30);
  // to read the guess, to try it, to use what came of that, and at the end
  CHECK(value(workspace, "0", "a.initializations") <= 4);
}

TEST_CASE("a chain of any length has its values at the start, in the order of the dependencies") {
  const Workspace workspace(
      Parts{component("c", "undeclared.fmu") + component("b", "undeclared.fmu") +
                component("a", "undeclared.fmu"),
            connection("a.constant", "b.u") + connection("b.doubled", "c.u")});
  run_well(workspace, settings({}, {"--stop", "0"}));
  CHECK(value(workspace, "0", "c.doubled") == 20);
  CHECK(value(workspace, "0", "a.initializations") == 1);
  CHECK(value(workspace, "0", "b.initializations") == 1);
  CHECK(value(workspace, "0", "c.initializations") == 1);
}

TEST_CASE("check prints loops and the order of the initial values") {
  const Workspace workspace = ring("undeclared.fmu", "feedthrough.fmu", "constant");
  const Outcome outcome = workspace.stride({"check", "test.ssd"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("Order of the initial values") &&
                              Contains("loop, solved for a.u") &&
                              Contains("Algebraic loops\n  a.u -> a.constant -> b.u -> b.y -> a.u\n"
                                       "    at the start and at events, solved for a.u\n"
                                       "    unit 'a' declares no dependencies"));
  const Workspace filters(two_filters());
  CHECK_THAT(filters.stride({"check", "test.ssd"}).out, Contains("Algebraic loops\n  none\n"));
}
