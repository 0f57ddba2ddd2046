// A program as an importer sees it.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <sys/wait.h>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"
#include "tests/units/process/program.h"
#include "tests/units/resource_folder.h"

using namespace stride::tests;
using Catch::Contains;

namespace fs = std::filesystem;

namespace {

const UnitLibrary& library() {
  static const UnitLibrary only(unit_library("process"));
  return only;
}

/// The cistern in C++, in a folder of its own.
struct Cistern {
  Cistern() {
    const fs::path program = cistern_program();
    fs::copy_file(program, folder / "cistern");
    fs::copy_file(program.parent_path() / "cistern.xml", folder / "process.xml");
  }
  std::string path() const { return (folder / "").string(); }
  ScratchFolder folder;
};

/// A program of the shell with an output y.
std::string scripted(const std::string& script, const std::string& attributes = "") {
  std::string text;
  for (const char c : script)
    text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return "<process version=\"1\" " + attributes +
         ">\n<program name=\"sh\"/><argument text=\"-c\"/>\n<argument text=\"" + text +
         "\"/>\n<input name=\"u\" type=\"Float64\"/>\n<output name=\"y\" type=\"Float64\"/>\n"
         "<message-output name=\"out.text\" type=\"String\"/>\n</process>\n";
}

std::string start_answer() {
  return answer("start", "<output name=\"y\" value=\"1\"/>\n<sync time=\"0\"/>");
}

InstanceChoices choices_with(const std::string& resources) {
  InstanceChoices choices;
  choices.resources = resources;
  choices.early_return = true;
  choices.logging = true;
  return choices;
}

struct Scripted {
  explicit Scripted(const std::string& script, const std::string& attributes = "")
      : resources("process.xml", scripted(script, attributes)),
        unit(library(), choices_with(resources.path())) {}
  ResourceFolder resources;
  UnitInstance unit;
};

std::string string_of(UnitInstance& unit, const std::string& name) {
  const fmi3ValueReference r = unit.reference(name);
  fmi3String value = nullptr;
  if (unit.fmi.GetString(unit.handle, &r, 1, &value, 1) != fmi3OK) {
    throw std::runtime_error(unit.last_message());
  }
  return value;
}

fmi3Status set_string(UnitInstance& unit, const std::string& name, const char* value) {
  const fmi3ValueReference r = unit.reference(name);
  return unit.fmi.SetString(unit.handle, &r, 1, &value, 1);
}

bool has_child_left() {
  siginfo_t info{};
  return ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0;
}

}  // namespace

TEST_CASE("the table is that of the declaration") {
  const Cistern cistern;
  const std::string xml = library().describe(cistern.path());
  CHECK(attribute(xml, "name=\"volume\"", "unit") == "m3");
  CHECK(attribute(xml, "name=\"alarms\"", "variability") == "discrete");
  CHECK(attribute(xml, "name=\"capacity\"", "start") == "1");
  CHECK(attribute(xml, "name=\"report_period\"", "min") == "0.001");
  CHECK(attribute(xml, "name=\"alarm.text\"", "clocks") ==
        attribute(xml, "name=\"alarm.clock\"", "valueReference"));
  CHECK_THAT(xml, Contains("A cistern that sends an alarm when it is full"));
  CHECK_THROWS_WITH(library().describe(), Contains("stride pack"));
  CHECK_THAT(
      library().describe((fs::path(STRIDE_SOURCE_DIR) / "units/process/resources/").string()),
      Contains("<Float64 name=\"volume\""));
}

TEST_CASE("steps, an event at its own instant, and what comes next") {
  const Cistern cistern;
  UnitInstance unit(library(), choices_with(cistern.path()));
  REQUIRE(unit.handle != nullptr);
  REQUIRE(unit.set_real("capacity", 0.25) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.has_next_event);
  CHECK(unit.next_event == 0.5);
  REQUIRE(unit.set_real("inflow", 1) == fmi3OK);
  REQUIRE(unit.step(0, 0.125) == fmi3OK);
  CHECK_FALSE(unit.last.event);
  CHECK(unit.real("volume") == 0.125);

  REQUIRE(unit.step(0.125, 0.5) == fmi3OK);
  CHECK(unit.last.early);
  CHECK(unit.last.event);
  CHECK(unit.last.reached == 0.25);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  CHECK(unit.clock("alarm.clock"));
  CHECK_FALSE(unit.clock("report.clock"));
  CHECK(string_of(unit, "alarm.text") == "full with 0.25 m3");
  REQUIRE(unit.update() == fmi3OK);
  CHECK_FALSE(unit.iterate);
  REQUIRE(unit.fmi.EnterStepMode(unit.handle) == fmi3OK);

  // at the announced event it reports, and says what is next
  REQUIRE(unit.step(0.25, 0.25) == fmi3OK);
  CHECK_FALSE(unit.last.early);
  CHECK(unit.last.event);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  CHECK(unit.clock("report.clock"));
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.next_event == 1.0);
  CHECK(unit.fmi.Terminate(unit.handle) == fmi3OK);
}

TEST_CASE("a message is handed over at its instant") {
  const Cistern cistern;
  UnitInstance unit(library(), choices_with(cistern.path()));
  REQUIRE(unit.set_real("inflow", 1) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 0.25) == fmi3OK);
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  REQUIRE(unit.set_clock("order.clock", true) == fmi3OK);
  REQUIRE(set_string(unit, "order.text", "empty") == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.real("volume") == 0);
  REQUIRE(unit.set_clock("order.clock", true) == fmi3OK);
  REQUIRE(set_string(unit, "order.text", "<dance & \"sing\">") == fmi3OK);
  REQUIRE(unit.update() == fmi3OK);
  CHECK(unit.last_message() == "what is '<dance & \"sing\">'? Expected 'empty'");
  CHECK(unit.message_statuses.back() == fmi3Warning);
}

TEST_CASE("messages that could not stop the step come one after another, with one warning") {
  const Cistern cistern;
  InstanceChoices choices = choices_with(cistern.path());
  choices.early_return = false;
  UnitInstance unit(library(), choices);
  REQUIRE(unit.set_real("inflow", 1) == fmi3OK);
  REQUIRE(unit.set_real("capacity", 0.75) == fmi3OK);
  REQUIRE(unit.start_steps() == fmi3OK);
  REQUIRE(unit.step(0, 1) == fmi3OK);
  CHECK_FALSE(unit.last.early);
  CHECK_THAT(unit.last_message(),
             Contains("'report.text' of 0.5") && Contains("at the end of the step only"));
  REQUIRE(unit.fmi.EnterEventMode(unit.handle) == fmi3OK);
  std::vector<std::string> texts;
  for (bool goes_on = true; goes_on; goes_on = unit.iterate) {
    if (unit.clock("alarm.clock")) texts.push_back(string_of(unit, "alarm.text"));
    if (unit.clock("report.clock")) texts.push_back(string_of(unit, "report.text"));
    REQUIRE(unit.update() == fmi3OK);
    if (!unit.iterate) break;
  }
  CHECK(texts == std::vector<std::string>{"0.5 m3", "full with 0.75 m3", "0.75 m3"});
}

TEST_CASE("the program begins anew where its inputs change before the start, and only there") {
  const ScratchFolder folder;
  const std::string count = (folder / "count").string();
  Scripted scripted("echo x >> " + count + "; " + start_answer() + "cat > /dev/null");
  UnitInstance& unit = scripted.unit;
  const auto starts = [&] {
    std::ifstream file(count);
    std::size_t lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines;
  };
  REQUIRE(unit.fmi.EnterInitializationMode(unit.handle, false, 0, 0, false, 0) == fmi3OK);
  CHECK(unit.real("y") == 1);
  CHECK(starts() == 1);
  REQUIRE(unit.set_real("u", 0) == fmi3OK);  // what it is already
  CHECK(unit.real("y") == 1);
  CHECK(starts() == 1);
  REQUIRE(unit.set_real("u", -0.0) == fmi3OK);
  REQUIRE(unit.fmi.ExitInitializationMode(unit.handle) == fmi3OK);
  CHECK(starts() == 2);
  CHECK(unit.fmi.Terminate(unit.handle) == fmi3OK);
}

TEST_CASE("what a program does wrong is an error that names it, and the program is gone") {
  const auto [script, expected] = GENERATE(table<std::string, std::string>({
      {start_answer() + "exit 3", "ended with the exit code 3 while it was to make a step"},
      {start_answer() + answer("step", "<sync time=0/>") + "cat",
       "column 12: expected a value in quotation marks"},
      {start_answer() + "kill -KILL $$", "was killed by signal 9 (SIGKILL)"},
      {start_answer() + "echo 'no more ideas' >&2; exit 1", "no more ideas"},
      {start_answer() + "exec sleep 1000", "wrote nothing for 2000 ms"},
  }));
  Scripted scripted(script);
  UnitInstance& unit = scripted.unit;
  if (expected.find("nothing") != std::string::npos) {
    REQUIRE(unit.set_real("process.time_limit", 2) == fmi3OK);
  }
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(unit.step(0, 1) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("the program 'sh -c' ") && Contains(expected));
  CHECK_FALSE(has_child_left());
}

TEST_CASE("a program that cannot be started") {
  Scripted scripted(start_answer());
  UnitInstance& unit = scripted.unit;
  REQUIRE(set_string(unit, "process.program", "no-such-program") == fmi3OK);
  CHECK(unit.start_steps() == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("cannot start 'no-such-program'"));
}

TEST_CASE("an end that is not a good one is an error") {
  Scripted scripted(start_answer() + answer("end", "") + "exit 5");
  REQUIRE(scripted.unit.start_steps() == fmi3OK);
  CHECK(scripted.unit.fmi.Terminate(scripted.unit.handle) == fmi3Error);
  CHECK_THAT(scripted.unit.last_message(), Contains("the exit code 5 at the end of the run"));
}

TEST_CASE("what a program says on its way to the end is heard, its error first") {
  const std::string farewell = "<log level=\"warning\" text=\"bye\"/>";
  Scripted good(start_answer() + answer("end", farewell));
  REQUIRE(good.unit.start_steps() == fmi3OK);
  CHECK(good.unit.fmi.Terminate(good.unit.handle) == fmi3OK);
  CHECK_THAT(good.unit.last_message(), Contains("bye"));
  Scripted bad(start_answer() + answer("end", farewell) +
               "echo '<error text=\"no ink\"/>'; exit 1");
  REQUIRE(bad.unit.start_steps() == fmi3OK);
  CHECK(bad.unit.fmi.Terminate(bad.unit.handle) == fmi3Error);
  CHECK_THAT(bad.unit.last_message(), Contains("the program 'sh -c' fails: no ink"));
}

TEST_CASE("a program may request the end of the simulation") {
  Scripted scripted(start_answer() + answer("step", "<sync time=\"1000000000000\" end=\"true\"/>") +
                    "cat > /dev/null");
  REQUIRE(scripted.unit.start_steps() == fmi3OK);
  REQUIRE(scripted.unit.step(0, 1) == fmi3OK);
  CHECK(scripted.unit.last.terminate);
}

TEST_CASE("arrays are read and written as a whole") {
  ResourceFolder resources(
      "process.xml",
      "<process version=\"1\">\n<program name=\"sh\"/><argument file=\"echo.sh\"/>\n"
      "<input name=\"u\" type=\"Float64\" dimensions=\"2 2\"/>\n"
      "<output name=\"y\" type=\"Float64\" dimensions=\"2 2\" depends-on=\"u\"/>\n</process>\n");
  std::ofstream(fs::path(resources.path()) / "echo.sh")
      << "while read -r line; do case $line in\n"
         "'<input'*) u=$(echo \"$line\" | sed 's/.*value=.\\(.*\\).\\/>/\\1/');;\n"
         "'<start'*) printf '%s\\n' \"<output name='y' value='$u'/>\" \"<sync time='0'/>\";;\n"
         "esac; done\n";
  UnitInstance unit(library(), choices_with(resources.path()));
  CHECK_THAT(library().describe(resources.path()), Contains("<Dimension start=\"2\"/>"));
  const fmi3ValueReference u = unit.reference("u");
  const fmi3ValueReference y = unit.reference("y");
  const double set[] = {0.5, -1, 1e300, 4};
  double got[4] = {};
  REQUIRE(unit.fmi.EnterInitializationMode(unit.handle, fmi3False, 0, 0, fmi3False, 0) == fmi3OK);
  REQUIRE(unit.fmi.SetFloat64(unit.handle, &u, 1, set, 4) == fmi3OK);
  REQUIRE(unit.fmi.GetFloat64(unit.handle, &y, 1, got, 4) == fmi3OK);
  CHECK(std::equal(set, set + 4, got));
}

TEST_CASE("standard error is the log") {
  Scripted scripted("echo 'warming up' >&2; sleep 0.05; " + start_answer() + "cat > /dev/null");
  REQUIRE(scripted.unit.start_steps() == fmi3OK);
  REQUIRE_FALSE(scripted.unit.messages.empty());
  CHECK(scripted.unit.messages.front() == "warming up");
  CHECK(scripted.unit.message_categories.front() == "logEvents");
}

TEST_CASE("no program outlives its unit") {
  for (int i = 0; i < 3; ++i) {
    Scripted scripted(start_answer() + "exec sleep 1000");
    REQUIRE(scripted.unit.start_steps() == fmi3OK);
    CHECK(has_child_left());
    if (i == 1) CHECK(scripted.unit.fmi.Reset(scripted.unit.handle) == fmi3OK);
    if (i == 1) CHECK_FALSE(has_child_left());
  }
  CHECK_FALSE(has_child_left());
}

TEST_CASE("the unit has no state, and declares none") {
  const Cistern cistern;
  const std::string xml = library().describe(cistern.path());
  CHECK(attribute(xml, "<CoSimulation", "canGetAndSetFMUState") != "true");
}
