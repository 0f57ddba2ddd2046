#include "master/scenario/host_settings.h"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "master/util/time_text.h"
#include "master/util/xml/words.h"

namespace stride::io {
namespace {

constexpr std::uint64_t kMebibyte = 1024 * 1024;

template <class T>
void take(std::optional<T>& mine, const std::optional<T>& other) {
  if (other) mine = other;
}

}  // namespace

void HostSettings::override_with(const HostSettings& other) {
  if (other.process) where = other.where;
  take(process, other.process);
  take(call_limit, other.call_limit);
  take(memory_limit, other.memory_limit);
  take(sandbox, other.sandbox);
  take(snapshots, other.snapshots);
}

std::vector<HostSettings> HostRules::settings(std::span<const std::string> components) const {
  std::vector<HostSettings> settings(components.size());
  for (const HostRule& rule : rules) {
    for (const std::size_t i : select_components(components, {&rule.components, 1})) {
      settings[i].override_with(rule.settings);
    }
  }
  return settings;
}

std::chrono::milliseconds parse_call_limit(std::string_view text) {
  const Duration limit = parse_seconds(text);
  if (limit <= Duration::zero()) throw std::invalid_argument("a time limit must be above 0 s");
  return std::chrono::ceil<std::chrono::milliseconds>(limit);
}

std::uint64_t parse_memory_limit(std::string_view text) {
  const auto number = xml::to_number<std::uint64_t>(text);
  const bool fits =
      number && *number > 0 && *number <= std::numeric_limits<std::uint64_t>::max() / kMebibyte;
  if (!fits) {
    throw std::invalid_argument(
        fmt::format("'{}' is no whole number of MiB; expected at least 1", text));
  }
  return *number * kMebibyte;
}

}  // namespace stride::io
