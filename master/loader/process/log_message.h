// What a unit logs, on its way to the master.
#ifndef STRIDE_MASTER_LOADER_PROCESS_LOG_MESSAGE_H
#define STRIDE_MASTER_LOADER_PROCESS_LOG_MESSAGE_H

#include <mutex>
#include <string>

#include "master/loader/fmu/library/status.h"
#include "master/loader/process/host_link.h"

namespace stride::isolation {

struct LogMessage {
  importer::Status status = importer::Status::Ok;
  std::string category, text;
};

/// In the unit's process; any of its threads may use it. Where there is no room it waits until the
/// master has read. Texts are cut off after 64 MiB.
class LogWriter {
 public:
  explicit LogWriter(HostLinkMemory& link) : link_(link) {}
  void write(const LogMessage& message);

 private:
  void write(std::string_view bytes);

  HostLinkMemory& link_;
  std::mutex mutex_;
};

/// In the master.
class LogReader {
 public:
  explicit LogReader(HostLinkMemory& link) : link_(link) {}

  bool is_empty() const { return link_.logged.is_empty(); }
  /// Calls take(LogMessage&&) for each message that is there as a whole.
  template <class Take>
  void read(Take&& take) {
    link_.logged.read(bytes_);
    LogMessage message;
    while (next(message)) take(std::move(message));
  }

 private:
  bool next(LogMessage& message);

  HostLinkMemory& link_;
  std::string bytes_;  ///< read, and not taken yet
};

}  // namespace stride::isolation

#endif
