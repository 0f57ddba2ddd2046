// Outputs that the command line names replace neither inputs nor results.
#include <map>

#include <sys/stat.h>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const std::string kParameters =
    "<ssv:ParameterSet version=\"2.0\" name=\"p\"\n"
    " xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">\n"
    "<ssv:Parameters><ssv:Parameter name=\"first.time_constant\"><ssv:Real value=\"2\"/>"
    "</ssv:Parameter></ssv:Parameters></ssv:ParameterSet>\n";

/// Two filters, the first one from a file beside the scenario, with parameters in p.ssv.
std::string scenario_of_files() {
  std::string text =
      scenario_text({component("first", "mine.fmu") + component("second", "minimal.fmu"),
                     connection("first.y", "second.u")});
  return text.insert(text.find("<ssd:Connections>"),
                     "<ssd:ParameterBindings><ssd:ParameterBinding source=\"p.ssv\"/>"
                     "</ssd:ParameterBindings>\n");
}

struct FilesWorkspace : Workspace {
  FilesWorkspace() : Workspace(scenario_of_files()) {
    scratch().write("p.ssv", kParameters);
    const Outcome packed = stride({"pack", unit_library("minimal").string(), "-o", "mine.fmu"});
    REQUIRE(packed.exit_code == 0);
  }
};

/// What is in the scratch folder, apart from temporary files.
std::map<std::string, std::string> contents(const Workspace& workspace) {
  std::map<std::string, std::string> contents;
  const fs::path folder = workspace.scratch().path();
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (name.rfind("tmp", 0) == 0) continue;
    contents[name] = entry.is_regular_file() ? read(entry.path()) : "";
  }
  return contents;
}

/// The message of a command that changes nothing.
std::string refusal_of(const Workspace& workspace, const Arguments& command) {
  const auto before = contents(workspace);
  const std::string message = input_error_of(workspace.stride(command));
  CHECK(contents(workspace) == before);
  return message;
}

}  // namespace

TEST_CASE("a run writes no capture and no test report over what it reads") {
  const FilesWorkspace workspace;
  fs::create_symlink("test.ssd", workspace / "link.xml");
  fs::create_hard_link(workspace / "test.ssd", workspace / "twin.xml");
  const std::map<std::string, std::string> files{
      {"test.ssd", "the scenario"},           {"./tmp/../test.ssd", "the scenario"},
      {"link.xml", "the scenario"},           {"twin.xml", "the scenario"},
      {"mine.fmu", "a unit of the scenario"}, {"p.ssv", "a file of the scenario"}};
  for (const auto& [file, what] : files) {
    CAPTURE(file);
    for (const Arguments& option : {Arguments{"--junit", file}, {"--capture", "first=" + file}}) {
      CHECK_THAT(
          refusal_of(workspace, Workspace::run_arguments(option)),
          Contains(option[0] + " " + option[1] + ": this is " + what) && Contains("hint: choose"));
    }
  }
}

TEST_CASE("nor where the name of the component holds a '='") {
  const Workspace workspace(Parts{component("a=b", "minimal.fmu")});
  CHECK_THAT(refusal_of(workspace, Workspace::run_arguments({"--capture", "a=b=test.ssd"})),
             Contains("--capture a=b=test.ssd: this is the scenario"));
}

TEST_CASE("nor over the unit that replaces one of the scenario's") {
  const FilesWorkspace workspace;
  fs::copy_file(workspace / "mine.fmu", workspace / "other.fmu");
  CHECK_THAT(refusal_of(workspace, Workspace::run_arguments(
                                       {"--swap", "second=other.fmu", "--junit", "other.fmu"})),
             Contains("--junit other.fmu: this is a unit of the scenario"));
}

TEST_CASE("nor over a scenario that cannot be read") {
  const Workspace workspace(std::string("<no scenario"));
  CHECK_THAT(refusal_of(workspace, Workspace::run_arguments({"--junit", "test.ssd"})),
             Contains("--junit test.ssd: this is the scenario"));
}

TEST_CASE("nor over its results, whether they exist or not") {
  Parts parts = two_filters();
  parts.annotation = "<stride:Results signals=\"values.csv\"/>";
  const Workspace workspace(parts);
  const bool is_repeated = GENERATE(false, true);
  if (is_repeated) REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  for (const std::string name : {"run.json", "values.csv", "report.html", "../out/run.json"}) {
    CAPTURE(name);
    const std::string file = "out/" + name;
    for (const Arguments& option : {Arguments{"--junit", file}, {"--capture", "first=" + file}}) {
      CHECK_THAT(refusal_of(workspace, Workspace::run_arguments(option)),
                 Contains(option[0] + " " + option[1] + ": this is a file of the results"));
    }
  }
}

TEST_CASE("a capture and the test report are different files") {
  const Workspace workspace(two_filters());
  CHECK_THAT(
      refusal_of(workspace, Workspace::run_arguments({"--capture", "first=x", "--junit", "./x"})),
      Contains("--capture first=x and --junit ./x name the same file") && Contains("hint:"));
  fs::create_symlink("x", workspace / "y");
  CHECK_THAT(refusal_of(workspace, Workspace::run_arguments(
                                       {"--capture", "first=x", "--capture", "second=y"})),
             Contains("--capture first=x and --capture second=y name the same file"));
}

TEST_CASE("a device may be named for several outputs, and an earlier output again") {
  const Workspace workspace(two_filters());
  CHECK(workspace.run({"--quiet", "--capture", "first=/dev/null", "--junit", "/dev/null"})
            .exit_code == 0);
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome =
        workspace.run({"--quiet", "--capture", "first=out/first.csv", "--junit", "out/junit.xml"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err == "");
  }
}

TEST_CASE("--junit needs the name of a file") {
  const Workspace workspace(two_filters());
  CHECK_THAT(refusal_of(workspace, Workspace::run_arguments({"--junit", ""})),
             Contains("--junit: no file is named"));
}

TEST_CASE("complete replaces the scenario at most") {
  const FilesWorkspace workspace;
  CHECK_THAT(refusal_of(workspace, {"complete", "test.ssd", "-o", "p.ssv"}),
             Contains("--output p.ssv: this is a file of the scenario"));
  CHECK_THAT(refusal_of(workspace, {"complete", "test.ssd", "-o", "mine.fmu"}),
             Contains("--output mine.fmu: this is a unit of the scenario"));
  CHECK(workspace.stride({"complete", "test.ssd", "-o", "test.ssd"}).exit_code == 0);
  CHECK_THAT(read(workspace / "test.ssd"), Contains("<ssd:Connector name=\"u\""));
}

TEST_CASE("report replaces the page at most") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  for (const std::string name : {"signals.csv", "run.json"}) {
    CHECK_THAT(refusal_of(workspace, {"report", "out", "-o", "out/" + name}),
               Contains("--output out/" + name + ": this is a file of the results"));
  }
  CHECK_THAT(refusal_of(workspace, {"report", "out", "-o", "out/units/first/page.html"}),
             Contains("the file is in the folder of the files of units"));
}

TEST_CASE("a results file replaces nothing that the run reads") {
  const FilesWorkspace workspace;
  for (const auto& [signals, what] :
       {std::pair<std::string, std::string>{"test.ssd", "the scenario"},
        {"p.ssv", "a file of the scenario"},
        {"mine.fmu", "a unit of the scenario"}}) {
    std::string scenario = scenario_of_files();
    scenario.insert(scenario.find("</stride:Scenario>"),
                    "<stride:Results signals=\"" + signals + "\"/>");
    workspace.scratch().write("test.ssd", scenario);
    CHECK_THAT(refusal_of(workspace, {"run", "test.ssd", "--out", "."}),
               Contains(signals + " in the results folder .: this is " + what));
  }
}

TEST_CASE("results do not go into a unit that is a folder") {
  const Workspace workspace(Parts{component("a", "raw")});
  make_raw_fmu(workspace.scratch(), "raw");
  CHECK_THAT(refusal_of(workspace, {"run", "test.ssd", "--out", "raw/resources"}),
             Contains("in the results folder raw/resources: this is in a unit of the scenario"));
}

TEST_CASE("a package replaces nothing that is packed") {
  const FilesWorkspace workspace;
  fs::copy_file(unit_library("minimal"), workspace / "minimal.so");
  CHECK_THAT(refusal_of(workspace, {"pack", "minimal.so", "-o", "./minimal.so"}),
             Contains("--output ./minimal.so: this is what is to be packed"));
  fs::create_symlink("mine.fmu", workspace / "link.ssp");
  CHECK_THAT(refusal_of(workspace, {"pack", "test.ssd", "-o", "link.ssp"}),
             Contains("--output link.ssp: this is a unit of the scenario"));
}

TEST_CASE("a pipe that no program reads is no output") {
  const Workspace workspace(two_filters());
  REQUIRE(::mkfifo((workspace / "pipe").c_str(), 0600) == 0);
  for (const Arguments& option : {Arguments{"--junit", "pipe"}, {"--capture", "first=pipe"}}) {
    CHECK_THAT(input_error_of(workspace.run(option)),
               Contains("this is a pipe (FIFO) that no program reads"));
  }
  CHECK_THAT(input_error_of(workspace.stride({"complete", "test.ssd", "-o", "pipe"})),
             Contains("this is a pipe (FIFO) that no program reads"));
}

TEST_CASE("a test report into a pipe is one") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.run({"--quiet", "--junit", "/dev/stdout"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.find("<testsuites") == outcome.out.rfind("<testsuites"));
  CHECK_THAT(outcome.out, !Contains("the run has not ended"));
}

TEST_CASE("a test report that cannot be written is an error before the run") {
  const Workspace workspace(two_filters());
  fs::create_directory(workspace / "folder");
  const std::string file = GENERATE("folder", "/proc/none/x");
  const Outcome outcome = workspace.run({"--quiet", "--junit", file});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains(file));
  CHECK_FALSE(fs::exists(workspace / "out/run.json"));
}

TEST_CASE("results may have names as long as the file system allows, and longer ones are refused") {
  const std::string longest(255, 'x');
  const auto scenario = [](const std::string& name) {
    Parts parts = two_filters();
    parts.annotation = "<stride:Results statistics=\"" + name + "\"/>\n";
    return parts;
  };
  const Workspace workspace(scenario(longest));
  CHECK(workspace.run({"--quiet", "--junit", std::string(254, 'y')}).exit_code == 0);
  CHECK_THAT(workspace.result(longest), Contains("\"outcome\": \"completed\""));
  const Workspace beyond(scenario(longest + "x"));
  CHECK_THAT(input_error_of(beyond.run({"--quiet"})), Contains("has 256 bytes, and 255 at most"));
  CHECK_FALSE(fs::exists(beyond / "out/signals.csv"));
}
