#include "master/engine/model/array_element.h"

#include <charconv>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/text/counted.h"

namespace stride::core {
namespace {

/// As element_name() writes one: without a sign, blanks and leading zeros.
std::optional<std::size_t> parse_index(std::string_view text) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  const bool is_padded = text.size() > 1 && text.front() == '0';
  if (error != std::errc() || end != text.data() + text.size() || is_padded) return std::nullopt;
  return index;
}

/// "'m' is an array of 2 × 3 elements", for an error.
std::string array_text(const Variable& array) {
  return fmt::format("'{}' is an array of {}", array.name, elements_text(sizes(array)));
}

}  // namespace

std::string element_name(const std::string& array, std::span<const std::size_t> dimensions,
                         std::size_t element) {
  if (dimensions.empty()) return array;
  std::string indices;
  for (auto it = dimensions.rbegin(); it != dimensions.rend(); ++it) {
    indices = fmt::format("{}{}{}", element % *it + 1, indices.empty() ? "" : ",", indices);
    element /= *it;
  }
  return fmt::format("{}[{}]", array, indices);
}

std::string element_name(const Variable& variable, std::size_t element) {
  return element_name(variable.name, sizes(variable), element);
}

std::string dimensions_text(std::span<const std::size_t> dimensions) {
  return fmt::format("{}", fmt::join(dimensions, " × "));
}

std::string elements_text(std::span<const std::size_t> dimensions) {
  const bool is_one = dimensions.size() == 1 && dimensions.front() == 1;
  return dimensions_text(dimensions) + (is_one ? " element" : " elements");
}

std::vector<std::size_t> sizes(const Variable& variable) {
  std::vector<std::size_t> sizes;
  for (const Dimension& dimension : variable.dimensions) sizes.push_back(dimension.size);
  return sizes;
}

std::optional<IndexedName> indexed_name(const std::string& name) {
  const std::size_t bracket = name.rfind('[');
  if (!name.ends_with(']') || bracket == 0 || bracket == std::string::npos) return std::nullopt;
  IndexedName found{name.substr(0, bracket), name.substr(bracket), {}};
  std::string_view rest = std::string_view(found.brackets).substr(1);
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of(",]");
    const std::optional<std::size_t> index = parse_index(rest.substr(0, end));
    if (!index) return IndexedName{found.array, found.brackets, {}};
    found.indices.push_back(*index);
    rest.remove_prefix(end + 1);
  }
  return found;
}

std::size_t element_at(const Variable& array, const IndexedName& name, const Context& context) {
  const std::size_t count = array.dimensions.size();
  if (count == 0) {
    fail_input(context,
               fmt::format("'{}' is a scalar, so it has no element {}", array.name, name.brackets));
  }
  if (name.indices.empty()) {
    fail_input(context,
               fmt::format("{}, and {} names none of them", array_text(array), name.brackets),
               fmt::format("an element is named by a whole number for each dimension, such as "
                           "'{}'; name the whole array, or elements one by one",
                           element_name(array, 0)));
  }
  if (name.indices.size() != count) {
    fail_input(context, fmt::format("{}, so {} expected, and {} has {}", array_text(array),
                                    counted(count, "index is", "indices are"), name.brackets,
                                    name.indices.size()));
  }
  std::size_t element = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t size = array.dimensions[i].size;
    if (name.indices[i] < 1 || name.indices[i] > size) {
      fail_input(context,
                 fmt::format("{}, and the index {} in {} is not from 1 to {}", array_text(array),
                             name.indices[i], name.brackets, size),
                 name.indices[i] == 0 ? "indices start at 1" : "");
    }
    element = element * size + name.indices[i] - 1;
  }
  return element;
}

}  // namespace stride::core
