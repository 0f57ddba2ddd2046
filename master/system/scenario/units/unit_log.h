// What units log, on its way to the log of stride.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_UNIT_LOG_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_UNIT_LOG_H

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

#include "master/loader/fmu/library/status.h"

namespace stride::scenario {

/// Shows the first warnings and errors that a unit logs, and counts the others, unless everything
/// is shown (--verbose). What stride says about a unit does not count. Of warnings and errors of
/// one kind, which differ in numbers and in the name of their unit alone, those of the first
/// instance of an FMU are shown, and those of its other instances are counted. Any thread may
/// write.
class UnitLog {
 public:
  /// Of one unit.
  static constexpr std::size_t kMostShown = 100;
  /// Messages of further kinds are not compared.
  static constexpr std::size_t kMostKinds = 1000;

  UnitLog() = default;
  /// Shows how many there were more.
  ~UnitLog();
  UnitLog(const UnitLog&) = delete;
  UnitLog& operator=(const UnitLog&) = delete;

  /// Names the FMU of a unit. A unit without one is the only instance of its own.
  void add_unit(const std::string& unit, const std::string& fmu);

  /// An importer::LogSink.
  void write(const std::string& unit, importer::Status status, const std::string& category,
             const std::string& message);

 private:
  /// Messages that differ in numbers alone.
  struct Kind {
    std::string first_unit;
    std::string first_message;
    std::set<std::string> others;  ///< the other instances of the FMU that have logged it
    std::uint64_t hidden = 0;      ///< messages of these
  };

  bool is_shown(const std::string& unit, const std::string& message, bool counts);
  bool is_first_of_kind(const std::string& unit, const std::string& message);
  bool is_within_limit(const std::string& unit);

  std::mutex mutex_;
  std::map<std::string, std::string> fmus_;    ///< by the unit
  std::map<std::string, std::size_t> counts_;  ///< of warnings and errors, by the unit
  /// By the FMU, and the message without its numbers.
  std::map<std::pair<std::string, std::string>, Kind> kinds_;
};

}  // namespace stride::scenario

#endif
