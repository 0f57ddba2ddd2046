#include "master/front/cli/run/idle_cause.h"

#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/engine/model/system/upstream.h"

namespace stride::cli {
namespace {

std::vector<std::size_t> candidates(const core::System& system,
                                    std::optional<core::VariableId> variable) {
  if (variable) return core::components_upstream(system, *variable);
  std::vector<std::size_t> all(system.components().size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// "'a', 'b' and 3 others"
std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 5;
  if (names.size() <= kMost + 1) return core::quoted(names);
  return fmt::format("{} and {} others", core::quoted({names.data(), kMost}), names.size() - kMost);
}

}  // namespace

std::string hint_on_cause(const core::System& system, const core::RunStatistics& statistics,
                          std::optional<core::VariableId> variable) {
  std::vector<std::string> suspended;
  for (const std::size_t i : candidates(system, variable)) {
    if (statistics.units[i].suspensions > 0) suspended.push_back(system.components()[i].name);
  }
  if (suspended.empty()) {
    return "what differs depends on no unit that was suspended, so there is another reason; stride "
           "verify --check determinism tests a unit";
  }
  return fmt::format(
      "no unit was found to break its promises; what differs depends on {}, which {} suspended, "
      "within tolerances and deadbands: <stride:Tolerance> and <stride:Deadband> make their effect "
      "on others smaller, <stride:IdleSkip components=\"…\" enabled=\"false\"/> leaves units out",
      list_of(suspended), suspended.size() == 1 ? "was" : "were");
}

}  // namespace stride::cli
