#include "master/loader/fmu/library/python_library.h"

#include <algorithm>

#include <dlfcn.h>
#include <fmt/format.h>

namespace stride::importer {

bool is_of_python(std::string_view symbol) {
  symbol.remove_prefix(std::min(symbol.find_first_not_of('_'), symbol.size()));
  const auto is_upper = [](char c) { return c == '_' || (c >= 'A' && c <= 'Z'); };
  return symbol.size() > 2 && symbol.substr(0, 2) == "Py" && is_upper(symbol[2]);
}

bool is_python_library(std::string_view name) {
  return name.substr(name.rfind('/') + 1).starts_with("libpython");
}

std::string load_python() {
  constexpr int kNewest = 30;
  constexpr int kOldest = 6;
  for (int minor = kNewest; minor >= kOldest; --minor) {
    const std::string name = fmt::format("libpython3.{}.so.1.0", minor);
    if (::dlopen(name.c_str(), RTLD_LAZY | RTLD_GLOBAL) != nullptr) return name;
  }
  return "";
}

}  // namespace stride::importer
