#ifndef STRIDE_MASTER_FRONT_CLI_TERMINAL_TABLE_H
#define STRIDE_MASTER_FRONT_CLI_TERMINAL_TABLE_H

#include <cstddef>
#include <string>
#include <vector>

namespace stride::cli {

/// The width of the terminal of standard output, in characters; 120 if it is not a terminal.
std::size_t output_width();

/// A human-readable text table: a header, a line under it, and rows; columns as wide as they need.
class Table {
 public:
  enum class Align { Left, Right };
  struct Column {
    std::string title;
    Align align = Align::Left;
    bool is_cut = false;  ///< if the table would be too wide
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// One text per column.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::size_t size() const { return rows_.size(); }
  /// The lines, each indented by two blanks and ended by a newline; `width` characters wide at
  /// most, as far as columns may be cut.
  std::string text(std::size_t width = kNoLimit) const;

  static constexpr std::size_t kNoLimit = std::string::npos;

 private:
  std::vector<std::size_t> widths(std::size_t width) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace stride::cli

#endif
