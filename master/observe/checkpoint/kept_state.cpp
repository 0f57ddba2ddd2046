#include "master/observe/checkpoint/kept_state.h"

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::checkpoint {
namespace {

std::string with_separators(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string size_text(std::size_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

std::string steps_text(std::uint64_t steps) {
  return fmt::format("replayed: {} step{}", with_separators(steps), steps == 1 ? "" : "s");
}

}  // namespace

std::string to_text(const KeptState& kept) {
  const std::string since = core::to_text(kept.since);
  if (!kept.serialized_bytes) {
    return fmt::format("{} since {} s", steps_text(kept.repeated_steps), since);
  }
  const std::string size = size_text(*kept.serialized_bytes);
  if (kept.repeated_steps == 0) return fmt::format("serialised, {}", size);
  return fmt::format("serialised at {} s, {}, then {}", since, size,
                     steps_text(kept.repeated_steps));
}

}  // namespace stride::checkpoint
