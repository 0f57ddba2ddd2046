#include "master/system/plan/split_option.h"

#include <string_view>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"

namespace stride::scenario {
namespace {

/// Of what is written with another sign than '='.
std::string assignment_hint(const std::string& option, const std::string& text) {
  constexpr std::string_view kSigns = " :\t";
  const std::size_t sign = text.find_first_of(kSigns);
  const std::size_t value = text.find_first_not_of(kSigns, sign);
  if (sign == 0 || sign == text.npos || value == text.npos) return "";
  return fmt::format("write {} {}={}", option, text.substr(0, sign), text.substr(value));
}

}  // namespace

std::pair<std::string, std::string> split_option(const std::string& option, const std::string& text,
                                                 const std::string& form,
                                                 const core::KnownNames& names) {
  auto [name, value] = names.split(option, text, false);
  if (value && !name.empty()) return {std::move(name), *std::move(value)};
  core::fail_input({}, fmt::format("{} {}: expected {}", option, text, form),
                   assignment_hint(option, text));
}

std::optional<ComponentFile> split_existing_file(const std::string& option,
                                                 const std::string& text) {
  core::KnownNames names;
  for (std::size_t end = text.find('='); end != text.npos; end = text.find('=', end + 1)) {
    if (core::path_exists(text.substr(end + 1))) names.add(text.substr(0, end), true);
  }
  return split_component_file(option, text, names);
}

std::optional<ComponentFile> split_component_file(const std::string& option,
                                                  const std::string& text,
                                                  const core::KnownNames& names) {
  const auto [name, file] = names.split(option, text, false);
  if (name.empty() || !file || file->empty()) return std::nullopt;
  return ComponentFile{name, *file};
}

ComponentFile component_file(const std::string& option, const std::string& text,
                             const std::string& form, const core::KnownNames& names) {
  const auto [name, file] = split_option(option, text, form, names);
  if (!file.empty()) return {name, file};
  core::fail_input({}, fmt::format("{} {}: no file is named", option, text));
}

}  // namespace stride::scenario
