// A check that something is covered: <stride:Covered>.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_DEMAND_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_DEMAND_H

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/engine/run/verdict.h"
#include "master/observe/coverage/report.h"

namespace stride::coverage {

/// The percentage of a group, or of one of its points, is `min` at least where the run ends.
struct Demand {
  std::string name{};    ///< unique among the checks of its scenario
  std::string demand{};  ///< in words
  std::size_t group = 0;
  std::optional<std::size_t> point{};
  double min = 0;
  core::Location where{};
};

/// In the order of the demands, which are of the report's definitions. A run that is not complete
/// could still have reached what it has not.
std::vector<core::Verdict> verdicts(std::span<const Demand> demands, const Report& report,
                                    Time reached, bool is_complete);

/// "[0, 1) and 3 more": what does not have its visits yet. Empty if nothing is missing.
std::string missing_text(const PointReport& point, std::size_t most);

/// "71.25 %", with two digits behind the point at most, never rounded up to 100; "-" for none.
std::string percentage_text(std::optional<double> percentage);

}  // namespace stride::coverage

#endif
