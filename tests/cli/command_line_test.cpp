// Arguments, options and exit codes.
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("without a command, the help is shown as an error") {
  const Outcome outcome = run_program({});
  CHECK(outcome.exit_code == 2);
  for (const char* command : {"run", "check", "inspect", "complete", "pack", "trace"}) {
    CHECK_THAT(outcome.err, Contains(std::string("\n  ") + command + " "));
  }
}

TEST_CASE("--help and --version are answered on the standard output") {
  const Outcome help = run_program({"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.err == "");
  CHECK_THAT(help.out, Contains("Usage: stride") &&
                           Contains("Exit codes: 0 good, 1 the run failed, or a check or "
                                    "verdict failed, 2 the input was wrong."));
  const Outcome run_help = run_program({"run", "--help"});
  CHECK(run_help.exit_code == 0);
  for (const char* option : {"--stop", "--step", "--set", "--swap", "--signals", "--out",
                             "--threads", "--no-trace", "--quiet"}) {
    CHECK_THAT(run_help.out, Contains(option));
  }
  const Outcome version = run_program({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out == "stride " STRIDE_VERSION "\n");
}

TEST_CASE("an unknown command is answered with the nearest one") {
  CHECK_THAT(
      input_error_of(run_program({"rnu", "test.ssd"})),
      StartsWith("stride: error: there is no command 'rnu'") && Contains("did you mean 'run'?"));
}

TEST_CASE("the command of the Python package is answered with how to have it") {
  CHECK_THAT(input_error_of(run_program({"export", "results", "--mcap", "run.mcap"})),
             StartsWith("stride: error: there is no command 'export'\n  hint: ") &&
                 Contains("pip install 'stride-cosim[mcap]'"));
}

TEST_CASE("a mistake in a command's arguments names the argument and points to the help") {
  CHECK_THAT(input_error_of(run_program({"run"})),
             Contains("SCENARIO is required") && Contains("stride run --help"));
  CHECK_THAT(input_error_of(run_program({"check", "test.ssd", "--frobnicate"})),
             Contains("--frobnicate") && Contains("stride check --help"));
  CHECK_THAT(input_error_of(run_program({"run", "test.ssd", "--stopp=3"})),
             Contains("--stopp=3") && Contains("did you mean '--stop'?"));
  for (const Arguments& arguments :
       {Arguments{"run", "--stopp", "3", "test.ssd"},
        {"run", "test.ssd", "--stopp", "3"},
        {"run", "--stopp", "3"},
        {"run", "-q", "test.ssd", "x", "--stopp", "3", "--set", "a.b=1"}}) {
    CHECK_THAT(input_error_of(run_program(arguments)), Contains("did you mean '--stop'?"));
  }
  for (const auto& [other, meant] : {std::pair{"--end", "--stop"},
                                     {"--dt", "--step"},
                                     {"--start-time", "--start"},
                                     {"--output-dir", "--out"}}) {
    CHECK_THAT(input_error_of(run_program({"run", "test.ssd", other, "3"})),
               Contains(std::string("did you mean '") + meant + "'?"));
  }
  CHECK_THAT(input_error_of(run_program({"pack", "nothing.so", "--output", "x.fmu"})),
             Contains("nothing.so"));
}

TEST_CASE("times on the command line are numbers of seconds that make sense") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.run({"--stop", "-1"})),
             Contains("the stop time -1 s is before the start time 0 s"));
  CHECK_THAT(input_error_of(workspace.run({"--stop", "soon"})),
             Contains("--stop soon: 'soon' is not a number; expected a number of seconds"));
  CHECK_THAT(input_error_of(workspace.run({"--stop", "1e16"})), Contains("beyond 1e15 s"));
  CHECK_THAT(input_error_of(workspace.run({"--step", "0"})), Contains("a step must be above 0 s"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("the number of threads is a sensible one") {
  const Workspace workspace(two_filters());
  for (const char* number : {"0", "-1", "1025", "99999999999999999999", "2.5", "many"}) {
    CHECK_THAT(input_error_of(workspace.run({"--threads", number})), Contains("--threads"));
  }
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("a stop time before the start time is refused") {
  Parts parts = two_filters();
  parts.experiment = "<ssd:DefaultExperiment startTime=\"2\" stopTime=\"3\"/>\n";
  const Workspace workspace(parts);
  CHECK_THAT(input_error_of(workspace.run({"--stop", "1"})),
             Contains("the stop time 1 s is before the start time 2 s"));
  parts.components = component("first", "fmi2_relaxation.fmu");
  parts.connections = "";
  parts.experiment = "<ssd:DefaultExperiment startTime=\"5\"/>\n";
  CHECK_THAT(input_error_of(Workspace(parts).run()),
             Contains("s (of the units' DefaultExperiment) is before the start time 5 s") &&
                 Contains("--stop SECONDS"));
}

TEST_CASE("--start has precedence over the start time of the scenario") {
  Parts parts = two_filters();
  parts.experiment = "<ssd:DefaultExperiment startTime=\"2\" stopTime=\"3\"/>\n";
  const Workspace workspace(parts);
  CHECK(workspace.run({"--start", "2.5", "--quiet"}).exit_code == 0);
  CHECK(workspace.signals().row(0).front() == "2.5");
  CHECK(workspace.run({"--start", "-1", "--stop", "-0.5", "--quiet"}).exit_code == 0);
  CHECK(workspace.signals().row(0).front() == "-1");
  CHECK_THAT(input_error_of(workspace.run({"--start", "4"})),
             Contains("the stop time 3 s is before the start time 4 s") && Contains("--start"));
}

TEST_CASE("without a stop time anywhere, the message says where to give one") {
  Parts parts = two_filters();
  parts.experiment = "";
  const Workspace workspace(parts);
  CHECK_THAT(input_error_of(workspace.run()),
             Contains("there is no stop time") && Contains("--stop SECONDS"));
  CHECK(workspace.run({"--stop", "0.1", "--quiet"}).exit_code == 0);
}

TEST_CASE("--set explains what is wrong with it") {
  const Workspace workspace(two_filters());
  const auto error = [&](const std::string& text) {
    const std::string message = input_error_of(workspace.run({"--set", text}));
    CHECK_THAT(message, StartsWith("stride: error: --set " + text + ": "));
    return message;
  };
  CHECK_THAT(error("first.u"), Contains("expected component.variable=value"));
  CHECK_THAT(error("=1"), Contains("expected component.variable=value"));
  CHECK_THAT(error("first.u:  3"), Contains("hint: write --set first.u=3"));
  CHECK_THAT(input_error_of(workspace.run({"--set", "first.u", "3"})),
             Contains("hint: the value follows '=', as in --set first.u=3"));
  CHECK_THAT(input_error_of(workspace.run({"--swap", "first", "test.ssd"})),
             Contains("as in --swap first=VALUE"));
  CHECK_THAT(error("frist.u=1"),
             Contains("no component 'frist'") && Contains("did you mean 'first'?"));
  CHECK_THAT(error("first.time_constnat=1"), Contains("unit 'first', variable 'time_constnat'") &&
                                                 Contains("did you mean 'time_constant'?"));
  CHECK_THAT(error("first.u=high"), Contains("'high' is not a value for it, expected a Float64"));
  CHECK_THAT(error("first.u="), Contains("expected one Float64 value"));
  CHECK_THAT(error("first.time=1"), Contains("cannot be set"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("a step size that the policy of the scenario has no use for is said") {
  Parts parts = two_filters();
  parts.annotation += "<stride:Step policy='event-driven' maximum='0.25'/>";
  const Workspace workspace(parts);
  const Outcome outcome = workspace.run({"--step", "0.1", "--quiet"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("--step 0.1: with the policy 'event-driven' steps end at events"));
}

TEST_CASE("options that contradict each other are refused") {
  const Workspace workspace(two_filters());
  const auto error = [&](const Arguments& arguments) {
    return input_error_of(workspace.run(arguments));
  };
  CHECK_THAT(
      error({"--step", "1", "--max-step", "0.1"}),
      Contains("--step 1 is longer than --max-step 0.1") && Contains("leave one of them out"));
  CHECK_THAT(error({"--step", "0.1", "--policy", "event-driven"}),
             Contains("--step 0.1: with the policy 'event-driven' steps end at events") &&
                 Contains("--max-step 0.1, or use --policy fixed"));
  CHECK_THAT(error({"--relative-tolerance", "0.1"}),
             Contains("--relative-tolerance: the policy 'fixed' does not control the error") &&
                 Contains("--policy error-controlled"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("options that have no effect are warned of") {
  const Workspace workspace(two_filters());
  const Outcome serial = workspace.run({"--quiet", "--threads", "2", "--coupling", "gauss-seidel"});
  CHECK(serial.exit_code == 0);
  CHECK_THAT(serial.err,
             Contains("--threads 2: with the coupling 'gauss-seidel' the units step one "
                      "after another"));
  CHECK_THAT(workspace.run({"--quiet", "--set", "first.u=1", "--set", "first.u=2"}).err,
             Contains("warning: --set first.u=2 replaces --set first.u=1"));
  CHECK(workspace.run({"--quiet", "--set", "first.u=1", "--set", "first.u=1"}).err == "");
  CHECK_THAT(
      workspace.run({"--quiet", "--swap", "first=gain.fmu", "--swap", "first=minimal.fmu"}).err,
      Contains("warning: --swap first=minimal.fmu replaces --swap first=gain.fmu"));
  Parts parts = two_filters();
  parts.annotation = "<stride:Step size=\"0.1\"/>\n";
  const Outcome shorter = Workspace(parts).run({"--quiet", "--max-step", "0.05"});
  CHECK(shorter.exit_code == 0);
  CHECK_THAT(shorter.err, Contains("no step is as long as the step size of 0.1 s"));
}

TEST_CASE("--swap explains what is wrong with it") {
  const Workspace workspace(two_filters());
  const auto error = [&](const std::string& text) {
    return input_error_of(workspace.run({"--swap", text}));
  };
  CHECK_THAT(error("first"), Contains("--swap first: expected component=FILE.fmu"));
  CHECK_THAT(error("first="), Contains("--swap first=: no file is named"));
  CHECK_THAT(error("frist=minimal.fmu"),
             Contains("no component 'frist'") && Contains("did you mean 'first'?"));
  CHECK_THAT(error("first=minimum.fmu"), Contains("--swap first=minimum.fmu: there is no unit") &&
                                             Contains("did you mean 'minimal.fmu'?"));
}

TEST_CASE("a unit that lacks what the scenario connects cannot be swapped in") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.run({"--swap", "first=thrower.fmu"})),
             Contains(workspace.at("<ssd:Connection ") + "unit 'first', variable 'y'") &&
                 Contains("its model 'thrower' has no such variable") && Contains("steps"));
  CHECK_THAT(
      input_error_of(
          workspace.run({"--swap", "second=thrower.fmu", "--set", "second.time_constant=1"})),
      Contains("unit 'second': 2 things do not fit") && Contains("variable 'time_constant'") &&
          Contains("variable 'u'") && Contains("expected an input Float64, fed by 'first.y'"));
}

TEST_CASE("a pattern of signals that matches nothing is a mistake") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.run({"--signals", "first.z*"})),
             Contains("'first.z*' matches no variable to record"));
}

TEST_CASE("results go into a folder only") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.stride({"run", "test.ssd", "--out", "test.ssd"})),
             Contains("test.ssd: cannot write results into this folder: it is a file"));
  CHECK_THAT(input_error_of(workspace.stride({"run", "test.ssd", "--out", "test.ssd/out"})),
             Contains("test.ssd/out: cannot write results into this folder") &&
                 Contains("choose another results folder"));
}

TEST_CASE("a flag has its value behind '='") {
  const Workspace workspace(two_filters());
  CHECK_THAT(input_error_of(workspace.run({"--isolate="})),
             Contains("--isolate=: there is no value behind '='") && Contains("hint: leave"));
  CHECK_THAT(input_error_of(workspace.run({"--film="})), Contains("--film=: there is no value"));
  CHECK_THAT(input_error_of(workspace.run({"--live="})), Contains("--live=: there is no value"));
  CHECK_THAT(input_error_of(workspace.stride({"check", "--isolate", "first", "test.ssd"})),
             Contains("test.ssd") && Contains("as in --isolate=VALUE"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}

TEST_CASE("--verbose may follow the command") {
  const Workspace workspace(two_filters());
  CHECK(workspace.run({"--quiet", "--verbose"}).exit_code == 0);
  CHECK(workspace.stride({"check", "test.ssd", "--verbose"}).exit_code == 0);
}

TEST_CASE("a limit of memory or of the stack that is too low is named, with what to do") {
  if (kSanitized) return;
  const Workspace workspace(two_filters());
  const auto run_limited = [&](const std::string& limits) {
    std::string command = "ulimit " + limits + " && exec";
    for (const std::string& word : stride_command(Workspace::run_arguments({"--quiet"}))) {
      command += " '" + word + "'";
    }
    return Process({"bash", "-c", command}, workspace.scratch().path()).wait();
  };
  const Outcome stack = run_limited("-s 128");
  CHECK(stack.exit_code == 1);
  CHECK(stack.err ==
        "stride: error: the stack of a process is limited to 128 KiB; stride needs 256 KiB\n"
        "  hint: raise the limit (ulimit -s)\n");
  CHECK(run_limited("-S -s 128").exit_code == 0);
  const Outcome data = run_limited("-d 4096");
  CHECK(data.exit_code == 1);
  CHECK_THAT(data.err, Contains("there is not enough memory\n  hint: this process may have 4 MiB "
                                "(ulimit -d) of memory: raise the limit\n"));
}
