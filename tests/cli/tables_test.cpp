// Tables of values over time as components.
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kCycle =
    "time,wanted,gear: Int32,door: Boolean\n"
    "0,0,1,true\n"
    "2,0,1,false\n"
    "4,3,,\n"
    "4,5,2,\n"
    "10,5,,\n";

/// A filter that follows a table for 6 s.
struct Driven : Workspace {
  explicit Driven(const std::string& table)
      : Workspace(Parts{component("cycle", "cycle.csv") + component("filter", "minimal.fmu"),
                        connection("cycle.wanted", "filter.u"), "",
                        "<ssd:DefaultExperiment stopTime=\"6\"/>\n"}) {
    scratch().write("cycle.csv", table);
  }
};

std::vector<std::string> column(const Workspace& workspace, const std::string& title) {
  const Csv signals = workspace.signals();
  std::vector<std::string> values;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    values.push_back(signals.row(i)[signals.column(title)]);
  }
  return values;
}

}  // namespace

TEST_CASE("a table is a component, with events at its own times") {
  const Driven workspace(kCycle);
  const Arguments hosting =
      GENERATE(Arguments{}, Arguments{"--isolate"}, Arguments{"--no-idle-skip"});
  Arguments arguments{"--quiet", "--step", "1.5"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  using Words = std::vector<std::string>;
  CHECK(column(workspace, "time") == Words{"0", "1.5", "2", "3", "4", "4.5", "6"});
  CHECK(column(workspace, "cycle.wanted") == Words{"0", "0", "0", "1.5", "5", "5", "5"});
  CHECK(column(workspace, "cycle.gear") == Words{"1", "1", "1", "1", "2", "2", "2"});
  CHECK(column(workspace, "cycle.door") ==
        Words{"true", "true", "false", "false", "false", "false", "false"});
}

TEST_CASE("the signals of a run are a table") {
  const Workspace first(two_filters());
  REQUIRE(first.run({"--quiet", "--step", "0.125", "--set", "first.u=1"}).exit_code == 0);
  const Workspace second(
      Parts{component("before", "signals.csv") + component("filter", "minimal.fmu"),
            connection("before.first.y", "filter.u")});
  second.scratch().write("signals.csv", first.result("signals.csv"));
  const Outcome outcome = second.run({"--quiet", "--step", "0.125"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(second.signals().numbers("before.first.y") == first.signals().numbers("first.y"));
  CHECK(second.signals().numbers("filter.y") == first.signals().numbers("second.y"));
}

TEST_CASE("a mistake in a table names the file, the line and the column") {
  const std::pair<const char*, const char*> kMistakes[] = {
      {"time,wanted,wanted\n0,1,2\n", "cycle.csv:1: columns 2 and 3 have one name, 'wanted'"},
      {"time,wanted: Float64\n0,1\n1,high\n",
       "cycle.csv:3: column 'wanted': 'high' is not a valid Float64"},
      {"time,a b\n0,1\n", "'a b'"},
  };
  for (const auto& [table, expected] : kMistakes) {
    const Driven workspace(table);
    CHECK_THAT(input_error_of(workspace.run({"--quiet"})), Contains(expected));
    CHECK_THAT(input_error_of(workspace.stride({"check", "test.ssd"})), Contains(expected));
    CHECK_THAT(input_error_of(workspace.stride({"pack", "cycle.csv", "-o", "cycle.fmu"})),
               Contains(expected));
  }
}

TEST_CASE("a table is packed alone, and with its scenario") {
  const Driven workspace(kCycle);
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string signals = workspace.result("signals.csv");
  REQUIRE(workspace.stride({"pack", "test.ssd", "-o", "test.ssp"}).exit_code == 0);
  REQUIRE(workspace.stride({"run", "test.ssp", "--quiet", "--out", "packed"}).exit_code == 0);
  CHECK(read(workspace / "packed/signals.csv") == signals);
  REQUIRE(workspace.stride({"pack", "cycle.csv", "-o", "cycle.fmu"}).exit_code == 0);
  REQUIRE(workspace.run({"--quiet", "--swap", "cycle=cycle.fmu"}).exit_code == 0);
  CHECK(workspace.result("signals.csv") == signals);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a table is inspected like a unit, by its name") {
  const Driven workspace(kCycle);
  const Outcome outcome = workspace.stride({"inspect", "cycle.csv"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("cycle: FMI 3.0") && Contains("gear") && Contains("Int32"));
}
