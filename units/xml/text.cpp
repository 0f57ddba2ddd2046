#include "units/xml/text.h"

#include <stride/value_text.h>

namespace xml {

std::string shortest(double number) {
  std::string text;
  stride::append_value(text, number);
  return text;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "'" : ", '") + word + "'";
  return list;
}

}  // namespace xml
