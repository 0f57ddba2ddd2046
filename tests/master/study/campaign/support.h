// Campaigns for tests.
#ifndef STRIDE_TESTS_MASTER_STUDY_CAMPAIGN_SUPPORT_H
#define STRIDE_TESTS_MASTER_STUDY_CAMPAIGN_SUPPORT_H

#include <string>

#include "master/study/campaign/definition/campaign_file.h"
#include "master/study/campaign/plan.h"
#include "tests/build.h"
#include "tests/master/study/campaign/texts.h"
#include "tests/master/system/ssp/support.h"

namespace stride::tests {

inline campaign::Campaign read_text(const std::string& text) {
  const TemporaryFolder folder;
  return campaign::read_campaign(folder.write("c.xosc", text));
}

/// All of this kind but for texts.
inline campaign::Plan plan_of(const std::string& text,
                              campaign::ValueKind::Type type = campaign::ValueKind::Type::Float64) {
  using namespace stride::campaign;
  using KindType = ValueKind::Type;
  Campaign read = read_text(text);
  std::vector<ValueKind> kinds;
  for (const PlanColumn& column : plan_columns(read)) {
    const bool is_instant = column.part == "from" || column.part == "until" || column.part == "at";
    kinds.push_back({.type = column.role == PlanColumn::Role::Swap ? KindType::Text
                             : is_instant                          ? KindType::Instant
                                                                   : type});
  }
  Fingerprints fingerprints{"1.0", {{"x.ssd", "f"}}, {{"a", "u"}, {"s", "v"}}, {}};
  fingerprints.alternatives[{"device", "new"}] = "w";
  return Plan(std::move(read), std::move(kinds), std::move(fingerprints));
}

/// A folder with "c.xosc", and "x.ssd": `a`, which has all types and echoes them, and two
/// low-passes `b` and `c`, b.y to c.u; the run ends at 1 s.
class CampaignFolder {
 public:
  explicit CampaignFolder(const std::string& campaign) {
    const std::string units = unit_folder().string(), test_units = test_unit_folder().string();
    folder_.write("x.ssd",
                  "<ssd:SystemStructureDescription name='x' version='2.0' "
                  "xmlns:ssd='http://ssp-standard.org/SSP1/SystemStructureDescription'>"
                  "<ssd:System name='root'><ssd:Elements>"
                  "<ssd:Component name='a' source='" +
                      test_units +
                      "/types.fmu'/>"
                      "<ssd:Component name='b' source='" +
                      units +
                      "/minimal.fmu'/>"
                      "<ssd:Component name='c' source='" +
                      units +
                      "/minimal.fmu'/>"
                      "</ssd:Elements><ssd:Connections>"
                      "<ssd:Connection startElement='b' startConnector='y' endElement='c' "
                      "endConnector='u'/></ssd:Connections></ssd:System>"
                      "<ssd:DefaultExperiment stopTime='1'/></ssd:SystemStructureDescription>");
    file_ = folder_.write("c.xosc", campaign);
  }

  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  campaign::Campaign read() const { return campaign::read_campaign(file_); }

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
};

}  // namespace stride::tests

#endif
