#include "master/study/campaign/definition/value_files.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/csv_reader.h"
#include "master/base/message_text.h"
#include "master/base/text/readable_text.h"
#include "master/system/ssp/parameters.h"

namespace stride::campaign {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// A field that each file and each shell can have.
std::string text_of(const core::CsvReader& reader, const core::CsvReader::Field& field) {
  std::string text = field.value();
  if (text.find('\0') != std::string::npos) reader.fail("a field has a byte of value 0");
  if (!core::is_utf8(text)) reader.fail("a field has bytes that are no UTF-8");
  return text;
}

/// The names in the first row, with a place for errors.
std::vector<std::string> header_of(core::CsvReader& reader) {
  if (!reader.next()) reader.fail("the file has no row; the first one has the parameters' names");
  std::vector<std::string> names;
  for (const core::CsvReader::Field& field : reader.fields()) {
    std::string name = text_of(reader, field);
    if (names.empty() && name.starts_with(kByteOrderMark)) name.erase(0, kByteOrderMark.size());
    if (name.empty()) reader.fail("a column has no name");
    if (std::ranges::find(names, name) != names.end()) {
      reader.fail(fmt::format("two columns are called '{}'", core::name_text(name)));
    }
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

void ValueFiles::add(const std::filesystem::path& file, const core::Location& where,
                     std::vector<std::string>& warnings) {
  if (file.extension() == ".csv") return add_csv(file);
  if (file.extension() == ".ssv") return add_ssv(file, warnings);
  core::fail_input({.where = where}, fmt::format("'{}' is neither a .csv nor a .ssv",
                                                 core::name_text(file.string())));
}

std::size_t ValueFiles::column(const std::string& name, const core::Location& where) {
  const auto [entry, is_new] = columns_.emplace(name, columns_.size());
  if (is_new) table_.parameters.push_back(parameters_.add(name, where));
  return entry->second;
}

void ValueFiles::add_csv(const std::filesystem::path& file) {
  core::CsvReader reader(file);
  std::vector<std::size_t> places;
  for (const std::string& name : header_of(reader))
    places.push_back(column(name, {file.string(), 1}));
  while (reader.next()) {
    const auto& fields = reader.fields();
    if (fields.size() != places.size()) {
      reader.fail(
          fmt::format("the row has {} fields, the first one has {}", fields.size(), places.size()));
    }
    const core::Location where{file.string(), static_cast<int>(reader.line())};
    ValueTable::Row row{std::vector<Text>(columns_.size()), where};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].text.empty() && !fields[i].is_quoted) continue;
      row.values[places[i]] = text_of(reader, fields[i]);
    }
    table_.rows.push_back(std::move(row));
  }
  if (reader.is_cut()) {
    reader.fail("the last line has no line feed, as if it were cut off");
  }
}

void ValueFiles::add_ssv(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  ValueTable::Row row{{}, {file.string(), 1}};
  for (const ssp::ParameterValue& value : ssp::read_parameter_set(file, warnings)) {
    if (!value.unit.name.empty()) {
      core::fail_input({.where = value.where},
                       fmt::format("the value of '{}' is in '{}': a campaign's values are in the "
                                   "units of measure of their variables",
                                   core::name_text(value.name), core::name_text(value.unit.name)),
                       "convert the value, and leave the unit of measure out");
    }
    const std::size_t place = column(value.name, value.where);
    row.values.resize(columns_.size());
    row.values[place] = value.value;
  }
  table_.rows.push_back(std::move(row));
}

ValueTable ValueFiles::table() && {
  for (ValueTable::Row& row : table_.rows) row.values.resize(columns_.size());
  return std::move(table_);
}

}  // namespace stride::campaign
