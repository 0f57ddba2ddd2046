#include "master/system/scenario/units/unit_log.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>
#include <vector>

#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/loader/process/host_options.h"

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

/// Beside an error of stride it has to be seen that this one is the unit's.
const char* verb(spdlog::level::level_enum level, const std::string& category) {
  if (category == isolation::kPrinted) return " printed";
  return level == spdlog::level::err && category != "stride" ? " logged" : "";
}

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t length_of_number(std::string_view text) {
  const bool begins = std::isdigit(static_cast<unsigned char>(text.front())) != 0;
  if (!begins && text.front() != '-') return 0;
  double number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  return static_cast<std::size_t>(result.ptr - text.data());
}

/// The name of a unit, and nothing that only begins as it does.
bool begins_with_name(std::string_view text, std::string_view name) {
  if (name.empty() || !text.starts_with(name)) return false;
  return text.size() == name.size() || !is_of_word(text[name.size()]);
}

/// The message without its numbers, and without the name of the unit.
std::string kind_of(std::string_view message, std::string_view unit) {
  std::string kind;
  while (!message.empty()) {
    std::size_t size = 0;
    if (begins_with_name(message, unit)) {
      size = unit.size();
      kind += "<unit>";
    } else if (size = length_of_number(message); size > 0) {
      kind += "<number>";
    } else {
      const auto end = std::ranges::find_if_not(message, is_of_word);
      size = std::max<std::size_t>(1, static_cast<std::size_t>(end - message.begin()));
      kind += message.substr(0, size);
    }
    message.remove_prefix(size);
  }
  return kind;
}

/// Enough of a message to find it again.
std::string beginning(const std::string& message) {
  constexpr std::size_t kMost = 80;
  if (message.size() <= kMost) return message;
  return message.substr(0, message.rfind(' ', kMost)) + " …";
}

}  // namespace

UnitLog::~UnitLog() {
  constexpr std::size_t kMostNames = 5;
  for (const auto& [key, kind] : kinds_) {
    if (kind.hidden == 0) continue;
    const std::vector<std::string> others(kind.others.begin(), kind.others.end());
    spdlog::warn(
        "unit '{}': {} of its FMU ({}) logged the same but for numbers, \"{}\"; "
        "messages not shown: {}; --verbose shows them",
        kind.first_unit, core::counted(others.size(), "other instance"),
        core::abridged(others, kMostNames), beginning(kind.first_message), kind.hidden);
  }
  for (const auto& [unit, count] : counts_) {
    if (count <= kMostShown) continue;
    spdlog::warn(
        "unit '{}': {} of it not shown", unit,
        core::counted(count - kMostShown, "more warning or error", "more warnings and errors"));
  }
}

void UnitLog::add_unit(const std::string& unit, const std::string& fmu) {
  fmus_.insert_or_assign(unit, fmu);
}

void UnitLog::write(const std::string& unit, importer::Status status, const std::string& category,
                    const std::string& message) {
  const spdlog::level::level_enum of_message = level(status);
  if (!spdlog::should_log(of_message)) return;
  const bool may_be_many =
      of_message != spdlog::level::info && !spdlog::should_log(spdlog::level::info);
  if (may_be_many && !is_shown(unit, message, category != "stride")) return;
  spdlog::log(of_message, "unit '{}'{}: {}", unit, verb(of_message, category), message);
}

/// `counts`: towards the number that is shown of a unit.
bool UnitLog::is_shown(const std::string& unit, const std::string& message, bool counts) {
  const std::lock_guard lock(mutex_);
  return is_first_of_kind(unit, message) && (!counts || is_within_limit(unit));
}

/// Whether no other instance of the FMU has logged its kind before. Counts it if one has.
bool UnitLog::is_first_of_kind(const std::string& unit, const std::string& message) {
  const auto fmu = fmus_.find(unit);
  if (fmu == fmus_.end()) return true;
  const auto key = std::pair(fmu->second, kind_of(message, unit));
  const auto known = kinds_.find(key);
  if (known == kinds_.end()) {
    if (kinds_.size() < kMostKinds) kinds_.emplace(key, Kind{unit, message, {}, 0});
    return true;
  }
  Kind& kind = known->second;
  if (kind.first_unit == unit) return true;
  kind.others.insert(unit);
  ++kind.hidden;
  return false;
}

/// Counts it.
bool UnitLog::is_within_limit(const std::string& unit) {
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
