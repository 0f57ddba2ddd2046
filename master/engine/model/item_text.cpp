#include "master/engine/model/item_text.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/text/words.h"

namespace stride::core {
namespace {

using Words = std::vector<std::string>;

/// The names of items, longest first, and their numbers.
std::vector<Words> known_elements(const EnumerationItems& items) {
  std::vector<Words> known;
  for (const auto& [name, number] : items) {
    known.push_back(words_of(name));
    known.push_back({std::to_string(number)});
  }
  std::ranges::stable_sort(known, std::ranges::greater{}, &Words::size);
  return known;
}

bool begins_with(std::span<const std::string> words, const Words& element) {
  return !element.empty() && words.size() >= element.size() &&
         std::ranges::equal(words.first(element.size()), element);
}

/// How many words the first element has.
std::size_t first_element(std::span<const std::string> words, const std::vector<Words>& known) {
  const auto is_first = [&](const Words& element) { return begins_with(words, element); };
  const auto longest = std::ranges::find_if(known, is_first);
  if (longest == known.end() || longest->size() == 1) return 1;
  const auto other = std::find_if(longest + 1, known.end(), is_first);
  if (other != known.end() && other->size() < longest->size()) {
    throw std::invalid_argument(fmt::format(
        "'{}' may be the item '{}' or begin with '{}'; give each element a value of its "
        "own, such as x[1]",
        fmt::join(*longest, " "), fmt::join(*longest, " "), fmt::join(*other, " ")));
  }
  return longest->size();
}

}  // namespace

std::string item_text(const EnumerationItems& items) {
  std::vector<std::string> texts;
  for (const auto& [item, number] : items) texts.push_back(fmt::format("{} ({})", item, number));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string item_name(std::int64_t number, const EnumerationItems& items) {
  const auto found = std::ranges::find(items, number, &EnumerationItems::value_type::second);
  return found != items.end() ? found->first : std::to_string(number);
}

std::optional<std::int64_t> item_number(const std::string& text, const EnumerationItems& items) {
  const Words words = words_of(text);
  const auto named = std::ranges::find_if(
      items, [&](const auto& item) { return item.first == text || words_of(item.first) == words; });
  if (named != items.end()) return named->second;
  const auto numbered = std::ranges::find_if(
      items, [&](const auto& item) { return std::to_string(item.second) == text; });
  return numbered != items.end() ? std::optional(numbered->second) : std::nullopt;
}

std::string numbers_as_names(const std::string& text, const EnumerationItems& items) {
  std::string named;
  for (const std::string& word : words_of(text)) {
    const auto item = std::ranges::find_if(
        items, [&](const auto& known) { return std::to_string(known.second) == word; });
    if (item == items.end()) {
      throw std::invalid_argument(fmt::format(
          "'{}' is not the number of an item, expected one of {}", word, item_text(items)));
    }
    named += (named.empty() ? "" : " ") + item->first;
  }
  return named;
}

std::vector<std::string> item_words(const std::string& text, const EnumerationItems& items) {
  const Words words = words_of(text);
  for (const auto& [name, number] : items) {
    if (words_of(name) == words) return {name};
  }
  const bool has_blanks = std::ranges::any_of(items, [](const auto& item) {
    return item.first.find_first_of(" \t\r\n") != std::string::npos;
  });
  if (!has_blanks) return words;
  const std::vector<Words> known = known_elements(items);
  Words elements;
  for (std::span<const std::string> rest = words; !rest.empty();) {
    const std::size_t size = first_element(rest, known);
    elements.push_back(fmt::format("{}", fmt::join(rest.first(size), " ")));
    rest = rest.subspan(size);
  }
  return elements;
}

}  // namespace stride::core
