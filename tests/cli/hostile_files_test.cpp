// Files that are broken, no files at all, or meant to do harm: exit code 2 and an error that names
// the file, in words of stride's own.
#include <functional>
#include <ostream>

#include <sys/stat.h>
#include <unistd.h>

#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A file that a command reads, and what is to be said about it.
struct Case {
  std::string file;  ///< in the workspace; the error has to name it
  std::function<void(const Workspace&)> make;
  std::string message;
  Arguments command{"check", "test.ssd"};
};

void expect_refusal(const Case& tried, const Workspace& workspace) {
  INFO(tried.file);
  tried.make(workspace);
  const Outcome outcome = workspace.stride(tried.command);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains(tried.file) && Contains(tried.message));
  for (const char* raw : {"json.exception", "filesystem error", "basic_string", "std::", "stoi",
                          "terminate called", "bad_alloc"}) {
    CHECK_THAT(outcome.err, !Contains(raw));
  }
  CHECK(workspace.left_behind().empty());
}

std::function<void(const Workspace&)> text(const std::string& file, const std::string& content) {
  return [=](const Workspace& workspace) { workspace.scratch().write(file, content); };
}
std::function<void(const Workspace&)> fifo(const std::string& file) {
  return [=](const Workspace& workspace) {
    fs::remove(workspace / file);
    REQUIRE(::mkfifo((workspace / file).c_str(), 0600) == 0);
  };
}
std::function<void(const Workspace&)> link(const std::string& file, const std::string& target) {
  return [=](const Workspace& workspace) {
    fs::remove(workspace / file);
    fs::create_symlink(target, workspace / file);
  };
}

std::string with_source(const std::string& source) {
  return scenario_text({component("filter", source)});
}
std::string with_set(const std::string& source) {
  std::string scenario = scenario_text(two_filters());
  return scenario.insert(scenario.find("<ssd:Connections>"),
                         "<ssd:ParameterBindings><ssd:ParameterBinding source=\"" + source +
                             "\"/></ssd:ParameterBindings>\n");
}
std::string parameter_set(const std::string& value) {
  return "<ssv:ParameterSet version=\"2.0\" name=\"p\"\n"
         " xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">\n"
         "<ssv:Parameters><ssv:Parameter name=\"first.time_constant\">\n" +
         value + "</ssv:Parameter></ssv:Parameters></ssv:ParameterSet>\n";
}
std::string half(const std::string& content) { return content.substr(0, content.size() / 2); }
std::string repeated(const std::string& piece, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += piece;
  return all;
}

const std::string kLongName(300, 'n');

std::vector<Case> scenarios() {
  const std::string good = scenario_text(two_filters());
  return {
      {"test.ssd", text("test.ssd", ""), "the file holds nothing"},
      {"test.ssd:", text("test.ssd", half(good)), "this is not well-formed XML"},
      {"test.ssd", text("test.ssd", repeated("<a>", 100'000)), "more than 100 elements inside"},
      {"test.ssd:1: ", text("test.ssd", "<a x='1' x='2'/>"), "malformed or doubled attribute"},
      {"test.ssd", text("test.ssd", std::string("\0\0\0", 3)), "a NUL character"},
      {"test.ssd", fifo("test.ssd"), "this is a FIFO, not a regular file"},
      {"test.ssd", link("test.ssd", "/dev/zero"), "this is a device, not a regular file"},
      {"test.ssd", link("test.ssd", "test.ssd"), "cannot read the file"},
      {kLongName, text("x", ""), "File name too long", {"check", kLongName}},
      {"x/test.ssd", link("x", "x"), "cannot read the file", {"run", "x/test.ssd"}},
  };
}

std::vector<Case> files_of_scenarios() {
  const auto set = [](const std::string& content) {
    return [=](const Workspace& workspace) {
      text("test.ssd", with_set("p.ssv"))(workspace);
      text("p.ssv", content)(workspace);
    };
  };
  const auto named = [](const std::string& source) { return text("test.ssd", with_set(source)); };
  const auto both = [](auto first, auto second) {
    return [=](const Workspace& workspace) {
      first(workspace);
      second(workspace);
    };
  };
  return {
      {"/dev/zero", named("file:///dev/zero"), "this is a device, not a regular file"},
      {"p.ssv", both(named("p.ssv"), fifo("p.ssv")), "this is a FIFO, not a regular file"},
      {"p.ssv", both(named("p.ssv"), link("p.ssv", "p.ssv")), "cannot reach the parameter set"},
      {kLongName, named(kLongName), "File name too long"},
      {"p.ssv", set(""), "the file holds nothing"},
      {"p.ssv:", set(half(parameter_set("<ssv:Real value=\"1\"/>"))), "not well-formed"},
      {"p.ssv:4: ", set(parameter_set("<ssv:Real value=\"abc\"/>")), "expected a Float64 number"},
      {"p.ssv:4: ", set(parameter_set("<ssv:Real value=\"1 2\"/>")), "expected one Float64 value"},
      {"p.ssv:4: ", set(parameter_set("<ssv:Real value=\"1e999\"/>")), "within the range"},
      {"/dev/zero", text("test.ssd", with_source("file:///dev/zero")), "this is a device"},
      {"x.fmu", both(text("test.ssd", with_source("x.fmu")), fifo("x.fmu")), "this is a FIFO"},
      {"x.fmu", both(text("test.ssd", with_source("x.fmu")), text("x.fmu", "PK")), "not a zip"},
      {"x.ssd", both(text("test.ssd", with_source("x.ssd")), fifo("x.ssd")), "this is a FIFO"},
      {"--set first.u=abc",
       text("x", ""),
       "expected a Float64 number",
       {"check", "test.ssd", "--set", "first.u=abc"}},
      {"--set first.u=1 2",
       text("x", ""),
       "expected one Float64 value",
       {"check", "test.ssd", "--set", "first.u=1 2"}},
  };
}

std::vector<Case> units() {
  const auto folder = [](const std::string& content) {
    return text("x/modelDescription.xml", content);
  };
  const std::string variables =
      "<Float64 name=\"u\" valueReference=\"1\" causality=\"input\" start=\"abc\"/>\n";
  return {
      {"x.fmu", fifo("x.fmu"), "this is a FIFO", {"inspect", "x.fmu"}},
      {"x.so", fifo("x.so"), "this is a FIFO", {"pack", "x.so", "-o", "x.fmu"}},
      {"x.csv", fifo("x.csv"), "this is a FIFO", {"pack", "x.csv", "-o", "x.fmu"}},
      {"x.xml", fifo("x.xml"), "this is a FIFO", {"pack", "x.xml", "-o", "x.fmu"}},
      {"x", fifo("x"), "this is a FIFO", {"pack", "x", "-o", "x.fmu"}},
      {"x.fmu", link("x.fmu", "x.fmu"), "leads back to itself", {"verify", "x.fmu"}},
      {kLongName, text("x", ""), "there is no unit", {"inspect", kLongName}},
      {"x/modelDescription.xml",
       folder(half(description_text("x"))),
       "not well-formed",
       {"inspect", "x"}},
      {"x/modelDescription.xml:5: ",
       folder(description_text("x", "", variables)),
       "the start value of 'u': 'abc' is not a value for it, expected a Float64 number",
       {"inspect", "x"}},
      {"x/modelDescription.xml",
       [](const Workspace& workspace) {
         fs::create_directory(workspace / "x");
         fifo("x/modelDescription.xml")(workspace);
       },
       "this is a FIFO",
       {"inspect", "x"}},
      {"x.ssp", text("x.ssp", "PK\x03\x04 and no more"), "is damaged", {"check", "x.ssp"}},
  };
}

std::vector<Case> results() {
  const Arguments report{"report", "out"};
  const auto with_signals = [](const std::string& content) {
    return text("out/signals.csv", content);
  };
  return {
      {"out/signals.csv:2: ", with_signals("time,a\nx,0\n"), "column 'time'", report},
      {"out/signals.csv:2: ", with_signals("time,a\n1e999,0\n"), "column 'time'", report},
      {"out/signals.csv:2: ", with_signals("time,a\n0\n"), "", report},
      {"out/signals.csv:1: ", with_signals("\"time\"x,a\n"), "quotation mark", report},
      {"in.vcd", text("in.vcd", "$scope"), "the file ends", {"trace", "info", "in.vcd"}},
      {"/dev/zero", text("x", ""), "longer than any word", {"trace", "info", "/dev/zero"}},
      {kLongName, text("x", ""), "File name too long", {"trace", "info", kLongName}},
  };
}

/// Whether a test cannot run, since root may read everything; CI runs as root.
bool is_root() {
  if (::geteuid() != 0) return false;
  WARN("SKIPPED: root can read each file");
  return true;
}

}  // namespace

TEST_CASE("a broken scenario, or what is none") {
  for (const Case& tried : scenarios()) expect_refusal(tried, Workspace(two_filters()));
}

TEST_CASE("a broken file that a scenario names, or what is none") {
  for (const Case& tried : files_of_scenarios()) expect_refusal(tried, Workspace(two_filters()));
}

TEST_CASE("a broken unit, or what is none") {
  for (const Case& tried : units()) expect_refusal(tried, Workspace(two_filters()));
}

TEST_CASE("broken results and traces, or what is none") {
  for (const Case& tried : results()) expect_refusal(tried, Workspace(two_filters()));
}

TEST_CASE("a file that may not be read") {
  if (is_root()) return;
  expect_refusal(
      {"test.ssd",
       [](const Workspace& workspace) { fs::permissions(workspace / "test.ssd", fs::perms::none); },
       "Permission denied"},
      Workspace(two_filters()));
}

TEST_CASE("a package that names a device is refused at once") {
  const Workspace workspace(with_set("file:///dev/zero"));
  make_zip(workspace / "x.ssp", {{"SystemStructure.ssd", with_set("file:///dev/zero")}});
  const Outcome outcome = workspace.stride({"run", "x.ssp", "--out", "out"});
  CHECK_THAT(input_error_of(outcome), Contains("/dev/zero: this is a device, not a regular file"));
}

TEST_CASE("a folder that a link in it leads back to is not packed") {
  const Workspace workspace(two_filters());
  fs::create_directories(workspace / "resources/a");
  fs::create_directory_symlink("..", workspace / "resources/a/up");
  const Outcome outcome = workspace.stride({"pack", (unit_folder() / "minimal.fmu").string(),
                                            "--resources", "resources", "-o", "x.fmu"});
  CHECK_THAT(input_error_of(outcome), Contains("up: this link leads to a folder that it is in"));
  CHECK_FALSE(fs::exists(workspace / "x.fmu"));
}
