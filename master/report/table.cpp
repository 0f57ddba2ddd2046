#include "master/report/table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/time_text.h"

namespace stride::report {

Table::Table(core::CsvReader reader) : reader_(std::move(reader)) {
  if (!reader_.next()) return;
  for (const core::CsvReader::Field& field : reader_.fields()) columns_.push_back(field.value());
}

std::optional<std::size_t> Table::find(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t Table::place(const std::string& column) const {
  const auto found = find(column);
  if (!found) reader_.fail(fmt::format("the header has no column '{}'", column));
  return *found;
}

void Table::require_header() const {
  if (!columns_.empty()) return;
  reader_.fail(
      "the file is empty: its run was killed before its first lines were written, or has only "
      "begun");
}

void Table::check_field_count() const {
  if (fields().size() == columns_.size()) return;
  reader_.fail(fmt::format("expected {} fields, as in the header, found {}", columns_.size(),
                           fields().size()));
}

bool Table::next() {
  if (!reader_.next()) return false;
  check_field_count();
  return true;
}

std::optional<Table::Unread> Table::for_each_row(const std::function<bool()>& take) {
  Unread first;
  std::size_t count = 0;
  const auto keep = [&](const core::Error& mistake) {
    if (++count == 1) first = {reader_.line(), mistake.message()};
  };
  try {
    for (bool goes_on = true; goes_on && reader_.next();) {
      try {
        check_field_count();
        goes_on = take();
      } catch (const core::Error& mistake) {
        keep(mistake);
      }
    }
  } catch (const core::Error& mistake) {  // where the next row begins is not known
    keep(mistake);
    first.text += fmt::format("; the rows from line {} on are left out", reader_.line());
    return first;
  }
  if (count == 0) return std::nullopt;
  first.text += count == 1 ? "; this row is left out"
                           : fmt::format("; this row and {} more are left out", count - 1);
  return first;
}

Time Table::time(std::size_t place) const {
  try {
    return core::parse_time(field(place).text);
  } catch (const std::invalid_argument& mistake) {
    fail(place, mistake.what());
  }
}

std::optional<std::size_t> Table::cut() const {
  if (!reader_.is_cut()) return std::nullopt;
  return reader_.line();
}

void Table::fail(std::size_t place, const std::string& message) const {
  reader_.fail(columns_[place], message);
}

}  // namespace stride::report
