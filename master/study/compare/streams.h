// Messages, and events of components.
#ifndef STRIDE_MASTER_STUDY_COMPARE_STREAMS_H
#define STRIDE_MASTER_STUDY_COMPARE_STREAMS_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/study/compare/criteria/difference.h"
#include "master/study/compare/criteria/selection.h"

namespace stride::compare {

/// The messages that one variable has sent or received, or the events of one component.
struct StreamEntry {
  Time time;
  std::uint64_t index = 0;
  std::string payload{};
  std::string content{};
  bool operator==(const StreamEntry&) const = default;
};

struct Streams {
  struct Stream {
    std::string name;      ///< "reader.transmit.frame sent"; of events the component
    std::string variable;  ///< "reader.transmit.frame"; likewise
    std::vector<StreamEntry> entries{};
  };
  Kind kind = Kind::Message;
  std::vector<Stream> streams{};
  std::map<std::string, std::size_t> places{};  ///< by name
  std::vector<std::size_t> order{};             ///< of each row of the file, which stream
  std::optional<std::size_t> cut{};             ///< the line that was cut off
};

/// events.csv. Throws core::Error (Input).
Streams read_messages(const std::filesystem::path& file);
/// The events in activity.csv: when components were in event mode. Throws core::Error (Input).
Streams read_events(const std::filesystem::path& file);

/// The nth of a stream with the nth: with a tolerance of time [ps] their instants within that and
/// what they hold, without it all that the files have, also the order of the rows. Of events there
/// is no selection. Takes linear time.
Differences compare_streams(const Streams& a, const Streams& b,
                            std::optional<Duration> time_tolerance, const Selection& selection,
                            const std::string& file);

}  // namespace stride::compare

#endif
