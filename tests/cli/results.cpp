#include "tests/cli/results.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

namespace stride::tests {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(',', begin);
    fields.push_back(line.substr(begin, end - begin));
    if (end == std::string::npos) return fields;
    begin = end + 1;
  }
}

}  // namespace

Csv::Csv(const std::filesystem::path& file) : file_(file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  if (!std::getline(stream, line)) throw std::runtime_error(file.string() + " cannot be read");
  titles_ = fields_of(line);
  while (std::getline(stream, line)) {
    if (stream.eof()) throw std::runtime_error(file.string() + " breaks off in its last line");
    rows_.push_back(fields_of(line));
    if (rows_.back().size() == titles_.size()) continue;
    throw std::runtime_error(file.string() + " has a row of another length: " + line);
  }
}

bool Csv::has(const std::string& title) const {
  return std::find(titles_.begin(), titles_.end(), title) != titles_.end();
}

std::size_t Csv::column(const std::string& title) const {
  const auto found = std::find(titles_.begin(), titles_.end(), title);
  if (found == titles_.end()) {
    throw std::runtime_error(file_.string() + " has no column '" + title + "'");
  }
  return static_cast<std::size_t>(found - titles_.begin());
}

double Csv::number(std::size_t row, std::size_t column) const {
  const std::string& text = rows_.at(row).at(column);
  if (text == "true") return 1;
  if (text == "false") return 0;
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc{} && result.ptr == end) return value;
  throw std::runtime_error(file_.string() + ": '" + text + "' is not a number");
}

std::vector<double> Csv::numbers(const std::string& title) const {
  const std::size_t at = column(title);
  std::vector<double> values;
  for (std::size_t i = 0; i < size(); ++i) values.push_back(number(i, at));
  return values;
}

std::size_t Csv::row_at(const std::string& time) const {
  for (std::size_t i = 0; i < size(); ++i) {
    if (rows_[i].front() == time) return i;
  }
  throw std::runtime_error(file_.string() + " has no row at " + time + " s");
}

}  // namespace stride::tests
