#ifndef STRIDE_MASTER_REPORT_NOTES_H
#define STRIDE_MASTER_REPORT_NOTES_H

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/report/table.h"

namespace stride::report {

/// What is missing, cut off or left out of results: "signals.csv:7: TEXT". Files go by their names
/// in the folder, wherever that is, so that the same results make the same page.
class Notes {
 public:
  explicit Notes(std::filesystem::path folder, bool is_going_on = false)
      : folder_(std::move(folder)), is_going_on_(is_going_on) {}

  void add(const std::filesystem::path& file, const std::string& text) {
    texts_.push_back(fmt::format("{}: {}", name(file), text));
  }
  /// Of a file that is left out, since it has a mistake.
  void add_unread(const std::filesystem::path& file, const core::Error& mistake) {
    const int line = mistake.context().where.line;
    texts_.push_back(fmt::format("{}{}: {}; the report is without what it holds", name(file),
                                 line > 0 ? fmt::format(":{}", line) : "", mistake.message()));
  }
  /// Of rows that are left out.
  void add_unread(const std::filesystem::path& file, const std::optional<Table::Unread>& rows) {
    if (rows) texts_.push_back(fmt::format("{}:{}: {}", name(file), rows->line, rows->text));
  }
  /// Of a file whose last line, if any, was cut off. Of a run that goes on it is still to be
  /// written.
  void add_cut(const std::filesystem::path& file, std::optional<std::size_t> line) {
    if (!line || is_going_on_) return;
    texts_.push_back(
        fmt::format("{}:{}: the last line was cut off and is left out", name(file), *line));
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::string name(const std::filesystem::path& file) const {
    return file.lexically_relative(folder_).string();
  }

  std::filesystem::path folder_;
  bool is_going_on_;
  std::vector<std::string> texts_;
};

}  // namespace stride::report

#endif
