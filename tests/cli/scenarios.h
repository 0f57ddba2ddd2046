// Scenarios for the tests of the program, written into a scratch folder.
#ifndef STRIDE_TESTS_CLI_SCENARIOS_H
#define STRIDE_TESTS_CLI_SCENARIOS_H

#include <algorithm>
#include <string>

#include "tests/cli/program.h"
#include "tests/cli/results.h"
#include "tests/master/loader/fmu/support.h"

namespace stride::tests {

/// The parts of a scenario, each a piece of XML.
struct Parts {
  std::string components;
  std::string connections = "";
  std::string annotation = "";  ///< the content of <stride:Scenario>
  std::string experiment = "<ssd:DefaultExperiment stopTime=\"1\"/>\n";
};

inline std::string component(const std::string& name, const std::string& source,
                             const std::string& inside = "") {
  return "<ssd:Component name=\"" + name + "\" source=\"" + source + "\">" + inside +
         "</ssd:Component>\n";
}

/// For the content of a component.
inline std::string connector(const std::string& name, const std::string& kind,
                             const std::string& type) {
  return "<ssd:Connectors><ssd:Connector name=\"" + name + "\" kind=\"" + kind + "\">" + type +
         "</ssd:Connector></ssd:Connectors>";
}

/// "a.y", "b.u": one connection, on a line of its own.
inline std::string connection(const std::string& from, const std::string& to) {
  const auto end = [](const std::string& word, const std::string& name) {
    const std::size_t dot = name.find('.');
    return " " + word + "Element=\"" + name.substr(0, dot) + "\" " + word + "Connector=\"" +
           name.substr(dot + 1) + "\"";
  };
  return "<ssd:Connection" + end("start", from) + end("end", to) + "/>\n";
}

inline std::string scenario_text(const Parts& parts) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<ssd:SystemStructureDescription name=\"test\" version=\"2.0\"\n"
         "    xmlns:ssd=\"http://ssp-standard.org/SSP1/SystemStructureDescription\"\n"
         "    xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\">\n"
         "<ssd:System name=\"root\">\n<ssd:Elements>\n" +
         parts.components + "</ssd:Elements>\n<ssd:Connections>\n" + parts.connections +
         "</ssd:Connections>\n</ssd:System>\n" + parts.experiment +
         "<ssd:Annotations><ssc:Annotation type=\"org.stride\">\n"
         "<stride:Scenario xmlns:stride=\"urn:org.stride:scenario:1\">\n" +
         parts.annotation +
         "</stride:Scenario>\n</ssc:Annotation></ssd:Annotations>\n"
         "</ssd:SystemStructureDescription>\n";
}

/// Two low-passes in a row; 1 s in steps of 1 ms.
inline Parts two_filters() {
  return {component("first", "minimal.fmu") + component("second", "minimal.fmu"),
          connection("first.y", "second.u")};
}

/// A scratch folder with a scenario in it, "test.ssd", in which the program runs.
class Workspace {
 public:
  explicit Workspace(const Parts& parts) : Workspace(scenario_text(parts)) {}
  explicit Workspace(const std::string& text) : text_(text) { scratch_.write("test.ssd", text); }

  const Scratch& scratch() const { return scratch_; }
  fs::path operator/(const std::string& name) const { return scratch_ / name; }

  Outcome stride(const Arguments& arguments) const {
    return run_program(arguments, scratch_.path());
  }
  /// `stride run test.ssd --out out` with further arguments.
  Outcome run(const Arguments& further = {}) const { return stride(run_arguments(further)); }
  static Arguments run_arguments(const Arguments& further) {
    Arguments arguments{"run", "test.ssd", "--out", "out"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return arguments;
  }

  std::string result(const std::string& file) const { return read(scratch_ / "out" / file); }
  Csv signals() const { return Csv(scratch_ / "out" / "signals.csv"); }

  /// "test.ssd:LINE: " for the first line with this text in the scenario.
  std::string at(const std::string& text) const {
    const std::size_t found = text_.find(text);
    if (found == std::string::npos) throw std::runtime_error("the scenario has no " + text);
    const auto line = std::count(text_.begin(), text_.begin() + static_cast<long>(found), '\n') + 1;
    return "test.ssd:" + std::to_string(line) + ": ";
  }

  /// What unpacked units have left in TMPDIR; the folder of the user stays.
  std::vector<std::string> left_behind() const {
    std::vector<std::string> names;
    for (fs::recursive_directory_iterator it(scratch_ / "tmp"), end; it != end; ++it) {
      const std::string name = it->path().filename().string();
      if (it.depth() > 0 || name.rfind("stride-", 0) != 0) names.push_back(name);
    }
    return names;
  }

 private:
  Scratch scratch_;
  std::string text_;
};

/// Whatever is wrong with the input: code 2, a message, and nothing on the standard output.
inline std::string input_error_of(const Outcome& outcome) {
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.out == "");
  return outcome.err;
}

}  // namespace stride::tests

#endif
