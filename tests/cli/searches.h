// Searches through campaigns of the scenario of a workspace.
#ifndef STRIDE_TESTS_CLI_SEARCHES_H
#define STRIDE_TESTS_CLI_SEARCHES_H

#include <string>

#include "tests/cli/campaigns.h"

namespace stride::tests {

inline constexpr const char* kNoResults = "<stride:Keep results='none'/>";

/// Two filters in a row for 1 s, whose parameters nearly all have to be adverse for `bounded` to
/// fail: a large input and short time constants.
inline Parts planted_filters(const std::string& checks = "") {
  Parts parts = two_filters();
  parts.experiment = "<ssd:DefaultExperiment stopTime=\"1\"/>\n";
  parts.annotation =
      "<stride:Step size='0.25'/><stride:Checks><stride:Always name='bounded' signal='second.y' "
      "max='0.7'/>" +
      checks + "</stride:Checks>\n";
  return parts;
}

inline std::string planted_campaign(const std::string& extension = kNoResults) {
  return campaign_text(stochastic(drawn("first.u", uniform("0", "1")) +
                                  drawn("first.time_constant", uniform("0.2", "1.5")) +
                                  drawn("second.time_constant", uniform("0.2", "1.5"))),
                       extension, "test.ssd");
}

/// A folder with a scenario and the campaign c.xosc.
struct Searches : Workspace {
  explicit Searches(const std::string& campaign = planted_campaign(),
                    const Parts& parts = planted_filters())
      : Workspace(parts) {
    scratch().write("c.xosc", campaign);
  }

  static Arguments arguments(const std::string& out, const Arguments& further = {}) {
    Arguments made{"campaign", "search", "c.xosc", "--progress", "none", "--out", out};
    made.insert(made.end(), further.begin(), further.end());
    return made;
  }
  Outcome search(const std::string& out, const Arguments& further = {}) const {
    return stride(arguments(out, further));
  }
  std::string file(const std::string& name) const { return read(scratch() / name); }
  std::string table(const std::string& out) const {
    return without_wall_times(file(out + "/cases.csv"));
  }
};

}  // namespace stride::tests

#endif
