// What is changed in the middle of a run, and by no unit.
#ifndef STRIDE_MASTER_ENGINE_RUN_CONTEXT_INTERVENTION_H
#define STRIDE_MASTER_ENGINE_RUN_CONTEXT_INTERVENTION_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/model/values.h"
#include "master/engine/model/variable_id.h"

namespace stride::core {

/// A change at an instant of the run: of one variable, or of the messages that one receives.
struct Intervention {
  enum class Kind : std::uint8_t {
    Set,      ///< a tunable parameter, or an input without a source, gets a value
    Force,    ///< a connected input has a value, whatever its source gives
    Hold,     ///< likewise, the value that it has at `from`
    Drop,     ///< messages are not received
    Delay,    ///< messages are received later
    Corrupt,  ///< messages are received with bit errors
  };

  Kind kind = Kind::Set;
  VariableId id;  ///< of messages: an input clock, or an input that belongs to it
  Time from{};
  std::optional<Time> until{};        ///< when its source counts again; nothing: not in this run
  std::optional<ValueBlock> value{};  ///< of all elements; of Set and Force
  VariableId clock{};                 ///< of messages: the input clock
  Duration delay{};                   ///< of Delay; more than 0
  std::size_t bits = 0;               ///< of Corrupt: how many of each message are inverted
  std::size_t header = 0;             ///< of Corrupt: first bytes of each value that are left alone
  std::uint64_t seed = 0;             ///< of Corrupt: chooses them
};

/// Whether it is one of messages.
bool disturbs_messages(Intervention::Kind kind);

/// "set", "force", "hold", "drop", "delay", "corrupt".
const char* name(Intervention::Kind kind);
/// What is more to say of it, for tables: the elements of the value, "0.02 s", "3 bits".
std::string amount_text(const Intervention& intervention);
/// For people: "set to 3 V", "forced to 85 until 3 s", "held at 20.5".
std::string to_text(const Intervention& intervention, const System& system,
                    const ValueBlock& value);
/// For people, of messages: "messages are dropped until 3 s".
std::string to_text(const Intervention& intervention);

}  // namespace stride::core

#endif
