// Tables of values over time as components.
#include <cstdlib>

#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

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

TEST_CASE("a table runs alone, from its first row to its last one") {
  const Driven workspace("time,speed [m/s],gear: Int32\n1,0,1\n2,10,2\n3,10,2\n");
  const Outcome outcome =
      workspace.stride({"run", "cycle.csv", "--quiet", "--step", "0.5", "--no-idle-skip"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const std::string signals = read(workspace / "results/cycle/signals.csv");
  CHECK_THAT(signals, StartsWith("time,cycle.speed [m/s],cycle.gear\n1,0,1\n"));
  CHECK_THAT(signals, Contains("\n1.5,5,1\n") && Contains("\n2,10,2\n") && EndsWith("\n3,10,2\n"));
  CHECK_THAT(workspace.stride({"check", "cycle.csv"}).out, Contains("cycle"));
  CHECK(workspace.stride({"verify", "cycle.csv"}).exit_code == 0);
  CHECK_THAT(input_error_of(workspace.stride({"run", "cycle"})),
             Contains("did you mean 'cycle.csv'?"));
}

TEST_CASE("messages of a table do not say when a run begins") {
  const Driven workspace("time,frame.data: Binary event\n1,0a\n2,0b\n");
  REQUIRE(workspace.stride({"run", "cycle.csv", "--quiet"}).exit_code == 0);
  CHECK_THAT(read(workspace / "results/cycle/signals.csv"), StartsWith("time\n0\n"));
}

TEST_CASE("check shows the factors of units of measure, and where none is applied") {
  const auto checked = [](const std::string& attributes) {
    const Workspace workspace(
        Parts{component("cycle", "cycle.csv") +
                  component("filter", "minimal.fmu",
                            connector("u", "input", "<ssc:Float64 unit=\"kmh\"/>")),
              "<ssd:Connection startElement=\"cycle\" startConnector=\"v\" endElement=\"filter\" "
              "endConnector=\"u\"" +
                  attributes + "/>\n",
              "",
              "<ssd:Units><ssc:Unit name=\"kmh\"><ssc:BaseUnit m=\"1\" s=\"-1\" "
              "factor=\"0.2777777777777778\"/></ssc:Unit></ssd:Units>\n"});
    workspace.scratch().write("cycle.csv", "time,v [m/s]\n0,0\n1,2\n");
    const Outcome outcome = workspace.stride({"check", "test.ssd"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    return outcome.out;
  };
  CHECK_THAT(checked(""), Contains("  × 3.6\n"));
  CHECK_THAT(checked(" suppressUnitConversion=\"true\""),
             Contains("unit of measure not converted\n"));
}

TEST_CASE("a misspelt table is named") {
  const Driven workspace(kCycle);
  fs::rename(workspace / "cycle.csv", workspace / "cycles.csv");
  CHECK_THAT(input_error_of(workspace.run({"--quiet"})), Contains("did you mean 'cycles.csv'?"));
  CHECK_THAT(input_error_of(workspace.stride({"run", "cycle.csv"})),
             Contains("did you mean 'cycles.csv'?"));
}

TEST_CASE("a table of another kind needs Python") {
  const Driven workspace(kCycle);
  workspace.scratch().write("cycle.parquet", "PAR1");
  ::setenv("STRIDE_PYTHON", "no_such_python", 1);
  const std::string error = input_error_of(workspace.stride({"inspect", "cycle.parquet"}));
  ::unsetenv("STRIDE_PYTHON");
  CHECK_THAT(error, Contains("cycle.parquet: ") && Contains("no program 'no_such_python'") &&
                        Contains("STRIDE_PYTHON=PROGRAM"));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("two rows of one time are a jump at that time, whatever the step is") {
  const Driven workspace("time,wanted,gear: Int32\n0,1,1\n1.1,1,1\n1.1,3,4\n2,3,4\n");
  const Outcome outcome = workspace.run({"--quiet", "--step", "1", "--stop", "2"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  using Words = std::vector<std::string>;
  CHECK(column(workspace, "time") == Words{"0", "1", "1.1", "2"});
  CHECK(column(workspace, "cycle.wanted") == Words{"1", "1", "3", "3"});
  CHECK(column(workspace, "cycle.gear") == Words{"1", "1", "4", "4"});
}

TEST_CASE("a column of whole numbers is told how to be one of integers") {
  Parts parts{component("cycle", "cycle.csv") + component("types", "types.fmu"),
              connection("cycle.k", "types.int16"), "",
              "<ssd:DefaultExperiment stopTime=\"1\"/>\n"};
  const auto error = [&](const std::string& target) {
    parts.connections = connection("cycle.k", target);
    const Workspace workspace(parts);
    workspace.scratch().write("cycle.csv", "time,k\n0,1\n1,2\n");
    return input_error_of(workspace.run({"--quiet"}));
  };
  CHECK_THAT(error("types.int16"), Contains("cannot connect 'cycle.k' to 'types.int16'") &&
                                       Contains("declare its type in its heading in the table: 'k: "
                                                "Int16'"));
  CHECK_THAT(error("types.colour"), Contains("an Enumeration") && Contains("'k: Int64'"));
  const Workspace mended(parts);
  mended.scratch().write("cycle.csv", "time,k: Int64\n0,1\n1,2\n");
  CHECK(mended.run({"--quiet"}).err == "");
}

TEST_CASE("a unit of measure of a table that nothing defines is warned of") {
  const Driven workspace("time,wanted,far [furlong/s]\n0,0,1\n6,5,2\n");
  const std::string warning =
      "cycle.csv: column 'far': nothing defines 'furlong/s', its unit of measure";
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = workspace.stride({command, "test.ssd"});
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains(warning) && Contains("in the <ssd:Units> of test.ssd") &&
                                Contains("<ssc:Unit name=\"furlong/s\">"));
  }
  CHECK_THAT(workspace.stride({"check", "cycle.csv"}).err,
             Contains(warning) && Contains("a system (.ssd) with the table as a component"));
  std::string defined = read(workspace / "test.ssd");
  const std::string end = "</ssd:SystemStructureDescription>";
  defined.insert(defined.find("<ssd:DefaultExperiment"),
                 "<ssd:Units><ssc:Unit name=\"furlong\"><ssc:BaseUnit m=\"1\" factor=\"201.168\"/>"
                 "</ssc:Unit></ssd:Units>\n");
  workspace.scratch().write("defined.ssd", defined);
  const Outcome outcome = workspace.stride({"run", "defined.ssd", "--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  workspace.scratch().write("cycle.csv", "time,wanted,far [furlnog]\n0,0,1\n6,5,2\n");
  CHECK_THAT(workspace.stride({"check", "defined.ssd"}).err, Contains("did you mean 'furlong'?"));
}

TEST_CASE("a check of a time behind the last row is told why the run ends there") {
  Parts parts{component("cycle", "cycle.csv"), "",
              "<stride:Checks><stride:Always name=\"end\" signal=\"cycle.wanted\" max=\"9\" "
              "from=\"20\"/></stride:Checks>\n",
              ""};
  const Workspace workspace(parts);
  workspace.scratch().write("cycle.csv", kCycle);
  CHECK_THAT(input_error_of(workspace.run({"--quiet"})),
             Contains("20 s is behind the end of the run, at 10 s") &&
                 Contains("the run ends with the last row of the table 'cycle', cycle.csv") &&
                 Contains("--stop SECONDS"));
}

TEST_CASE("a table alone takes the names of its columns") {
  const Driven workspace(kCycle);
  REQUIRE(workspace.stride({"run", "cycle.csv", "--quiet", "--signals", "gear", "--signals", "w*"})
              .exit_code == 0);
  CHECK_THAT(read(workspace / "results/cycle/signals.csv"),
             StartsWith("time,cycle.gear,cycle.wanted\n"));
}
