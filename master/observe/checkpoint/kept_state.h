// How the state of a unit is kept in a checkpoint.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_KEPT_STATE_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_KEPT_STATE_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <stride/time.h>

namespace stride::checkpoint {

struct KeptState {
  std::optional<std::size_t> serialized_bytes{};  ///< of the unit's own state, if there is one
  Time since{};                                   ///< when it was serialised, or else the start
  std::uint64_t repeated_steps = 0;               ///< from then on
  std::size_t bytes = 0;                          ///< of all that is in the checkpoint
};

/// "serialised, 12 kB", "replayed: 30,000 steps since 0 s", or "serialised at 2 s, 12 kB, then
/// replayed: 300 steps".
std::string to_text(const KeptState& kept);

}  // namespace stride::checkpoint

#endif
