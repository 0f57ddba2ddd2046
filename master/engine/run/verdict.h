// Verdicts on a run.
#ifndef STRIDE_MASTER_ENGINE_RUN_VERDICT_H
#define STRIDE_MASTER_ENGINE_RUN_VERDICT_H

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/engine/model/system/system.h"
#include "master/engine/model/values.h"
#include "master/engine/port/unit.h"

namespace stride::core {

/// The value of one element of a signal at some time.
struct SignalValue {
  std::string signal;
  ValueBlock value;  ///< of one element
  std::string unit;  ///< of measure
};

/// How far a run was from the other verdict.
struct Margin {
  double value = 0;    ///< 0 or more if passed, 0 or less if failed; may be infinite, is never NaN
  std::string unit{};  ///< of measure; "s" of times, "messages" of counts
  Time at{};           ///< where the run was so near to the other verdict, or so far behind it
};

/// "0.25 V": the shortest text that reads back the same, and one of a few digits.
std::string to_text(const Margin& margin);
std::string brief_text(const Margin& margin);

/// What a check demands of a signal, for display.
struct SignalLimits {
  struct Limit {
    std::string name;  ///< "min", "max", "above", "below", "equals", "tolerance"
    ValueBlock value;  ///< of one element
  };
  std::string signal;          ///< one element of it, by its full name
  std::optional<Time> from{};  ///< included, as `to` is; empty: from the start
  std::optional<Time> to{};    ///< empty: to the end
  std::vector<Limit> limits{};
};

/// The verdict of a unit, or of a check of the scenario, on a run.
struct Verdict {
  std::string name;                      ///< of the component or of the check
  std::optional<bool> passed;            ///< empty: undecided
  std::string text{};                    ///< the reason, for display; may be empty
  std::string kind{};                    ///< of a check; empty: a unit's verdict
  Location where{};                      ///< of a check
  std::optional<Time> time{};            ///< of the first failure, as far as it has an instant
  std::vector<SignalValue> values{};     ///< at that time
  std::optional<Margin> margin{};        ///< of a check that is decided
  std::optional<SignalLimits> limits{};  ///< of a check of a signal
};

/// "at 12.3 s: 1.79 V, expected >= 1.8 V", as far as there is a time and a text.
std::string reason(const Verdict& verdict);

/// The verdicts of the units that declare one, in the order of the components, as long as they are
/// undecided.
std::vector<Verdict> undecided_verdicts(const System& system);

/// The same verdicts as the units give them. To be called after a successful run, before
/// terminate(). Throws Error.
std::vector<Verdict> read_verdicts(const System& system,
                                   std::span<const std::unique_ptr<Unit>> units);

}  // namespace stride::core

#endif
