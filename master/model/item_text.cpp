#include "master/model/item_text.h"

#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::core {

std::string item_text(const EnumerationItems& items) {
  std::vector<std::string> texts;
  for (const auto& [item, number] : items) texts.push_back(fmt::format("{} ({})", item, number));
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace stride::core
