// The status of a function of a unit, and the destination of its messages, for all versions of FMI.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_STATUS_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_STATUS_H

#include <cstring>
#include <functional>
#include <string>

#include <stride/fmi1.h>
#include <stride/fmi2.h>
#include <stride/fmi3.h>

namespace stride::importer {

/// The status codes of all versions; Pending is not in FMI 3.0.
enum class Status { Ok, Warning, Discard, Error, Fatal, Pending };

static_assert(static_cast<int>(Status::Ok) == fmi3OK && fmi3OK + 0 == fmi2OK + 0);
static_assert(static_cast<int>(Status::Warning) == fmi3Warning &&
              fmi3Warning + 0 == fmi2Warning + 0);
static_assert(static_cast<int>(Status::Discard) == fmi3Discard &&
              fmi3Discard + 0 == fmi2Discard + 0);
static_assert(static_cast<int>(Status::Error) == fmi3Error && fmi3Error + 0 == fmi2Error + 0);
static_assert(static_cast<int>(Status::Fatal) == fmi3Fatal && fmi3Fatal + 0 == fmi2Fatal + 0);
static_assert(static_cast<int>(Status::Pending) == fmi2Pending &&
              fmi2Pending + 0 == fmi1Pending + 0);
static_assert(static_cast<int>(Status::Discard) == fmi1Discard);

/// The status with the number that a unit has given, which may be none of its type.
template <class UnitStatus>
Status status_of(const UnitStatus& given) noexcept {
  int number = 0;
  static_assert(sizeof number == sizeof given);
  std::memcpy(&number, &given, sizeof number);
  return static_cast<Status>(number);
}

/// Receives what units log. It may be called from any thread that a unit has.
using LogSink = std::function<void(const std::string& unit, Status status,
                                   const std::string& category, const std::string& message)>;

}  // namespace stride::importer

#endif
