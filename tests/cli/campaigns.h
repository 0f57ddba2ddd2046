// Campaigns of the scenario of a workspace.
#ifndef STRIDE_TESTS_CLI_CAMPAIGNS_H
#define STRIDE_TESTS_CLI_CAMPAIGNS_H

#include <sstream>
#include <string>
#include <system_error>

#include "tests/cli/failures.h"
#include "tests/master/study/campaign/texts.h"

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

/// Each row without its last fields: the wall time, when, and where.
inline std::string without_wall_times(const std::string& table) {
  std::istringstream lines(table);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    for (int field = 0; field < 3; ++field) line.erase(line.rfind(','));
    text += line + "\n";
  }
  return text;
}

/// How many cases have a record.
inline std::size_t records_in(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code none;
  for (fs::recursive_directory_iterator it(folder / "cases", none), end; it != end;
       it.increment(none)) {
    count += it->path().extension() == ".json" && it.depth() == 1 ? 1 : 0;
  }
  return count;
}

}  // namespace stride::tests

#endif
