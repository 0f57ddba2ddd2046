// events.csv, row by row.
#ifndef STRIDE_MASTER_REPORT_MESSAGE_ROWS_H
#define STRIDE_MASTER_REPORT_MESSAGE_ROWS_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <stride/time.h>

#include "master/report/table.h"

namespace stride::report {

/// A row of events.csv.
struct RecordedMessage {
  Time time;
  std::uint64_t index = 0;
  std::string component;
  std::string variable;
  std::string direction;
  std::string payload;
  std::string content;
};

class MessageRows {
 public:
  /// Reads the header; there may be none in a file of a run that was killed. Throws core::Error
  /// (Input) where the file cannot be read or a column is missing.
  explicit MessageRows(const std::filesystem::path& file);

  Table& table() { return table_; }
  const Table& table() const { return table_; }
  /// Of the present row of the table. Throws core::Error (Input) for a time, an index or a
  /// direction that is none.
  RecordedMessage message() const;

 private:
  Table table_;
  std::size_t time_ = 0, index_ = 0, component_ = 0, variable_ = 0, direction_ = 0, payload_ = 0;
  std::optional<std::size_t> content_;
};

}  // namespace stride::report

#endif
