// check, inspect, complete and pack.
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// The line of a table that begins with this cell, or nothing.
std::string line_of(const std::string& table, const std::string& first_cell) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  " + first_cell + " ", 0) == 0) return line;
  }
  return "";
}

std::map<std::string, std::string> files_below(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[entry.path().string()] = read(entry.path());
  }
  return files;
}

}  // namespace

TEST_CASE("check prints units, connections and order, and writes nothing") {
  const Workspace workspace(two_filters());
  const auto before = files_below(workspace.scratch().path());
  const Outcome outcome = workspace.stride({"check", "test.ssd", "--step", "0.125"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out,
             StartsWith("root: 2 components, 1 connection, 2 recorded signals\n"
                        "from 0 s to 1 s, in steps of 0.125 s\ncoupling jacobi, inputs held\n"));
  CHECK_THAT(line_of(outcome.out, "first"), Contains("minimal") && Contains("minimal.fmu"));
  CHECK_THAT(line_of(outcome.out, "first.y"), Contains("second.u") && Contains("Float64"));
  CHECK_THAT(outcome.out, Contains("\nStep order"));
  const std::string order = outcome.out.substr(outcome.out.find("\nStep order") + 1);
  CHECK(order.find("first") < order.find("second"));
  CHECK(files_below(workspace.scratch().path()) == before);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("inspect prints each variable of a unit") {
  const Outcome outcome = run_program({"inspect", "minimal.fmu"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, StartsWith("minimal: FMI 3.0 Co-Simulation") &&
                              Contains("First-order low-pass filter") &&
                              Contains("can be rolled back"));
  CHECK_THAT(line_of(outcome.out, "u"), Contains("input") && Contains("signal"));
  CHECK_THAT(line_of(outcome.out, "y"), Contains("output") && Contains("filtered signal"));
  CHECK_THAT(line_of(outcome.out, "time"), Contains("independent"));
  CHECK_THAT(line_of(outcome.out, "time_constant"),
             Contains("parameter") && Contains(" s ") && Contains("≥ 1e-09"));
}

TEST_CASE("inspect shows arrays, clocks and enumerations") {
  const Outcome outcome = run_program({"inspect", "types.fmu"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(line_of(outcome.out, "matrix"), Contains("Float64[2][3]"));
  CHECK_THAT(line_of(outcome.out, "send.frame"), Contains("Binary at send.clock"));
  CHECK_THAT(line_of(outcome.out, "colour"), Contains("Enumeration") && Contains("1 red, 2 green"));
}

TEST_CASE("inspect shows which variables are differences") {
  const Outcome outcome = run_program({"inspect", "gain.fmu"});
  CHECK_THAT(line_of(outcome.out, "k"), Contains(" difference "));
  CHECK_THAT(line_of(outcome.out, "u"), !Contains("difference"));
}

TEST_CASE("inspect of a unit that is not there") {
  const Outcome outcome = run_program({"inspect", "minimla.fmu"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.out == "");
  CHECK_THAT(outcome.err,
             Contains("there is no unit 'minimla.fmu'") && Contains("did you mean 'minimal.fmu'?"));
}

TEST_CASE("complete writes the connectors, once") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string signals = workspace.result("signals.csv");

  CHECK(workspace.stride({"complete", "test.ssd"}).exit_code == 0);
  const std::string once = read(workspace / "test.ssd");
  for (const char* name : {"\"u\" kind=\"input\"", "\"y\" kind=\"output\""}) {
    CHECK_THAT(once, Contains(std::string("<ssd:Connector name=") + name));
  }
  CHECK(workspace.stride({"complete", "test.ssd"}).exit_code == 0);
  CHECK(read(workspace / "test.ssd") == once);

  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  CHECK(workspace.result("signals.csv") == signals);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("complete can write another file without a change of its input") {
  const Workspace workspace(two_filters());
  CHECK(workspace.stride({"complete", "test.ssd", "--output", "full.ssd"}).exit_code == 0);
  CHECK(read(workspace / "test.ssd") == scenario_text(two_filters()));
  CHECK_THAT(read(workspace / "full.ssd"), Contains("<ssd:Connector name=\"u\""));
  const Outcome outcome =
      workspace.stride({"complete", "test.ssd", "--output", "nowhere/full.ssd"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("nowhere/full.ssd: the folder of this file does not exist"));
}

TEST_CASE("each command that writes an output takes both spellings of the option") {
  const Workspace workspace(two_filters());
  const std::string spellings[] = {"-o", "--out", "--output"};
  for (const std::string& spelling : spellings) {
    CAPTURE(spelling);
    const Arguments commands[] = {
        {"run", "test.ssd", "--quiet", "--stop", "0.01", spelling, "results"},
        {"report", "results", spelling, "page.html"},
        {"complete", "test.ssd", spelling, "full.ssd"},
        {"pack", unit_library("minimal").string(), spelling, "packed.fmu"}};
    for (const Arguments& command : commands) {
      CAPTURE(command.front());
      CHECK(workspace.stride(command).exit_code == 0);
      CHECK(fs::exists(workspace / command.back()));
    }
    for (const Arguments& command : commands) fs::remove_all(workspace / command.back());
  }
}

TEST_CASE("complete leaves a scenario that it cannot complete as it is") {
  const Workspace workspace(Parts{component("filter", "minimla.fmu")});
  const auto before = files_below(workspace.scratch().path());
  CHECK(workspace.stride({"complete", "test.ssd"}).exit_code == 2);
  CHECK(files_below(workspace.scratch().path()) == before);
}

TEST_CASE("pack makes a .fmu that can be inspected and run") {
  const Workspace workspace(Parts{component("filter", "packed.fmu")});
  const Outcome outcome =
      workspace.stride({"pack", unit_library("minimal").string(), "--output", "packed.fmu"});
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  const Outcome inspected = workspace.stride({"inspect", "packed.fmu"});
  CHECK(inspected.exit_code == 0);
  CHECK(inspected.out == run_program({"inspect", "minimal.fmu"}).out);
  CHECK(workspace.run({"--quiet"}).exit_code == 0);
}

TEST_CASE("pack finds a .fmu among the units, and gives it other resources") {
  const Workspace workspace(two_filters());
  workspace.scratch().write("resources/note.txt", "a note");
  const Outcome outcome = workspace.stride(
      {"pack", "minimal.fmu", "--resources", "resources", "--output", "packed.fmu"});
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.stride({"inspect", "packed.fmu"}).out ==
        run_program({"inspect", "minimal.fmu"}).out);
}

TEST_CASE("pack does not take what is not a unit") {
  const Workspace workspace(two_filters());
  workspace.scratch().write("notes.txt", "no library");
  const Outcome outcome = workspace.stride({"pack", "notes.txt", "--output", "packed.fmu"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("notes.txt' cannot be loaded"));
  const Outcome scenario = workspace.stride({"pack", "test.ssd", "--output", "packed.fmu"});
  CHECK(scenario.exit_code == 2);
  CHECK_THAT(scenario.err, Contains("a scenario becomes a package (.ssp)"));
  CHECK_FALSE(fs::exists(workspace / "packed.fmu"));
}
