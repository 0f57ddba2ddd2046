// Good runs: what they print, what they write, and what the numbers in it are.
#include <cmath>
#include <iterator>
#include <memory>
#include <sstream>

#include <nlohmann/json.hpp>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// One low-pass. Its own source, `u`, is held, so y = u + (y0 - u) exp(-t/T) exactly.
Parts one_filter() { return {component("filter", "minimal.fmu")}; }

void unpack(const fs::path& archive, const fs::path& folder) {
  const auto fail = [&] { throw std::runtime_error(archive.string() + " cannot be unpacked"); };
  const std::unique_ptr<::archive, decltype(&archive_read_free)> reader(archive_read_new(),
                                                                        &archive_read_free);
  archive_read_support_format_zip(reader.get());
  if (archive_read_open_filename(reader.get(), archive.c_str(), 1 << 16) != ARCHIVE_OK) fail();
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    archive_entry_set_pathname(entry, (folder / archive_entry_pathname(entry)).c_str());
    if (archive_read_extract(reader.get(), entry, 0) != ARCHIVE_OK) fail();
  }
}

Csv signals_of(const Workspace& workspace, Arguments options) {
  options.push_back("--quiet");
  const Outcome outcome = workspace.run(options);
  REQUIRE(outcome.err == "");
  REQUIRE(outcome.exit_code == 0);
  return workspace.signals();
}

}  // namespace

TEST_CASE("a run writes its results, prints a summary, and leaves nothing else") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("1 s simulated") && Contains("1000 communication steps") &&
                              Contains("first.y") && Contains("second.y") &&
                              Contains("Results in out: signals.csv events.csv signals.vcd "
                                       "activity.csv run.json report.html\n"));
  CHECK(files_in(workspace / "out") == std::vector<std::string>{"activity.csv", "events.csv",
                                                                "report.html", "run.json",
                                                                "signals.csv", "signals.vcd"});
  CHECK(files_in(workspace.scratch().path()) == std::vector<std::string>{"out", "test.ssd", "tmp"});
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("the summary has the range of each recorded number and Boolean, and counts the others") {
  const Workspace workspace(Parts{component("t", "types.fmu")});
  const Outcome outcome = workspace.run({"--stop", "0.01", "--set", "t.int32=-123456", "--set",
                                         "t.boolean=true", "--set", "t.float32=0.25", "--set",
                                         "t.colour=blue", "--set", "t.float64=1.5"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto row = [&](const std::string& name) {
    const std::size_t begin = outcome.out.find("  " + name + " ");
    REQUIRE(begin != std::string::npos);
    std::istringstream words(outcome.out.substr(begin, outcome.out.find('\n', begin) - begin));
    return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
  };
  const auto range = [](const std::string& name, const std::string& value) {
    return std::vector<std::string>{name, value, value, value};
  };
  CHECK(row("t.int32.echo") == range("t.int32.echo", "-123456"));
  CHECK(row("t.boolean.echo") == range("t.boolean.echo", "true"));
  CHECK(row("t.float32.echo") == range("t.float32.echo", "0.25"));
  CHECK(row("t.colour.echo") == range("t.colour.echo", "4"));
  CHECK(row("t.float64.echo").back() == "m");
  CHECK_THAT(outcome.out, Contains("  6 arrays and texts recorded, not shown here\n"));
}

TEST_CASE("without --out, the results lie in results/ under the scenario's name") {
  const Workspace workspace(two_filters());
  CHECK(workspace.stride({"run", "test.ssd", "--quiet"}).exit_code == 0);
  CHECK(files_in(workspace / "results/test").size() == 6);
}

TEST_CASE("run.json has what was run and how far the run came") {
  const Workspace workspace(two_filters());
  signals_of(workspace, {"--stop", "0.25"});
  const auto json = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(json["scenario"] == "test.ssd");
  CHECK(json["outcome"] == "completed");
  CHECK(json["reached"] == 0.25);
  CHECK(json["communication_steps"] == 250);
  CHECK(json["units"].size() == 2);
  CHECK(json["units"][1]["name"] == "second");
  CHECK(json["units"][1]["steps"] == 250);
  CHECK(json["threads"] == 1);
  CHECK(json["parallel_steps"] == 0);
  CHECK_FALSE(json.contains("error"));
}

TEST_CASE("--threads may be more than there are units, and cheap units do not use them") {
  const Workspace workspace(two_filters());
  signals_of(workspace, {"--threads", "64"});
  const auto json = nlohmann::json::parse(workspace.result("run.json"));
  CHECK(json["threads"] == 64);
  CHECK(json["communication_steps"] == 1000);
  CHECK(json["parallel_steps"] <= 1000);
}

TEST_CASE("--quiet prints nothing") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "");
  CHECK(outcome.err == "");
}

TEST_CASE("--no-trace writes no VCD") {
  const Workspace workspace(two_filters());
  signals_of(workspace, {"--no-trace"});
  CHECK(files_in(workspace / "out") == std::vector<std::string>{"activity.csv", "events.csv",
                                                                "report.html", "run.json",
                                                                "signals.csv"});
}

TEST_CASE("--signals chooses the columns, instead of the scenario") {
  Parts parts = two_filters();
  parts.annotation = "<stride:Record signals=\"first.y\"/>\n";
  const Workspace workspace(parts);
  CHECK(signals_of(workspace, {}).titles() == std::vector<std::string>{"time", "first.y"});
  CHECK(signals_of(workspace, {"--signals", "second.*", "--signals", "first.u"}).titles() ==
        std::vector<std::string>{"time", "second.u", "second.y", "second.time_constant [s]",
                                 "first.u"});
}

TEST_CASE("--stop and --step choose the communication points") {
  const Workspace workspace(two_filters());
  const Csv signals = signals_of(workspace, {"--stop", "0.5", "--step", "0.125"});
  CHECK(signals.numbers("time") == std::vector<double>{0, 0.125, 0.25, 0.375, 0.5});
  CHECK(signals_of(workspace, {"--stop", "0.3", "--step", "0.125"}).row(3).front() == "0.3");
}

TEST_CASE("a run that ends where it starts has the initial values, and says so") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0"});
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.signals().size() == 1);
  CHECK(outcome.err ==
        "stride: warning: the run ends where it starts, at 0 s, so it has initial values only\n");
}

TEST_CASE("--set changes start values, as the closed form of the low-pass says") {
  const Workspace workspace(one_filter());
  const Csv signals = signals_of(workspace, {"--set", "filter.u=2", "--set",
                                             "filter.time_constant=0.5", "--set", "filter.y=-1"});
  const auto time = signals.numbers("time");
  const auto y = signals.numbers("filter.y");
  REQUIRE(time.size() == 1001);
  for (std::size_t i = 0; i < time.size(); ++i) {
    CAPTURE(time[i]);
    REQUIRE(y[i] == Approx(2 - 3 * std::exp(-time[i] / 0.5)).epsilon(1e-12).margin(1e-12));
  }
  CHECK(y.back() == Approx(2 - 3 * std::exp(-2.0)).epsilon(1e-12));
}

TEST_CASE("the later --set wins, also over the scenario's own parameters") {
  Parts parts = one_filter();
  parts.components = component(
      "filter", "minimal.fmu",
      "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
      "<ssv:ParameterSet xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\" "
      "version=\"2.0\" name=\"p\"><ssv:Parameters><ssv:Parameter name=\"y\">"
      "<ssv:Float64 value=\"5\"/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>"
      "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>");
  const Workspace workspace(parts);
  CHECK(signals_of(workspace, {"--stop", "1"}).numbers("filter.y").front() == 5);
  CHECK(workspace.run({"--stop", "1", "--set", "filter.y=6", "--set", "filter.y=7"}).exit_code ==
        0);
  CHECK(workspace.signals().numbers("filter.y").front() == 7);
}

TEST_CASE("--swap puts another unit in a component's place") {
  const Workspace workspace(two_filters());
  const auto decaying = signals_of(workspace, {"--set", "first.y=1"}).numbers("first.y");
  CHECK(decaying.back() == Approx(std::exp(-1.0)));
  const Csv signals =
      signals_of(workspace, {"--swap", "first=not_a_number.fmu", "--set", "first.nan_at=10"});
  CHECK(signals.numbers("first.y") == signals.numbers("time"));  // what that unit gives
  CHECK(signals.numbers("second.y").back() > 0.3);
  const auto made_from = nlohmann::json::parse(workspace.result("run.json"))["provenance"];
  CHECK(made_from["swaps"] == std::vector<std::string>{"first=not_a_number.fmu"});
  CHECK(made_from["values"] == std::vector<std::string>{"first.nan_at=10"});
}

TEST_CASE("a unit may be an archive, its unpacked folder, or a bare library of the kit") {
  const Workspace workspace(one_filter());
  const Arguments settings{"--set", "filter.u=1"};
  signals_of(workspace, settings);
  const std::string expected = workspace.result("signals.csv");
  const auto with = [&](const std::string& unit) {
    Arguments options = settings;
    options.insert(options.end(), {"--swap", "filter=" + unit});
    signals_of(workspace, options);
    return workspace.result("signals.csv");
  };
  unpack(unit_folder() / "minimal.fmu", workspace / "unpacked");
  CHECK(with("unpacked") == expected);
  CHECK(with(unit_library("minimal")) == expected);
}

TEST_CASE("a unit ends the run") {
  const Workspace workspace(Parts{component("stepper", "stepper.fmu")});
  const Csv signals = signals_of(workspace, {"--set", "stepper.end_at=0.1"});
  CHECK(signals.row(signals.size() - 1).front() == "0.1");
  CHECK(nlohmann::json::parse(workspace.result("run.json"))["outcome"] == "ended by a unit");
}

TEST_CASE("messages are recorded at their instants") {
  const Workspace workspace(Parts{component("stepper", "stepper.fmu")});
  signals_of(workspace, {"--set", "stepper.tick_at=0.3"});
  const Csv events(workspace / "out/events.csv");
  REQUIRE(events.size() == 1);
  CHECK(events.row(0)[0] == "0.3");
  CHECK(events.row(0)[2] == "stepper");
  CHECK(events.row(0)[4] == "sent");
}

TEST_CASE("--verbose shows what units log") {
  const Workspace workspace(Parts{component("warning", "raw")});
  make_raw_fmu(workspace.scratch(), "raw");
  const Outcome outcome = workspace.run({"--quiet", "--stop", "0.001"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: unit 'warning': ") && Contains("it gets hot"));
}

TEST_CASE("an FMU alone takes the names of its variables") {
  const Workspace workspace(two_filters());
  const auto run = [&](const Arguments& further) {
    Arguments arguments{"run", "minimal.fmu", "--quiet", "--stop", "1", "--out", "out"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return workspace.stride(arguments);
  };
  const auto signals = [&](const Arguments& further) {
    const Outcome outcome = run(further);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    return workspace.result("signals.csv");
  };
  const std::string named =
      signals({"--set", "minimal.u=1", "--set-at", "minimal.u=2@0.5", "--signals", "minimal.[uy]"});
  CHECK(signals({"--set", "u=1", "--set-at", "u=2@0.5", "--signals", "[uy]"}) == named);
  CHECK_THAT(run({"--set", "u=1", "--set", "minimal.u=2"}).err,
             Contains("--set minimal.u=2 replaces --set u=1"));
  CHECK_THAT(input_error_of(run({"--set", "time_constnat=1"})),
             Contains("did you mean 'time_constant'?"));
  CHECK_THAT(input_error_of(run({"--set", "minimla.u=1"})), Contains("did you mean 'minimal.u'?"));
  CHECK_THAT(input_error_of(run({"--set-at", "tim_constant=1@0.5"})),
             Contains("did you mean 'minimal.time_constant'?"));
  CHECK_THAT(input_error_of(run({"--force", "u=1@0.5.."})), Contains("it cannot be forced"));
  CHECK_THAT(input_error_of(run({"--signals", "x"})), Contains("'minimal.x' matches no variable"));
}
