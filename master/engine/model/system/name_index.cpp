#include "master/engine/model/system/name_index.h"

#include <utility>

#include "master/base/text/composed_letters.h"

namespace stride::core {

/// Of several variables of one name, the first is kept.
NameIndex::Variables::Variables(const UnitDescription& description) {
  for (std::size_t i = 0; i < description.variables.size(); ++i) {
    places.emplace(description.variables[i].name, i);
    for (const std::string& alias : description.variables[i].aliases) places.emplace(alias, i);
  }
  for (const auto& [name, place] : std::map(places)) {
    std::string other = composed(name);
    if (other != name) places.emplace(composed_names.emplace_back(std::move(other)), place);
  }
}

bool NameIndex::add(const std::string& component,
                    std::shared_ptr<const UnitDescription> description) {
  const auto [entry, is_new] = descriptions_.try_emplace(std::move(description));
  if (is_new) entry->second = std::make_shared<const Variables>(*entry->first);
  const std::size_t number = variables_.size();
  variables_.push_back(entry->second);
  return components_.emplace(component, number).second;
}

std::optional<std::size_t> NameIndex::component(const std::string& name) const {
  const auto found = components_.find(name);
  if (found == components_.end()) return std::nullopt;
  return found->second;
}

std::optional<std::size_t> NameIndex::variable(std::size_t component, std::string_view name) const {
  const auto& variables = variables_[component]->places;
  auto found = variables.find(name);
  if (found == variables.end()) found = variables.find(composed(name));
  if (found == variables.end()) return std::nullopt;
  return found->second;
}

std::vector<std::pair<std::string_view, std::size_t>> NameIndex::variables(
    std::size_t component, std::string_view beginning) const {
  const auto& variables = variables_[component]->places;
  std::vector<std::pair<std::string_view, std::size_t>> found;
  for (auto it = variables.lower_bound(beginning);
       it != variables.end() && it->first.starts_with(beginning); ++it) {
    found.emplace_back(*it);
  }
  return found;
}

}  // namespace stride::core
