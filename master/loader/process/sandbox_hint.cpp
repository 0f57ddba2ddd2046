#include "master/loader/process/sandbox_hint.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace stride::isolation {
namespace {

/// EACCES and EPERM, as programs in various languages put them.
constexpr std::array<std::string_view, 6> kDenied{
    "ermission denied", "not permitted", "EACCES", "EPERM", "rrno 13", "rrno 1]"};

bool looks_denied(std::string_view text) {
  return std::ranges::any_of(
      kDenied, [&](std::string_view words) { return text.find(words) != std::string_view::npos; });
}

}  // namespace

std::string sandbox_hint(std::string_view text, const std::string& unit, const HostOptions& host) {
  if (!host.is_sandboxed || !looks_denied(text)) return {};
  std::string folders;
  for (const std::filesystem::path& folder : host.writable) folders += folder.string() + ", ";
  return fmt::format(
      "it runs in a sandbox: it has no network, and can write to {}its resources and a temporary "
      "folder only; whether that is why, it shows with --no-sandbox, or "
      "<stride:Host components=\"{}\" sandbox=\"false\"/>",
      folders, unit);
}

}  // namespace stride::isolation
