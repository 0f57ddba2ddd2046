#include "master/front/cli/program/repeated_options.h"

#include <algorithm>
#include <string_view>

#include "master/base/files/input_file.h"

namespace stride::cli {
namespace {

constexpr std::string_view kRepeated[] = {"--set", "--swap"};

/// The option that this word gives, with its first value or before it; empty if there is none.
std::string_view repeated_option(std::string_view word) {
  const std::string_view name = word.substr(0, word.find('='));
  const auto* const found = std::ranges::find(kRepeated, name);
  return found == std::end(kRepeated) ? std::string_view{} : *found;
}

bool is_assignment(const std::string& word) {
  const std::size_t equals = word.find('=');
  return !word.starts_with('-') && equals != word.npos && equals > 0 && !core::path_exists(word);
}

}  // namespace

std::vector<std::string> with_repeated_options(const std::vector<std::string>& words) {
  std::vector<std::string> all;
  std::string_view option;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view begun = repeated_option(words[i]);
    if (begun.empty() && !option.empty() && is_assignment(words[i])) {
      all.insert(all.end(), {std::string(option), words[i]});
      continue;
    }
    all.push_back(words[i]);
    option = begun;
    const bool has_value = begun.empty() || begun.size() < words[i].size();
    if (!has_value && i + 1 < words.size()) all.push_back(words[++i]);
  }
  return all;
}

}  // namespace stride::cli
