#include "master/engine/model/system/known_names.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/engine/model/array_element.h"

namespace stride::core {
namespace {

bool has_free_value(const Variable& variable) {
  const auto has_sign = [](const auto& item) { return item.first.find('=') != item.first.npos; };
  return variable.type == ValueType::String || std::ranges::any_of(variable.items, has_sign);
}

Assignment split_at(const std::string& text, std::size_t end) {
  if (end >= text.size()) return {text, std::nullopt};
  return {text.substr(0, end), text.substr(end + 1)};
}

}  // namespace

std::string with_component(const std::string& alone, const std::string& name) {
  return alone.empty() || name.starts_with(alone + ".") ? name : alone + "." + name;
}

KnownNames::KnownNames(std::span<const std::string> components) {
  for (const std::string& component : components) add(component, true);
}

KnownNames::KnownNames(const System& system, const std::string& alone) {
  for (const Component& component : system.components()) {
    add(component.name + ".", *component.description);
    if (component.name == alone) stand_alone(alone, *component.description);
  }
}

void KnownNames::add(const std::string& name, bool has_free_value) {
  names_[name] |= has_free_value;
  if (const auto element = indexed_name(name)) names_[element->array] |= has_free_value;
}

void KnownNames::add(const std::string& prefix, const UnitDescription& description) {
  for (const Variable& variable : description.variables) {
    const bool is_free = has_free_value(variable);
    add(prefix + variable.name, is_free);
    for (const std::string& alias : variable.aliases) add(prefix + alias, is_free);
  }
}

void KnownNames::stand_alone(const std::string& component, const UnitDescription& description) {
  alone_ = component;
  add("", description);
}

std::optional<bool> KnownNames::find(const std::string& name) const {
  auto found = names_.find(name);
  if (found == names_.end()) {
    const auto element = indexed_name(name);
    if (element) found = names_.find(element->array);
  }
  return found == names_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<std::size_t> KnownNames::known_ends(const std::string& text,
                                                bool may_lack_value) const {
  std::vector<std::size_t> ends;
  for (std::size_t end = text.find('='); end != text.npos; end = text.find('=', end + 1)) {
    if (find(text.substr(0, end))) ends.push_back(end);
  }
  if (may_lack_value && find(text)) ends.push_back(text.size());
  return ends;
}

bool KnownNames::is_plausible(const std::string& text, std::size_t end) const {
  return text.find('=', end + 1) == text.npos || find(text.substr(0, end)).value();
}

Assignment KnownNames::split(const std::string& option, const std::string& text,
                             bool may_lack_value) const {
  Assignment assignment = split_at(text, end_of_name(option, text, may_lack_value));
  if (!assignment.name.empty()) assignment.name = with_component(alone_, assignment.name);
  return assignment;
}

std::size_t KnownNames::end_of_name(const std::string& option, const std::string& text,
                                    bool may_lack_value) const {
  const std::vector<std::size_t> ends = known_ends(text, may_lack_value);
  if (ends.empty()) return text.find('=');
  for (const std::size_t end : ends) {
    if (end == ends.back() || !is_plausible(text, end)) continue;
    fail_input({},
               fmt::format("{} {}: this may be for '{}' or for '{}'", option, text,
                           text.substr(0, end), text.substr(0, ends.back())),
               "write it into a file: a parameter set for --parameters, or the scenario");
  }
  return ends.back();
}

}  // namespace stride::core
