#include "master/engine/model/system/own_step.h"

#include <optional>

#include <fmt/format.h>

namespace stride::core {

std::string own_step_hint(const std::string& component, const UnitDescription& unit,
                          const Interval& size) {
  const std::optional<Interval>& own =
      unit.default_step ? unit.default_step : unit.fixed_internal_step;
  const bool is_whole = !unit.default_step && unit.can_vary_step;
  if (!own || *own == size || (is_whole && size.is_multiple_of(*own))) return "";
  return fmt::format(
      "the unit was made for steps of {0} s ({1}){2}, and this one is of {3} s: use --step "
      "{4}={0}, "
      "or <stride:Step components=\"{4}\" size=\"{0}\"/>",
      to_text(*own), unit.default_step ? "its DefaultExperiment" : "its fixed internal step",
      unit.can_vary_step ? "" : ", and takes steps of one size only", to_text(size), component);
}

}  // namespace stride::core
