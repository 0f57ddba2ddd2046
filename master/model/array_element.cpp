#include "master/model/array_element.h"

#include <fmt/format.h>

namespace stride::core {

std::string element_name(const Variable& variable, std::size_t element) {
  if (variable.dimensions.empty()) return variable.name;
  std::string indices;
  for (auto it = variable.dimensions.rbegin(); it != variable.dimensions.rend(); ++it) {
    indices = fmt::format("{}{}{}", element % it->size + 1, indices.empty() ? "" : ",", indices);
    element /= it->size;
  }
  return fmt::format("{}[{}]", variable.name, indices);
}

}  // namespace stride::core
