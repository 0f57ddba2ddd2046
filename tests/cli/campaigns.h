// Campaigns of the scenario of a workspace.
#ifndef STRIDE_TESTS_CLI_CAMPAIGNS_H
#define STRIDE_TESTS_CLI_CAMPAIGNS_H

#include <string>

#include "tests/cli/failures.h"
#include "tests/master/campaign/texts.h"

namespace stride::tests {

/// Draws of the input of the first of two filters.
inline std::string drawn_input(const std::string& runs, const std::string& extension) {
  return campaign_text(stochastic(drawn("first.u", uniform("0", "2")), runs, "1"), extension,
                       "test.ssd");
}

/// Two filters, of which the check `bounded` fails where that input is too large.
inline Parts checked_filters() {
  Parts parts = two_filters();
  parts.annotation =
      "<stride:Checks><stride:Always name='bounded' signal='first.y' max='1'/></stride:Checks>\n";
  return parts;
}

}  // namespace stride::tests

#endif
