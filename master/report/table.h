#ifndef STRIDE_MASTER_REPORT_TABLE_H
#define STRIDE_MASTER_REPORT_TABLE_H

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/files/csv_reader.h"

namespace stride::report {

/// A results file whose first row names its columns.
class Table {
 public:
  /// Reads the header. Throws core::Error (Input), as its functions do.
  explicit Table(const std::filesystem::path& file) : Table(core::CsvReader(file)) {}
  explicit Table(core::CsvReader reader);

  const std::vector<std::string>& columns() const { return columns_; }
  /// The index of a column; nothing, or an error, where there is none of this name.
  std::optional<std::size_t> find(const std::string& column) const;
  std::size_t place(const std::string& column) const;

  /// Throws core::Error (Input) where there is no header: the file of a run that was killed before
  /// its first lines were written.
  void require_header() const;

  /// The next row, of which each must have as many fields as the header.
  bool next();
  /// Rows that are left out: where the first one is, and words about all.
  struct Unread {
    std::size_t line = 0;
    std::string text{};
  };
  /// Calls take() for each row until it returns false. Rows with another number of fields, or for
  /// which take() throws core::Error (Input), are left out, as is the rest behind quotation marks
  /// that are out of place. Returns these; nothing if there are none.
  std::optional<Unread> for_each_row(const std::function<bool()>& take);
  const std::vector<core::CsvReader::Field>& fields() const { return reader_.fields(); }
  const core::CsvReader::Field& field(std::size_t place) const { return fields()[place]; }
  /// Where the present row begins, counted from 1.
  std::size_t line() const { return reader_.line(); }
  Time time(std::size_t place) const;

  /// After the last row: the line that was cut off behind it; nothing if none was.
  std::optional<std::size_t> cut() const;
  [[noreturn]] void fail(std::size_t place, const std::string& message) const;

 private:
  void check_field_count() const;

  core::CsvReader reader_;
  std::vector<std::string> columns_;
};

}  // namespace stride::report

#endif
