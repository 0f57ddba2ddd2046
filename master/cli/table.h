#ifndef STRIDE_MASTER_CLI_TABLE_H
#define STRIDE_MASTER_CLI_TABLE_H

#include <string>
#include <vector>

namespace stride::cli {

/// A text table for people: a header, a line under it, and rows; columns as wide as they need.
class Table {
 public:
  enum class Align { Left, Right };
  struct Column {
    std::string title;
    Align align = Align::Left;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// One text per column.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::size_t size() const { return rows_.size(); }
  /// The lines, each indented by two blanks and ended by a newline.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace stride::cli

#endif
