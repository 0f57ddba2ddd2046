#include "master/study/compare/criteria/selection.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/glob.h"
#include "master/base/text/suggest.h"

namespace stride::compare {
namespace {

bool is_one_meant(std::span<const std::string> patterns, const std::string& name) {
  return std::ranges::any_of(patterns,
                             [&](const std::string& pattern) { return is_meant(pattern, name); });
}

void require_each(const char* option, std::span<const std::string> patterns,
                  std::span<const std::string> names) {
  for (const std::string& pattern : patterns) {
    const bool is_used = std::ranges::any_of(
        names, [&](const std::string& name) { return is_meant(pattern, name); });
    if (is_used) continue;
    core::fail_input(
        {}, fmt::format("{} '{}' is no signal and no message of either run", option, pattern),
        core::suggestion(pattern, names));
  }
}

}  // namespace

bool is_meant(const std::string& pattern, const std::string& name) {
  return core::means(pattern, name) || name.starts_with(pattern + "[");
}

bool Selection::has(const std::string& name) const {
  return (only_.empty() || is_one_meant(only_, name)) && !is_one_meant(ignored_, name);
}

void Selection::require_use(std::span<const std::string> names) const {
  require_each("--only", only_, names);
  require_each("--ignore", ignored_, names);
}

}  // namespace stride::compare
