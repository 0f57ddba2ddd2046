#include "master/report/table.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/util/time_text.h"

namespace stride::report {

Table::Table(CsvReader reader) : reader_(std::move(reader)) {
  if (!reader_.next()) return;
  for (const CsvReader::Field& field : reader_.fields()) columns_.push_back(field.value());
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

bool Table::next() {
  if (!reader_.next()) return false;
  if (fields().size() != columns_.size()) {
    reader_.fail(fmt::format("expected {} fields, as in the header, found {}", columns_.size(),
                             fields().size()));
  }
  return true;
}

std::int64_t Table::time(std::size_t place) const {
  try {
    return core::parse_seconds(field(place).text).count();
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
