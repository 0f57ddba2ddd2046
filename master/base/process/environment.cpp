#include "master/base/process/environment.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/error.h"

namespace stride::core {
namespace {

/// Calls visit(entry) for each of the present entries.
template <class Visit>
void for_each_entry(Visit&& visit) {
  if (environ == nullptr) return;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (!text.starts_with("STRIDE_RESULTS=")) visit(text);
  }
}

bool is_present(const std::vector<std::string>& entries) {
  std::size_t count = 0;
  bool is_same = true;
  for_each_entry([&](std::string_view text) {
    is_same = is_same && count < entries.size() && entries[count] == text;
    ++count;
  });
  return is_same && count == entries.size();
}

using Variables = std::map<std::string, std::string>;

void add_variable(Variables& variables, std::string_view entry) {
  const std::size_t end = entry.find('=');
  if (end == std::string_view::npos) return;
  variables.emplace(entry.substr(0, end), entry.substr(end + 1));
}

/// The first ones by name: a unit may have cleared them all.
std::string described(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 4;
  return fmt::format("the environment variable{} {}", names.size() > 1 ? "s" : "",
                     abridged(names, kMostNames));
}

}  // namespace

Environment::Environment() {
  for_each_entry([&](std::string_view text) { entries_.emplace_back(text); });
}

void Environment::restore(std::vector<std::string>& changes) const {
  if (is_present(entries_)) return;  // in the same order, which is nearly always so
  Variables before, now;
  for (const std::string& entry : entries_) add_variable(before, entry);
  for_each_entry([&](std::string_view text) { add_variable(now, text); });
  std::vector<std::string> names;
  for (const auto& [name, value] : now) {
    if (before.contains(name)) continue;
    ::unsetenv(name.c_str());
    names.push_back(name);
  }
  for (const auto& [name, value] : before) {
    const auto found = now.find(name);
    if (found != now.end() && found->second == value) continue;
    ::setenv(name.c_str(), value.c_str(), 1);
    names.push_back(name);
  }
  if (!names.empty()) changes.push_back(described(names));
}

}  // namespace stride::core
