// What decides on the steps, and what a unit sees of the others during one.
#include <cmath>

#include <nlohmann/json.hpp>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Two low-passes of 1 s in a row, the first fed with 1 from the start: y2 = 1 - (1 + t) exp(-t).
const Arguments kFilters{
    "--set",  "first.u=1", "--set", "first.time_constant=1", "--set", "second.time_constant=1",
    "--quiet"};

struct Result {
  double deviation = 0;  ///< the largest of second.y from the closed form
  std::size_t steps = 0;
  nlohmann::json run;
};

Result stepped(const Workspace& workspace, const Arguments& options) {
  Arguments arguments = kFilters;
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = workspace.run(arguments);
  REQUIRE(outcome.err == "");
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  const auto time = signals.numbers("time");
  const auto y = signals.numbers("second.y");
  Result result;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double exact = 1 - (1 + time[i]) * std::exp(-time[i]);
    result.deviation = std::max(result.deviation, std::abs(y[i] - exact));
  }
  result.run = nlohmann::json::parse(read(workspace / "out/run.json"));
  result.steps = result.run.at("communication_steps");
  return result;
}

}  // namespace

TEST_CASE("coupling and extrapolation make a run more accurate at the same steps") {
  const Workspace workspace(two_filters());
  const double held = stepped(workspace, {"--step", "0.05"}).deviation;
  const Result sequential = stepped(workspace, {"--step", "0.05", "--coupling", "gauss-seidel"});
  const Result linear = stepped(workspace, {"--step", "0.05", "--extrapolation", "linear"});
  const Result both = stepped(
      workspace, {"--step", "0.05", "--extrapolation", "linear", "--coupling", "gauss-seidel"});
  CHECK(held > 5e-3);
  CHECK(sequential.deviation < 1.01 * held);
  CHECK(linear.deviation < held / 5);
  CHECK(both.deviation < held / 50);
  CHECK(both.run["step"]["coupling"] == "gauss-seidel");
  CHECK(both.run["step"]["extrapolation"] == "linear");
}

TEST_CASE("an error-controlled run takes few steps where little happens") {
  const Workspace workspace(two_filters());
  const Arguments options{"--policy",
                          "error-controlled",
                          "--extrapolation",
                          "quadratic",
                          "--relative-tolerance",
                          "1e-4",
                          "--absolute-tolerance",
                          "1e-5",
                          "--step",
                          "0.01",
                          "--max-step",
                          "1",
                          "--stop",
                          "10"};
  const Result result = stepped(workspace, options);
  CHECK(result.deviation < 2e-3);
  CHECK(result.steps < 250);
  CHECK(result.run["reached"] == 10);
  CHECK(result.run["step"]["policy"] == "error-controlled");
  CHECK(result.run["step"]["maximum"] == 1);
}

TEST_CASE("the annotation chooses, and the command line chooses otherwise") {
  Parts parts = two_filters();
  parts.annotation =
      "<stride:Step policy=\"event-driven\" maximum=\"0.25\"/><stride:Exchange "
      "coupling=\"gauss-seidel\"/>";
  const Workspace workspace(parts);
  CHECK(stepped(workspace, {}).steps == 4);
  CHECK(stepped(workspace, {"--max-step", "0.5"}).steps == 2);
  const Result other =
      stepped(workspace, {"--policy", "fixed", "--step", "0.1", "--coupling", "jacobi"});
  CHECK(other.steps == 10);
  CHECK(other.run["step"]["coupling"] == "jacobi");
}

TEST_CASE("without any word on steps, they are those that the units prefer") {
  struct Case {
    std::string preference, steps;
  };
  const auto [preference, steps] = GENERATE(values<Case>(
      {{"", "in steps of 0.001 s"},
       {"fixedInternalStepSize=\"0.25\"", "in steps of 0.25 s"},
       {"fixedInternalStepSize=\"0.25\"/><DefaultExperiment stepSize=\"0.5\"", "of 0.5 s"}}));
  const Workspace workspace(Parts{component("unit", "raw")});
  make_raw_fmu(workspace.scratch(), "raw",
               "canHandleVariableCommunicationStepSize=\"true\" " + preference);
  CHECK_THAT(workspace.stride({"check", "test.ssd"}).out, Contains(steps));
}

TEST_CASE("check prints how it would step") {
  const Workspace workspace(two_filters());
  const auto head = [&](const Arguments& options) {
    Arguments arguments{"check", "test.ssd"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return workspace.stride(arguments).out;
  };
  CHECK_THAT(head({"--policy", "event-driven", "--max-step", "0.5"}),
             Contains("from event to event, of 0.5 s at most\ncoupling jacobi, inputs held\n"));
  CHECK_THAT(head({"--policy", "error-controlled", "--extrapolation", "linear"}),
             Contains("keep the inputs' error within 1e-06 + 0.001 of their values\n") &&
                 Contains("inputs extrapolated (linear)") &&
                 Contains("its state is saved before each step"));
}

TEST_CASE("steps that nothing but events ends miss what continuous outputs do between") {
  const Workspace workspace(two_filters());
  const std::string missed =
      "values travel at events only, since nothing else ends a step, so what these outputs do "
      "meanwhile is missed: first.y → second.u; <stride:Step maximum";
  CHECK_THAT(workspace.run({"--policy", "event-driven"}).err, Contains(missed));
  CHECK_THAT(workspace.run({"--step", "1"}).err, Contains(missed));
  CHECK_THAT(workspace.stride({"check", "test.ssd", "--step", "2"}).err, Contains(missed));
  CHECK(workspace.run({"--policy", "event-driven", "--max-step", "1", "--quiet"}).err == "");
  CHECK(workspace.run({"--step", "0.5", "--quiet"}).err == "");
}

TEST_CASE("a unit that says nothing of its events has them late where nothing else ends a step") {
  Parts parts{component("device", "early.fmu")};
  const Arguments event_driven{"--quiet", "--policy", "event-driven", "--set",
                               "device.instants=0.3 -1 -1 -1 -1 -1 -1 -1"};
  CHECK(Workspace(parts).run(event_driven).err == "");
  parts.annotation = "<stride:EarlyReturn components='device' allowed='false'/>";
  const Workspace workspace(parts);
  CHECK_THAT(
      workspace.run(event_driven).err,
      Contains("unit 'device' had events at the ends of its steps which it had not announced "
               "(1 time)"));
  Arguments meant = event_driven;
  meant.insert(meant.end(), {"--max-step", "1"});
  CHECK(workspace.run(meant).err == "");
}

TEST_CASE("what a policy cannot do is an error before the run") {
  Parts parts{component("filter", "minimal.fmu") + component("s", "stateless.fmu")};
  parts.annotation = "<stride:Host components='s' process='false'/>";
  const Workspace workspace(parts);
  const Outcome refused = workspace.run({"--policy", "error-controlled"});
  CHECK_THAT(input_error_of(refused), Contains("cannot be rolled back: 's'"));
  CHECK_FALSE(fs::exists(workspace / "out"));
  CHECK_THAT(input_error_of(workspace.run({"--policy", "fast"})),
             Contains("--policy fast: unknown value 'fast'; known are: fixed, event-driven"));
  CHECK_THAT(input_error_of(workspace.run({"--max-step", "1e-10"})),
             Contains("the maximum step of 0.0000000001 s is below the minimum"));
  CHECK_THAT(input_error_of(workspace.run({"--policy", "error-controlled", "--relative-tolerance",
                                           "0", "--absolute-tolerance", "0"})),
             Contains("both tolerances are 0"));
}

TEST_CASE("a unit that compares with its step and with its stop time gets what fits both") {
  const Workspace workspace(Parts{component("unit", "fmi2_stickler.fmu")});
  const auto stop = GENERATE(as<std::string>(), "0.3", "0.7", "1");  // 0.2 + 0.1 is above 0.3
  const auto hosting = GENERATE(as<std::string>(), "--no-report", "--isolate");
  const Outcome outcome = workspace.run({"--quiet", "--stop", stop, hosting});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.signals().numbers("unit.n").back() == Approx(10 * std::stod(stop)));
}

TEST_CASE("the error of a unit that does not take the shortened last step has the way out") {
  const Workspace workspace(Parts{component("unit", "fmi2_stickler.fmu")});
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0.66"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("this step is one of 0.06 s, since the run ends there, and the "
                                   "others are of 0.1 s") &&
                              Contains("--stop 0.6"));
}

TEST_CASE("a run with a unit of one step size ends with its last whole step") {
  const Workspace workspace(Parts{component("unit", "fmi2_rigid_stickler.fmu") +
                                  component("other", "fmi2_relaxation.fmu")});
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0.66", "--step", "0.1"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("unit 'unit': the unit takes steps of one size only") &&
                              Contains("the run ends at 0.6 s"));
  CHECK(workspace.signals().numbers("time").back() == 0.6);
  CHECK(workspace.signals().numbers("unit.n").back() == 6);
  CHECK(workspace.run({"--quiet", "--stop", "0.6", "--step", "0.1"}).err == "");
  CHECK_THAT(input_error_of(workspace.run({"--stop", "0.06", "--step", "0.1"})),
             Contains("stop at a multiple of them, at 0.1 s or later"));
}

TEST_CASE("the error of a unit in a step of another size than its own has that size") {
  const auto [unit, words] = GENERATE(table<std::string, std::string>(
      {{"fmi2_stickler.fmu", "was made for steps of 0.1 s (its DefaultExperiment), and this one"},
       {"fmi2_rigid_stickler.fmu", "takes steps of one size only, and this one is of 0.05 s"}}));
  const auto hosting = GENERATE(as<std::string>(), "--no-report", "--isolate");
  const Workspace workspace(Parts{component("unit", unit)});
  const Outcome outcome = workspace.run({"--quiet", "--step", "0.05", hosting});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the step is 0.05") && Contains("hint: the unit") &&
                              Contains(words) &&
                              Contains("use --step unit=0.1, or <stride:Step components=\"unit\""));
}

TEST_CASE("another step than that of the unit is said behind the run, or in its error") {
  const Workspace workspace(Parts{component("unit", "fmi2_rigid_stickler.fmu")});
  const Outcome failed = workspace.run({"--quiet", "--step", "unit=0.2"});
  CHECK(failed.exit_code == 1);
  CHECK_THAT(failed.err, !Contains("warning") && Contains("use --step unit=0.1"));
  CHECK_THAT(workspace.stride({"check", "test.ssd", "--step", "unit=0.2"}).err,
             Contains("its DefaultExperiment has 0.1 s, but its steps are of 0.2 s"));
}

TEST_CASE("units of one step size each run side by side, each with its own") {
  const Workspace workspace(Parts{component("fast", "fmi2_fast_rigid_stickler.fmu") +
                                  component("slow", "fmi2_rigid_stickler.fmu")});
  const auto hosting = GENERATE(as<std::string>(), "--no-report", "--isolate");
  const Outcome outcome = workspace.run({"--quiet", hosting});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(workspace.signals().numbers("fast.n").back() == 100);
  CHECK(workspace.signals().numbers("slow.n").back() == 10);
  CHECK(workspace.signals().numbers("time").size() == 101);
  CHECK_THAT(workspace.stride({"check", "test.ssd"}).out,
             Contains("\nfast: steps of 0.01 s\nslow: steps of 0.1 s\n"));
  CHECK_THAT(read(workspace / "out/run.json"),
             Contains("\"components\": {\n      \"fast\": 0.01,\n      \"slow\": 0.1\n"));
  CHECK_THAT(workspace.run({"--quiet", "--step", "0.1"}).err, Contains("--step fast=0.01"));
  CHECK(workspace.run({"--quiet", "--step", "0.1", "--step", "fast=0.01"}).exit_code == 0);
  const Outcome shorter = workspace.run({"--quiet", "--stop", "0.55"});
  CHECK(shorter.exit_code == 0);
  CHECK_THAT(shorter.err, Contains("none of which ends at 0.55 s: its last one ends at 0.5 s"));
}

TEST_CASE("a unit of one step size runs beside one that returns early, or the error has the way") {
  const Workspace workspace(
      Parts{component("stops", "early.fmu") + component("rigid", "fmi2_rigid_stickler.fmu")});
  const Arguments arguments{"--quiet", "--stop", "1", "--set",
                            "stops.instants=0.05 -1 -1 -1 -1 -1 -1 -1"};
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.signals().numbers("rigid.n").back() == 10);
  CHECK(workspace.signals().numbers("time").size() == 12);
  Arguments in_sequence = arguments;
  in_sequence.insert(in_sequence.end(), {"--coupling", "gauss-seidel"});
  CHECK_THAT(workspace.run(in_sequence).err,
             Contains("<stride:EarlyReturn components=\"stops\" allowed=\"false\"/>"));
}

TEST_CASE("steps of components that cannot be are refused") {
  const auto with = [](const std::string& steps) {
    return Workspace(
        Parts{component("fast", "fmi2_relaxation.fmu") + component("slow", "fmi2_relaxation.fmu"),
              "", steps});
  };
  const auto step = [](const std::string& of, const std::string& size) {
    return "<stride:Step components=\"" + of + "\" size=\"" + size + "\"/>\n";
  };
  CHECK_THAT(input_error_of(with(step("slaw", "0.1")).run()), Contains("'slow'"));
  CHECK_THAT(input_error_of(with(step("slow", "0")).run()), Contains("a step must be above 0 s"));
  CHECK_THAT(input_error_of(with(step("slow", "0.1") + step("s*", "0.2")).run()),
             Contains("a second step for this component, 0.2 s; the first is 0.1 s, in line"));
  CHECK_THAT(input_error_of(with("").run({"--step", "0.1", "--step", "0.2"})),
             Contains("a second step"));
  CHECK_THAT(input_error_of(with("").run({"--step", "slow=0"})), Contains("a step must be above"));
}
