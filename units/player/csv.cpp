#include "units/player/csv.h"

#include <algorithm>

namespace player {

bool CsvRows::next() {
  line_ = next_line_;
  if (at_end()) return false;
  fields_.clear();
  is_quoted_.clear();
  while (true) {
    is_quoted_.push_back(text_[at_] == '"');
    fields_.push_back(text_[at_] == '"' ? take_quoted() : take_field());
    if (fields_.back().find('\0') != std::string::npos) fail("a field has a NUL character");
    if (text_.compare(at_, 2, "\r\n") == 0) ++at_;
    if (at_end()) fail("the line is cut off");
    if (text_[at_] == '\n') break;
    if (text_[at_] != ',') fail("behind a quoted text a comma or the end of the line is expected");
    if (++at_ == text_.size()) fail("the line is cut off");
  }
  ++at_;
  ++next_line_;
  return true;
}

std::string CsvRows::take_field() {
  const std::size_t end = std::min(text_.find_first_of(",\n", at_), text_.size());
  const bool has_return = text_.compare(end, 1, "\n") == 0 && end > at_ && text_[end - 1] == '\r';
  const std::string field = text_.substr(at_, end - at_ - (has_return ? 1 : 0));
  if (field.find('"') != std::string::npos) {
    fail("the field '" + field +
         "' has a quotation mark within; expected it doubled in a quoted text");
  }
  at_ += field.size();
  return field;
}

std::string CsvRows::take_quoted() {
  std::string field;
  while (true) {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string::npos) fail("the line is cut off within a quoted text");
    field.append(text_, at_ + 1, end - at_ - 1);
    at_ = end + 1;
    if (at_ == text_.size() || text_[at_] != '"') break;
    field += '"';
  }
  next_line_ += static_cast<int>(std::count(field.begin(), field.end(), '\n'));
  return field;
}

void CsvRows::fail_at(int line, const std::string& message) const {
  throw std::runtime_error(file_ + ":" + std::to_string(line) + ": " + message);
}

}  // namespace player
