// Verdicts on a run.
#ifndef STRIDE_MASTER_ALGORITHM_VERDICT_H
#define STRIDE_MASTER_ALGORITHM_VERDICT_H

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/algorithm/unit.h"
#include "master/model/system.h"
#include "master/model/values.h"
#include "master/util/error.h"

namespace stride::core {

/// The value of one element of a signal at some time.
struct SignalValue {
  std::string signal;
  ValueBlock value;  ///< of one element
  std::string unit;  ///< of measure
};

/// The verdict of a unit, or of a check of the scenario, on a run.
struct Verdict {
  std::string name;                   ///< of the component or of the check
  std::optional<bool> passed;         ///< empty: undecided
  std::string text{};                 ///< the reason, for display; may be empty
  std::string kind{};                 ///< of a check; empty: a unit's verdict
  Location where{};                   ///< of a check
  std::optional<Time> time{};         ///< of the first failure, as far as it has an instant
  std::vector<SignalValue> values{};  ///< at that time
};

/// "at 12.3 s: 1.79 V, expected >= 1.8 V", as far as there is a time and a text.
std::string reason(const Verdict& verdict);

/// The verdicts of the units that declare one, in the order of the components. To be called after a
/// successful run, before terminate(). Throws Error.
std::vector<Verdict> read_verdicts(const System& system,
                                   std::span<const std::unique_ptr<Unit>> units);

}  // namespace stride::core

#endif
