#include "master/util/xml/words.h"

#include <algorithm>

namespace stride::xml {

std::vector<std::string_view> split(std::string_view list) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t first = list.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return words;
    list.remove_prefix(first);
    const std::size_t size = std::min(list.find_first_of(kBlanks), list.size());
    words.push_back(list.substr(0, size));
    list.remove_prefix(size);
  }
}

}  // namespace stride::xml
