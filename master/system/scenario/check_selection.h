// What the checks of a scenario are about.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_CHECK_SELECTION_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_CHECK_SELECTION_H

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/observe/checks/definition.h"
#include "master/system/declaration/check_declaration.h"

namespace stride::scenario {

/// When a scenario begins, and when it ends as far as it defines that itself.
struct ScenarioTimes {
  Time start{};
  std::optional<Time> stop{};
  std::string stop_hint{};  ///< for times behind its stop; empty: none
};

/// The declared checks with the variables of the system; a glob, and an array that is named as a
/// whole, become a check for each signal and element. Throws core::Error (Input), which reports
/// all mistakes at once: a name that matches nothing, with the nearest one; a signal where a
/// message is required, and the other way round; a condition that does not fit its signal; an
/// interval that is not in the run; two checks of one name.
std::vector<checks::Definition> select_checks(const core::System& system,
                                              std::span<const CheckDeclaration> declarations,
                                              const ScenarioTimes& times);

}  // namespace stride::scenario

#endif
