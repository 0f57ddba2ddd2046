#include "master/host/last_words.h"

#include <algorithm>

#include <fmt/format.h>

namespace stride::host {

void LastWords::add(const char* how, std::string_view line) {
  if (lines_.size() == kMost) lines_.pop_front();
  std::string text(line.substr(0, kLongest));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' '; }, ' ');
  lines_.push_back(fmt::format("it {}: {}", how, text));
}

std::string LastWords::text() const {
  std::string text;
  for (const std::string& line : lines_) text += "\n  " + line;
  return text;
}

}  // namespace stride::host
