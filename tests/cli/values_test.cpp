// Values of units that cannot be read: the unit, the variable and the time are named, in process
// and hosted.
#include "master/base/text/readable_text.h"
#include "tests/build.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

constexpr const char* kRawValues =
    "<String name=\"text\" valueReference=\"1\" causality=\"output\" variability=\"discrete\"/>\n"
    "<Binary name=\"bytes\" valueReference=\"2\" causality=\"output\" variability=\"discrete\"/>\n";
constexpr const char* kRawOutputs =
    "<ModelStructure><Output valueReference=\"1\"/><Output valueReference=\"2\"/>"
    "</ModelStructure>";

/// One unit without a kit; its name says how it misbehaves (tests/test_units/raw/unit.c).
struct RawUnit : Workspace {
  RawUnit(const std::string& name, bool has_values, const std::string& annotation = "")
      : Workspace(Parts{component(name, "raw"), "", annotation}) {
    make_raw_fmu(scratch(), "raw");
    if (has_values) declare_values();
  }

  void declare_values() const;
};

void RawUnit::declare_values() const {
  std::string text =
      description_text("raw", "canHandleVariableCommunicationStepSize=\"true\"", kRawValues);
  const std::string none = "<ModelStructure/>";
  text.replace(text.find(none), none.size(), kRawOutputs);
  scratch().write("raw/modelDescription.xml", text);
}

Outcome run_raw_unit(const Workspace& workspace, bool is_hosted, const std::string& signals) {
  Arguments arguments{"--quiet", "--step", "0.125"};
  if (!signals.empty()) arguments.insert(arguments.end(), {"--signals", "*." + signals});
  if (is_hosted) arguments.emplace_back("--isolate");
  return workspace.run(arguments);
}

}  // namespace

TEST_CASE("a value that cannot be read is an error with the unit, the variable and the time") {
  struct Fault {
    const char *unit, *variable, *in_process, *hosted;
  };
  constexpr Fault kFaults[] = {
      {"astray", "text", "signal 11 (SIGSEGV) ends stride in fmi3GetString",
       "its process was ended by signal 11 (SIGSEGV) in fmi3GetString"},
      {"huge", "bytes",
       "fmi3GetBinary gave 18446744073709551615 bytes; 256 MiB at most are possible", nullptr},
      {"large", "bytes", "fmi3GetBinary gave 1099511627776 bytes; 256 MiB at most are possible",
       nullptr},
  };
  for (const auto& [unit, variable, in_process, hosted] : kFaults) {
    for (const bool is_hosted : {true, false}) {
      if (kSanitized && !is_hosted && hosted != nullptr) continue;
      INFO(unit << (is_hosted ? ", hosted" : ""));
      const RawUnit workspace(unit, true);
      const Outcome outcome = run_raw_unit(workspace, is_hosted, variable);
      INFO(outcome.err);
      CHECK(outcome.exit_code == 1);
      const std::string end = is_hosted && hosted != nullptr ? hosted : in_process;
      CHECK_THAT(outcome.err, Contains("unit '" + std::string(unit) + "', variable '" + variable +
                                       "', at 0.375 s: " + end));
      CHECK(last_time(workspace) == "0.25");
      CHECK(run_json(workspace)["outcome"] == "failed");
    }
  }
}

TEST_CASE("no text where there has to be one is an empty one, with a warning") {
  const bool is_hosted = GENERATE(false, true);
  const RawUnit workspace("mute", true);
  const Outcome outcome = run_raw_unit(workspace, is_hosted, "text");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err ==
        "stride: warning: unit 'mute': fmi3GetString gave no text (NULL) for 'text', which FMI "
        "forbids; it is taken as an empty one, here and later\n");
}

TEST_CASE("a text that is not UTF-8 is said once, and is UTF-8 in all files") {
  const bool is_hosted = GENERATE(false, true);
  const RawUnit workspace("latin", true);
  const Outcome outcome = run_raw_unit(workspace, is_hosted, "text");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err ==
        "stride: warning: unit 'latin': at 0.375 s the text of 'text' is not UTF-8, which FMI "
        "demands: \"caf\uFFFD\"; other units get its bytes, and files U+FFFD for each that is not "
        "of a character, here and later\n");
  const std::string signals = workspace.result("signals.csv");
  CHECK(stride::core::is_utf8(signals));
  CHECK_THAT(signals, Contains("0.375,\"caf\uFFFD\"\n"));
  CHECK(stride::core::is_utf8(workspace.result("run.json")));
  CHECK(stride::core::is_utf8(workspace.result("trace.vcd")));
}

namespace {

/// With an Enumeration among its outputs that has the items 0 and 1.
struct EnumerationUnit : RawUnit {
  explicit EnumerationUnit(const std::string& name) : RawUnit(name, false) {
    std::string text =
        description_text("raw", "canHandleVariableCommunicationStepSize=\"true\"",
                         "<Enumeration name=\"mode\" valueReference=\"1\" causality=\"output\" "
                         "declaredType=\"Mode\"/>\n");
    replace(text, "<ModelStructure/>",
            "<ModelStructure><Output valueReference=\"1\"/></ModelStructure>");
    replace(text, "<ModelVariables>",
            "<TypeDefinitions><EnumerationType name=\"Mode\"><Item name=\"off\" value=\"0\"/>"
            "<Item name=\"on\" value=\"1\"/></EnumerationType></TypeDefinitions>\n"
            "<ModelVariables>");
    scratch().write("raw/modelDescription.xml", text);
  }

  static void replace(std::string& text, const std::string& before, const std::string& after) {
    text.replace(text.find(before), before.size(), after);
  }
};

}  // namespace

TEST_CASE("a value that is not an item of its Enumeration ends the run") {
  const bool is_hosted = GENERATE(false, true);
  const EnumerationUnit workspace("odd");
  const Outcome outcome = run_raw_unit(workspace, is_hosted, "mode");
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'odd', variable 'mode', at 0.375 s: the unit gives 99, "
                                   "which is not an item of its Enumeration: off (0), on (1)"));
  CHECK(last_time(workspace) == "0.25");
  CHECK(run_raw_unit(EnumerationUnit("even"), is_hosted, "mode").exit_code == 0);
}

TEST_CASE("a start value that is not finite is said") {
  const Workspace workspace(Parts{component("filter", "minimal.fmu")});
  const Outcome outcome = workspace.run({"--quiet", "--set", "filter.u=inf"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: ") && Contains("variable 'u': the start value is inf, "
                                                            "which is not a finite number"));
}

TEST_CASE("numbers that are set later and are not finite, or too near to 0, are said") {
  const Workspace workspace(two_filters());
  const auto [option, value, expected] = GENERATE(table<std::string, std::string, std::string>({
      {"--set-at", "first.u=nan@0.5", "the value for 'first.u' from 0.5 s on is nan, which is "},
      {"--force", "second.u=-inf@0.5..", "the value for 'second.u' from 0.5 s on is -inf, which "},
      {"--set", "first.u=1e-400", "variable 'u': the start value 1e-400 becomes 0: Float64 "},
      {"--set-at", "first.u=1e-400@0.5", "from 0.5 s on 1e-400 becomes 0: Float64 has no"},
  }));
  CAPTURE(option, value);
  const Outcome outcome = workspace.stride({"check", "test.ssd", option, value});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: ") && Contains(expected));
  CHECK(workspace.stride({"check", "test.ssd", "--set", "first.u=1e-300"}).err == "");
}

TEST_CASE("a value is read where it is recorded or shown, and nowhere else") {
  const RawUnit unread("mute", true,
                       "<stride:Results signals=\"none\" trace=\"none\" report=\"none\"/>");
  CHECK(unread.run({"--quiet"}).err.empty());
  CHECK(unread.run({"--progress", "none"}).err.empty());
  const RawUnit traced("mute", true, "<stride:Results signals=\"none\" report=\"none\"/>");
  CHECK_THAT(traced.run({"--quiet"}).err, Contains("fmi3GetBinary gave 3 bytes"));
}

TEST_CASE("a message with a status that FMI does not have is an error of the unit, hosted or not") {
  const bool is_hosted = GENERATE(false, true);
  const RawUnit workspace("mumbles", false);
  const Outcome outcome = run_raw_unit(workspace, is_hosted, "");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("error: unit 'mumbles' logged: something is up (logged with 77, a "
                      "status that FMI 3.0 does not have)\n"));
}

TEST_CASE("of many warnings of a unit the first are shown, and the others counted") {
  const RawUnit workspace("babbles", false);
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++found;
    return found;
  };
  const Outcome outcome = run_raw_unit(workspace, false, "");
  CHECK(outcome.exit_code == 0);
  CHECK(count(outcome.err, "it is warm") == 100);
  CHECK_THAT(outcome.err, Contains("from here on are only counted; --verbose shows all of them") &&
                              Contains("unit 'babbles': 2300 more warnings and errors of it"));
  const Outcome all = workspace.run({"--quiet", "--step", "0.125", "--verbose"});
  CHECK(count(all.err, "it is warm") == 2400);
}
