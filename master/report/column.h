// A recorded signal in memory.
#ifndef STRIDE_MASTER_REPORT_COLUMN_H
#define STRIDE_MASTER_REPORT_COLUMN_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <variant>
#include <vector>

#include "master/base/files/csv_reader.h"
#include "master/engine/model/description.h"

namespace stride::report {

/// What run.json contains about a column.
struct SignalInfo {
  std::string name;
  std::string unit;
  core::ValueType type = core::ValueType::Float64;
  bool is_continuous = true;
};

/// Texts, of which many are equal: each is kept once.
class Texts {
 public:
  void add(const std::string& text);
  const std::vector<std::string>& distinct() const { return distinct_; }
  const std::vector<std::int32_t>& indices() const { return indices_; }
  std::size_t size() const { return indices_.size(); }
  /// Of the rows from `first` on, keeps those that are listed, in ascending order. Texts that no
  /// row has any more go as soon as they are more than the rows.
  void keep(std::size_t first, std::span<const std::size_t> rows);
  /// All of them go.
  void drop_unused();

 private:
  std::vector<std::string> distinct_;
  std::vector<std::int32_t> indices_;  ///< for each row, which of them
  std::unordered_map<std::string, std::int32_t> places_;
};

/// The values of a column of signals.csv, in the narrowest form that has them all: integers become
/// doubles as soon as one does not fit into 32 bits, and texts where a double would not be exact.
class Column {
 public:
  using Values = std::variant<std::vector<std::uint8_t>, std::vector<std::int32_t>,
                              std::vector<double>, Texts>;

  /// Of a known type.
  explicit Column(SignalInfo info);
  /// The type follows from the fields: true and false, numbers that doubles have, or else texts.
  Column(std::string name, std::string unit);

  const std::string& name() const { return info_.name; }
  const std::string& unit() const { return info_.unit; }
  core::ValueType type() const { return info_.type; }
  /// Whether the type follows from the fields.
  bool is_deduced() const { return is_deduced_; }
  /// Whether the signal keeps each value until the next.
  bool is_stepped() const;
  const Values& values() const { return values_; }
  std::size_t size() const;
  /// A value as signals.csv has it, but for quotation marks.
  std::string text(std::size_t row) const;

  /// Throws std::invalid_argument, whose text contains what was expected, for what is not of the
  /// type.
  void append(const core::CsvReader::Field& field);
  /// Of the rows from `first` on, keeps those that are listed, in ascending order.
  void keep(std::size_t first, std::span<const std::size_t> rows);
  /// Forgets the texts that no row has any more.
  void drop_unused_texts();

 private:
  void append_number(std::string_view text);
  void append_integer(std::string_view text);
  void deduce(const core::CsvReader::Field& field);
  void become_doubles();
  void become_texts();

  SignalInfo info_;
  bool is_deduced_ = false;
  Values values_;
};

}  // namespace stride::report

#endif
