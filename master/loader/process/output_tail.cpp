#include "master/loader/process/output_tail.h"

#include <fmt/format.h>

#include "master/base/text/readable_text.h"

namespace stride::isolation {

void OutputTail::add(const char* how, std::string_view line) {
  if (lines_.size() == kMost) lines_.pop_front();
  lines_.push_back(fmt::format("it {}: {}", how, core::readable_text(line, kLongest)));
}

std::string OutputTail::text() const {
  std::string text;
  for (const std::string& line : lines_) text += "\n  " + line;
  return text;
}

}  // namespace stride::isolation
