#ifndef STRIDE_UNITS_PLAYER_CSV_H
#define STRIDE_UNITS_PLAYER_CSV_H

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace player {

/// The rows of a CSV file (RFC 4180), one by one. A field in quotation marks may hold line feeds;
/// every row ends with one, with or without a carriage return before it. A byte order mark, which
/// spreadsheets write, is no part of the first field.
class CsvRows {
 public:
  CsvRows(const std::string& text, std::string file)
      : text_(text), file_(std::move(file)), at_(text.compare(0, 3, "\xef\xbb\xbf") == 0 ? 3 : 0) {}

  /// Whether there is another row, which is in fields() then. Throws std::runtime_error, as fail()
  /// does, for a last row without its end, and for quotation marks where none may be.
  bool next();
  const std::vector<std::string>& fields() const { return fields_; }
  /// Whether the field is in quotation marks, so that an empty one is a text.
  bool is_quoted(std::size_t field) const { return is_quoted_[field]; }
  /// Where the row begins, from 1 on.
  int line() const { return line_; }
  bool at_end() const { return at_ == text_.size(); }

  /// Throws std::runtime_error "FILE:LINE: message".
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  /// Of another line.
  [[noreturn]] void fail_at(int line, const std::string& message) const;

 private:
  std::string take_field();
  std::string take_quoted();

  const std::string& text_;
  std::string file_;
  std::size_t at_;
  int line_ = 0;
  int next_line_ = 1;
  std::vector<std::string> fields_;
  std::vector<bool> is_quoted_;  ///< by field
};

}  // namespace player

#endif
