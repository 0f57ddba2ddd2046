// stride run --capture, and stride pack of what it wrote.
#include <csignal>
#include <thread>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string last_line(const std::string& text) {
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

/// Packs a player of `stimuli` and runs it with the component that they are for.
Outcome replay(const Workspace& workspace, const std::string& component_name,
               const std::string& source, const std::vector<std::string>& inputs,
               const Arguments& options) {
  const Outcome packed = workspace.stride({"pack", "stimuli.csv", "-o", "player.fmu"});
  if (packed.exit_code != 0) return packed;
  std::string connections;
  for (const std::string& input : inputs) {
    connections += connection("player." + input, component_name + "." + input);
  }
  workspace.scratch().write(
      "replay.ssd",
      scenario_text({component("player", "player.fmu") + component(component_name, source),
                     connections, "<stride:Step size=\"1\" maximum=\"1\"/>"}));
  Arguments arguments{"run", "replay.ssd", "--out", "replayed", "--quiet", "--no-trace"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return workspace.stride(arguments);
}

}  // namespace

TEST_CASE("what a component received is played to it, and it does the same") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace
              .run({"--set", "first.u=1", "--set", "second.time_constant=0.3", "--signals",
                    "second.y", "--capture", "second=stimuli.csv", "--quiet"})
              .exit_code == 0);
  const std::string stimuli = read(workspace / "stimuli.csv");
  CHECK_THAT(stimuli, Contains("stride stimuli,1\nunit,minimal\ncomponent,second\n") &&
                          Contains("input,u,Float64,continuous,,,,0\n") &&
                          Contains("set,time_constant,0.3\n") && Contains("\n0,step,,0.001\n"));
  CHECK(last_line(stimuli) == "1,end,,\"completed\"\n");
  const Outcome outcome = replay(workspace, "second", "minimal.fmu", {"u"},
                                 {"--set", "second.time_constant=0.3", "--signals", "second.y"});
  CHECK(outcome.err == "");
  CHECK(read(workspace / "replayed/signals.csv") == workspace.result("signals.csv"));
}

TEST_CASE("values of every type come back, arrays and messages, too") {
  const std::vector<std::string> all{"float32", "float64", "int8",   "uint8",  "int16",   "uint16",
                                     "int32",   "uint32",  "int64",  "uint64", "boolean", "string",
                                     "binary",  "colour",  "matrix", "flags",  "words",   "blobs"};
  std::string wires = connection("source.send.clock", "sink.receive.clock") +
                      connection("source.send.frame", "sink.receive.frame");
  for (const std::string& name : all)
    wires += connection("source." + name + ".echo", "sink." + name);
  const Workspace workspace(
      Parts{component("source", "types.fmu") + component("sink", "types.fmu"), wires});
  REQUIRE(workspace
              .run({"--step",
                    "0.25",
                    "--quiet",
                    "--signals",
                    "sink.*.echo",
                    "--capture",
                    "sink=stimuli.csv",
                    "--set",
                    "source.float32=0.1",
                    "--set",
                    "source.float64=1e-300",
                    "--set",
                    "source.uint64=18446744073709551615",
                    "--set",
                    "source.boolean=true",
                    "--set",
                    "source.string=a, \"b\"",
                    "--set",
                    "source.binary=00ff",
                    "--set",
                    "source.colour=green",
                    "--set",
                    "source.matrix=1 2 3 4 5 0.1",
                    "--set",
                    "source.flags=true false true"})
              .exit_code == 0);
  const std::string stimuli = read(workspace / "stimuli.csv");
  CHECK_THAT(stimuli, Contains("\n0,,string,\"a, \"\"b\"\"\"\n") &&
                          Contains("\n0,,matrix,1,2,3,4,5,0.1\n") &&
                          Contains("\n0,,flags,true,false,true\n") &&
                          Contains("\n0,,float64,1e-300\n") && Contains("item,colour,blue,4\n"));
  const Outcome outcome =
      replay(workspace, "sink", "types.fmu", all, {"--step", "0.25", "--signals", "sink.*.echo"});
  CHECK(outcome.err == "");
  CHECK(read(workspace / "replayed/signals.csv") == workspace.result("signals.csv"));
}

TEST_CASE("several components are captured in one run, and what they do is not changed by it") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--set", "first.u=1"}).exit_code == 0);
  const std::string before = workspace.result("signals.csv");
  REQUIRE(workspace
              .run({"--quiet", "--set", "first.u=1", "--capture", "first=a.csv", "--capture",
                    "second=b.csv"})
              .exit_code == 0);
  CHECK(workspace.result("signals.csv") == before);
  CHECK_THAT(read(workspace / "a.csv"), Contains("component,first\n"));
  CHECK_THAT(read(workspace / "b.csv"), Contains("component,second\n"));
}

TEST_CASE("what cannot be captured is refused before the run") {
  const Workspace workspace(two_filters());
  const auto mistake = [&](const Arguments& options) {
    const std::string message = input_error_of(workspace.run(options));
    CHECK_FALSE(fs::exists(workspace / "out/signals.csv"));
    return message;
  };
  CHECK_THAT(mistake({"--capture", "secnd=x.csv"}),
             Contains("--capture secnd=x.csv: there is no component 'secnd'") &&
                 Contains("did you mean 'second'?"));
  CHECK_THAT(mistake({"--capture", "second"}), Contains("expected COMPONENT=FILE"));
  CHECK_THAT(mistake({"--capture", "second="}), Contains("no file is named"));
  CHECK_THAT(mistake({"--capture", "second=a.csv", "--capture", "second=b.csv"}),
             Contains("the component is captured twice"));
  CHECK_THAT(mistake({"--capture", "second=a.csv", "--capture", "first=./a.csv"}),
             Contains("the file is written twice"));
  CHECK_THAT(mistake({"--capture", "second=nowhere/x.csv"}),
             Contains("nowhere/x.csv: cannot create the file: No such file or directory") &&
                 Contains("name a file that you may write"));
  CHECK_THAT(mistake({"--capture", "second=a.csv", "--coupling", "gauss-seidel"}),
             Contains("'gauss-seidel'") && Contains("cannot be captured") &&
                 Contains("use --coupling jacobi --extrapolation hold"));
  CHECK_THAT(mistake({"--capture", "second=a.csv", "--extrapolation", "linear"}),
             Contains("'linear'") && Contains("cannot be captured"));
}

TEST_CASE("a full disk ends the run, and names the file") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run({"--quiet", "--capture", "second=/dev/full"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("stride: error: /dev/full: ") &&
                              Contains("No space left on device") && Contains("make room"));
}

TEST_CASE("a run that fails leaves stimuli up to the last instant that all have reached") {
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("fuse", "thrower.fmu")});
  CHECK(workspace.run({"--quiet", "--set", "fuse.throw_at=0.5", "--capture", "filter=stimuli.csv"})
            .exit_code == 1);
  const std::string last = last_line(read(workspace / "stimuli.csv"));
  CHECK_THAT(read(workspace / "stimuli.csv"),
             Contains("\n0.498,step,,0.499\n0.499,end,,\"failed: ") && Contains("at 0.499 s"));
  CHECK(replay(workspace, "filter", "minimal.fmu", {"u"}, {}).err == "");
}

TEST_CASE("an interrupted run leaves stimuli that are complete") {
  const Workspace workspace(two_filters());
  Process process(stride_command(Workspace::run_arguments(
                      {"--stop", "1e6", "--no-trace", "--capture", "second=stimuli.csv"})),
                  workspace.scratch().path());
  std::error_code none;
  while (process.is_running()) {
    const auto size = fs::file_size(workspace / "stimuli.csv", none);
    if (!none && size > 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  process.send(SIGINT);
  CHECK(process.wait().exit_code == 1);
  CHECK_THAT(last_line(read(workspace / "stimuli.csv")), Contains("interrupted"));
  CHECK(workspace.stride({"pack", "stimuli.csv", "-o", "player.fmu"}).exit_code == 0);
}

TEST_CASE("stimuli that are damaged are refused with the user's file and the line") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--capture", "second=stimuli.csv"}).exit_code == 0);
  const std::string whole = read(workspace / "stimuli.csv");
  const auto mistake = [&](const std::string& text) {
    workspace.scratch().write("bad.csv", text);
    const std::string message =
        input_error_of(workspace.stride({"pack", "bad.csv", "-o", "player.fmu"}));
    CHECK_FALSE(fs::exists(workspace / "player.fmu"));
    return message;
  };
  CHECK_THAT(mistake(whole.substr(0, 2000)), Contains("error: bad.csv:") && Contains("cut off"));
  const std::size_t first = whole.find("0.5,step,,");
  const std::size_t second = whole.find("0.6,step,,");
  CHECK_THAT(mistake(whole.substr(0, first) + whole.substr(second, 14) + whole.substr(first)),
             Contains("error: bad.csv:") && Contains("out of order"));
  CHECK_THAT(mistake("stride stimuli\n"), Contains("bad.csv:1: the version is '', expected 1"));
  CHECK_THAT(mistake("t,x\n0,1\n"), Contains("bad.csv:1: the first column is 't'"));
}

TEST_CASE("stimuli are packed with nothing else, and played to what they fit only") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--capture", "second=stimuli.csv"}).exit_code == 0);
  CHECK_THAT(input_error_of(workspace.stride(
                 {"pack", "stimuli.csv", "-o", "player.fmu", "--resources", "out"})),
             Contains("stimuli are packed with the unit player"));
  const std::string other = input_error_of(replay(workspace, "sink", "types.fmu", {"binary"}, {}));
  CHECK_THAT(other, Contains("replay.ssd:") && Contains("'player'") && Contains("'binary'"));
  const Outcome inspected = workspace.stride({"inspect", "player.fmu"});
  CHECK_THAT(inspected.out, Contains("Plays to 'minimal' what 'second' received in 'test'"));
}

TEST_CASE("points that the original did not have are reported once") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--capture", "second=stimuli.csv"}).exit_code == 0);
  const Outcome outcome =
      replay(workspace, "second", "minimal.fmu", {"u"}, {"--step", "0.0003", "--no-idle-skip"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err ==
        "stride: warning: unit 'player': there is a communication point at 0.0003 s where the "
        "captured "
        "unit had none, so steps are cut otherwise than they were; let the step policy be "
        "event-driven\n");
}

TEST_CASE("where another unit does not stop, stimuli are late or make it stop") {
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("device", "early.fmu"),
            connection("filter.y", "device.u")});
  REQUIRE(workspace
              .run({"--quiet", "--step", "0.25", "--set", "device.instants=0.3 0.6 2 2 2 2 2 2",
                    "--set", "filter.u=1", "--capture", "device=stimuli.csv"})
              .exit_code == 0);
  CHECK_THAT(read(workspace / "stimuli.csv"), Contains("\n0.25,step,,0.5\n0.3,0,u,"));
  const Outcome late = replay(workspace, "other", "minimal.fmu", {"u"}, {});
  CHECK(late.exit_code == 0);
  CHECK_THAT(late.err, Contains("received at 0.3 s") && Contains("comes late"));
  CHECK_THAT(read(workspace / "replayed/signals.csv"), !Contains("\n0.3,"));
  const Outcome stopped =
      replay(workspace, "other", "minimal.fmu", {"u"}, {"--set", "player.stop_at_stimuli=true"});
  CHECK(stopped.err == "");
  CHECK_THAT(read(workspace / "replayed/signals.csv"), Contains("\n0.3,"));
}

TEST_CASE("a run that begins after the start of the stimuli prints a warning") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--capture", "second=stimuli.csv"}).exit_code == 0);
  REQUIRE(workspace.stride({"pack", "stimuli.csv", "-o", "player.fmu"}).exit_code == 0);
  workspace.scratch().write(
      "late.ssd", scenario_text({component("player", "player.fmu"), "", "",
                                 "<ssd:DefaultExperiment startTime=\"0.5\" stopTime=\"2\"/>"}));
  const Outcome outcome = workspace.stride({"run", "late.ssd", "--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("the stimuli begin at 0 s, the run at 0.5 s"));
}
