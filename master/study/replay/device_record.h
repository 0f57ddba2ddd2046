// What a device has done in a run, from the results of that.
#ifndef STRIDE_MASTER_STUDY_REPLAY_DEVICE_RECORD_H
#define STRIDE_MASTER_STUDY_REPLAY_DEVICE_RECORD_H

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/model/description.h"
#include "master/study/replay/replay_system.h"
#include "master/study/replay/stimuli_summary.h"

namespace stride::replay {

/// The outputs of a component, as texts of the files, which have all bits.
struct DeviceRecord {
  struct Message {
    std::string time, index, output, payload;
    bool operator==(const Message&) const = default;
  };
  std::vector<std::string> outputs;  ///< "led", of an array "torque[2]"; those that were recorded
  std::vector<std::string> times;    ///< of communication points, each once
  /// By time, what it leaves behind of the outputs.
  std::map<std::string, std::vector<std::string>> values;
  std::vector<Message> sent;
};

/// Of the results of a run of which the component has this name. A file that is empty here was not
/// written. Throws core::Error (Input) for files that are none.
DeviceRecord read_device_record(const std::filesystem::path& signals,
                                const std::filesystem::path& events, const std::string& component,
                                const core::UnitDescription& device);

/// Where a replay is not what the device did in the run that the stimuli are from; nothing if it
/// is. Compared are all messages up to the end of the stimuli, and the values of outputs that both
/// have, at the instants at which the unit was called; with idle skipping at those of events only,
/// since the run has outputs of a suspended unit on their tangents. A process that was killed may
/// have written messages that are later than the end of its stimuli.
std::optional<std::string> first_difference(const DeviceRecord& run, const DeviceRecord& replay,
                                            const StimuliSummary& stimuli);

/// That the replay ends with these values, and has so many messages. Left out is what no check can
/// have: NaN, infinity, and texts with characters that XML has not. `tolerance` is that of reals.
std::vector<Expectation> expectations_of(const DeviceRecord& replay,
                                         const core::UnitDescription& device,
                                         const std::string& tolerance);

}  // namespace stride::replay

#endif
