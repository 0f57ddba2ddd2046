// The file of a run's state at an instant.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_CHECKPOINT_FILE_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_CHECKPOINT_FILE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/observe/recorders/provenance.h"

namespace stride::checkpoint {

using Bytes = std::vector<std::byte>;

/// A run at a communication point.
struct Checkpoint {
  recorders::Provenance provenance;
  Time time{};
  std::filesystem::path results{};  ///< the folder, absolute
  std::size_t interventions = 0;    ///< that had begun
  /// How the state of each component's unit is kept, for people.
  std::map<std::string, std::string> units{};
  /// States by name, such as "simulation" and "unit/sensor".
  std::map<std::string, Bytes> states{};
};

/// A zip archive: checkpoint.json, which says what it is, and the states. It replaces a file of
/// this name when it is complete and on the disk. Throws core::Error (Run).
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws core::Error (Input) for what is no checkpoint, was damaged, or has another format.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// The state of this name. Throws core::BadState if there is none.
const Bytes& state_of(const Checkpoint& checkpoint, const std::string& name);

}  // namespace stride::checkpoint

#endif
