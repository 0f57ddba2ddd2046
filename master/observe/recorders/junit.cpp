#include "master/observe/recorders/junit.h"

#include <algorithm>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/replacement.h"
#include "master/base/message_text.h"
#include "master/base/time_text.h"
#include "master/base/xml/writer.h"

namespace stride::recorders {
namespace {

std::string details(const core::Verdict& verdict) {
  std::string text = core::to_text({verdict.where, {}, {}, {}}) + verdict.name + "\n";
  if (verdict.time) text += fmt::format("first failure: {} s\n", core::to_text(*verdict.time));
  if (!verdict.text.empty()) text += verdict.text + "\n";
  for (const core::SignalValue& value : verdict.values) {
    text += fmt::format("{} = {}{}{}\n", value.signal, core::element_text(value.value, 0),
                        value.unit.empty() ? "" : " ", value.unit);
  }
  return text;
}

class JunitWriter {
 public:
  explicit JunitWriter(const JunitReport& report) : report_(report) {}

  std::string document() {
    xml_.open("testsuites");
    xml_.open("testsuite");
    write_suite_attributes();
    write_properties();
    write_run();
    for (const core::Verdict& verdict : report_.verdicts) write_verdict(verdict);
    for (const char* output : {"system-out", "system-err"}) {
      xml_.open(output);
      xml_.close();
    }
    xml_.close();
    xml_.close();
    return xml_.document();
  }

 private:
  std::string count(std::optional<bool> passed) const {
    return std::to_string(std::ranges::count(report_.verdicts, passed, &core::Verdict::passed));
  }

  void write_suite_attributes() {
    xml_.attribute("name", report_.suite);
    xml_.attribute("package", "");
    xml_.attribute("id", "0");
    xml_.attribute("tests", std::to_string(report_.verdicts.size() + 1));
    xml_.attribute("failures", count(false));
    xml_.attribute("errors", report_.error ? "1" : "0");
    xml_.attribute("skipped", count(std::nullopt));
    xml_.attribute("time", core::wall_seconds(report_.wall_time));
    xml_.attribute("timestamp",
                   fmt::format("{:%Y-%m-%dT%H:%M:%S}",
                               fmt::gmtime(std::chrono::system_clock::to_time_t(report_.began))));
    xml_.attribute("hostname", report_.host);
  }

  /// Margins are the suite's, since the strictest schemas know no properties of a test case.
  void write_properties() {
    xml_.open("properties");
    for (const auto& [name, value] : report_.properties) write_property(name, value);
    for (const core::Verdict& verdict : report_.verdicts) {
      if (!verdict.margin) continue;
      write_property("margin: " + core::first_line(verdict.name), core::to_text(*verdict.margin));
    }
    xml_.close();
  }

  void write_property(const std::string& name, const std::string& value) {
    xml_.open("property");
    xml_.attribute("name", name);
    xml_.attribute("value", core::first_line(value));
    xml_.close();
  }

  void open_case(const std::string& name, const std::string& group, std::chrono::nanoseconds time) {
    xml_.open("testcase");
    xml_.attribute("name", core::first_line(name));
    xml_.attribute("classname", report_.suite + group);
    xml_.attribute("time", core::wall_seconds(time));
  }

  void write_outcome(const char* element, const std::string& type, const std::string& message,
                     const std::string& text) {
    xml_.open(element);
    xml_.attribute("message", core::first_line(message));
    if (!type.empty()) xml_.attribute("type", type);
    if (!text.empty()) xml_.text(text);
    xml_.close();
  }

  void write_run() {
    open_case("run", "", report_.wall_time);
    if (report_.error) write_outcome("error", "run", *report_.error, *report_.error);
    xml_.close();
  }

  void write_verdict(const core::Verdict& verdict) {
    open_case(verdict.name, verdict.kind.empty() ? ".units" : ".checks", {});
    const std::string type = verdict.kind.empty() ? "verdict" : verdict.kind;
    if (!verdict.passed) {
      write_outcome("skipped", "", "undecided: " + core::reason(verdict), "");
    } else if (!*verdict.passed) {
      write_outcome("failure", type, core::reason(verdict), details(verdict));
    }
    xml_.close();
  }

  const JunitReport& report_;
  xml::Writer xml_;
};

}  // namespace

void write_junit(const std::filesystem::path& file, const JunitReport& report) {
  core::Replacement output(file);
  output.file().write(JunitWriter(report).document());
  output.commit();
}

}  // namespace stride::recorders
