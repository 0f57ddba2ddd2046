// What is changed in the middle of a run, and by no unit.
#ifndef STRIDE_MASTER_ALGORITHM_INTERVENTION_H
#define STRIDE_MASTER_ALGORITHM_INTERVENTION_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/model/system.h"
#include "master/model/values.h"
#include "master/model/variable_id.h"

namespace stride::core {

/// A change of one variable at an instant of the run.
struct Intervention {
  enum class Kind : std::uint8_t {
    Set,    ///< a tunable parameter, or an input without a source, gets a value
    Force,  ///< a connected input has a value, whatever its source gives
    Hold,   ///< likewise, the value that it has at `from`
  };

  Kind kind = Kind::Set;
  VariableId id;
  Time from{};
  std::optional<Time> until{};        ///< when its source counts again; nothing: not in this run
  std::optional<ValueBlock> value{};  ///< of all elements; not of Hold
};

/// "set", "force", "hold".
const char* name(Intervention::Kind kind);
/// For people: "set to 3 V", "forced to 85 until 3 s", "held at 20.5".
std::string to_text(const Intervention& intervention, const System& system,
                    const ValueBlock& value);

}  // namespace stride::core

#endif
