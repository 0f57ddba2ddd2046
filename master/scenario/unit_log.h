// What units log, on its way to the log of stride.
#ifndef STRIDE_MASTER_SCENARIO_UNIT_LOG_H
#define STRIDE_MASTER_SCENARIO_UNIT_LOG_H

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include "master/importer/status.h"

namespace stride::scenario {

/// Shows the first warnings and errors that a unit logs, and counts the others, unless everything
/// is shown (--verbose). What stride says about a unit is always shown. Any thread may write.
class UnitLog {
 public:
  /// Of one unit.
  static constexpr std::size_t kMostShown = 100;

  UnitLog() = default;
  /// Shows how many there were more.
  ~UnitLog();
  UnitLog(const UnitLog&) = delete;
  UnitLog& operator=(const UnitLog&) = delete;

  /// An importer::LogSink.
  void write(const std::string& unit, importer::Status status, const std::string& category,
             const std::string& message);

 private:
  bool is_shown(const std::string& unit);

  std::mutex mutex_;
  std::map<std::string, std::size_t> counts_;  ///< of warnings and errors, by the unit
};

}  // namespace stride::scenario

#endif
