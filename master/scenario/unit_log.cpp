#include "master/scenario/unit_log.h"

#include <spdlog/spdlog.h>

#include "master/isolation/host_options.h"

namespace stride::scenario {
namespace {

/// A discarded step is retried, so it is not a failure.
spdlog::level::level_enum level(importer::Status status) {
  switch (status) {
    case importer::Status::Ok:
    case importer::Status::Discard:
    case importer::Status::Pending:
      return spdlog::level::info;
    case importer::Status::Warning:
      return spdlog::level::warn;
    default:
      return spdlog::level::err;
  }
}

}  // namespace

UnitLog::~UnitLog() {
  for (const auto& [unit, count] : counts_) {
    if (count <= kMostShown) continue;
    spdlog::warn("unit '{}': {} more warnings and errors of it were not shown", unit,
                 count - kMostShown);
  }
}

void UnitLog::write(const std::string& unit, importer::Status status, const std::string& category,
                    const std::string& message) {
  const spdlog::level::level_enum of_message = level(status);
  if (!spdlog::should_log(of_message)) return;
  const bool may_be_many = category != "stride" && of_message != spdlog::level::info;
  if (may_be_many && !spdlog::should_log(spdlog::level::info) && !is_shown(unit)) return;
  spdlog::log(of_message, "unit '{}'{}: {}", unit,
              category == isolation::kPrinted ? " printed" : "", message);
}

/// Counts it.
bool UnitLog::is_shown(const std::string& unit) {
  const std::lock_guard lock(mutex_);
  const std::size_t count = ++counts_[unit];
  if (count == kMostShown + 1) {
    spdlog::warn(
        "unit '{}': its warnings and errors from here on are only counted; --verbose shows "
        "all of them",
        unit);
  }
  return count <= kMostShown;
}

}  // namespace stride::scenario
