#include "master/study/campaign/evaluation/campaign_junit.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "master/base/files/replacement.h"
#include "master/base/message_text.h"
#include "master/base/xml/writer.h"

namespace stride::campaign {
namespace {

void write_end(xml::Writer& xml, const CaseResult& result, const std::string& command) {
  if (result.outcome == Outcome::Passed) return;
  xml.open(result.outcome == Outcome::Failed ? "failure" : "error");
  xml.attribute("message", core::first_line(result.reason));
  xml.attribute("type", name(result.outcome));
  xml.text(result.reason + "\n" + command + "\n");
  xml.close();
}

}  // namespace

void write_campaign_junit(const std::filesystem::path& file, const Plan& plan,
                          const CaseFolder& cases, const CaseTotals& totals) {
  std::uint64_t failures = 0;
  double time = 0;
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const auto record = cases.read(i);
    if (!record) continue;
    failures += record->result.outcome == Outcome::Failed ? 1 : 0;
    time += record->result.wall_time;
  }
  const std::string suite = plan.campaign().file.stem().string();
  xml::Writer xml;
  xml.open("testsuites");
  xml.open("testsuite");
  xml.attribute("name", suite);
  xml.attribute("tests", std::to_string(totals.cases));
  xml.attribute("failures", std::to_string(failures));
  xml.attribute("errors", std::to_string(totals.failed - failures));
  xml.attribute("skipped", std::to_string(totals.missing()));
  xml.attribute("time", fmt::format("{:.3f}", time));
  for (std::uint64_t i = 0; i < plan.size(); ++i) {
    const auto record = cases.read(i);
    xml.open("testcase");
    xml.attribute("name", fmt::format("case {}", i));
    xml.attribute("classname", suite);
    xml.attribute("time", fmt::format("{:.3f}", record ? record->result.wall_time : 0));
    if (record) {
      write_end(xml, record->result, plan.command(plan.at(i)));
    } else {
      xml.open("skipped");
      xml.attribute("message", "the case has not been run");
      xml.close();
    }
    xml.close();
  }
  xml.close();
  xml.close();
  core::Replacement output(file);
  output.file().write(xml.document());
  output.commit();
}

}  // namespace stride::campaign
