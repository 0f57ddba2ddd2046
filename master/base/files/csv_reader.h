// A file of comma-separated fields (RFC 4180), row by row.
#ifndef STRIDE_MASTER_BASE_FILES_CSV_READER_H
#define STRIDE_MASTER_BASE_FILES_CSV_READER_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "master/base/files/untrusted_folder.h"

namespace stride::core {

/// Reads a file of any length piece by piece. A last line without a line feed was cut off when its
/// writer was killed; it is ignored.
class CsvReader {
 public:
  struct Field {
    std::string_view text;  ///< as in the file, without the quotation marks around it
    bool is_quoted = false;
    /// The text without doubled quotation marks.
    std::string value() const;
  };

  /// Throws core::Error (Input) where the file cannot be read or is no regular file.
  explicit CsvReader(std::filesystem::path file);
  /// Of a file that is open; `file` is what errors name.
  CsvReader(std::filesystem::path file, FileStream stream);

  /// Reads the next row; returns whether there is one. Throws core::Error (Input) that names the
  /// line for quotation marks that are out of place, and for a row that is too long to be one.
  bool next();

  /// Of the present row, until the next one is read.
  const std::vector<Field>& fields() const { return fields_; }
  /// Where the present row begins, counted from 1.
  std::size_t line() const { return line_; }
  /// The file has been read to its end, and its last line was cut off.
  bool is_cut() const { return is_cut_; }

  [[noreturn]] void fail(const std::string& message) const;
  /// Of one field of the row; `column` is its name.
  [[noreturn]] void fail(const std::string& column, const std::string& message) const;

 private:
  enum class Row { Whole, Unfinished };

  Row split();
  bool take_quoted(const char*& at, const char* end, Field& field);
  bool refill();

  std::filesystem::path file_;
  FileStream stream_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< what is still to be split
  std::vector<Field> fields_;
  std::size_t line_ = 0;
  std::size_t next_line_ = 1;
  std::size_t feeds_ = 0;  ///< line feeds in the present row
  bool is_cut_ = false;
};

}  // namespace stride::core

#endif
