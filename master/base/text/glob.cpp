#include "master/base/text/glob.h"

#include <fnmatch.h>

namespace stride::core {

bool matches_glob(const std::string& pattern, const std::string& text) {
  return ::fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

bool means(const std::string& pattern, const std::string& name) {
  return pattern == name || matches_glob(pattern, name);
}

bool is_glob(const std::string& pattern) {
  return pattern.find_first_of("*?[\\") != std::string::npos;
}

}  // namespace stride::core
