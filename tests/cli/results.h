// Reads what a run has recorded.
#ifndef STRIDE_TESTS_CLI_RESULTS_H
#define STRIDE_TESTS_CLI_RESULTS_H

#include <filesystem>
#include <string>
#include <vector>

namespace stride::tests {

/// A CSV file without quoted fields: a line of titles, then rows.
class Csv {
 public:
  /// Throws std::runtime_error for a file that cannot be read, a row with too few or too many
  /// fields, and a last line without its end.
  explicit Csv(const std::filesystem::path& file);

  const std::vector<std::string>& titles() const { return titles_; }
  std::size_t size() const { return rows_.size(); }
  const std::vector<std::string>& row(std::size_t i) const { return rows_[i]; }
  bool has(const std::string& title) const;
  /// Where the column is; throws std::runtime_error if there is none.
  std::size_t column(const std::string& title) const;
  /// A field as a number: true is 1, false is 0. Throws std::runtime_error for anything else.
  double number(std::size_t row, std::size_t column) const;
  std::vector<double> numbers(const std::string& title) const;
  /// The row of the instant, in seconds as the file writes it ("14.2").
  std::size_t row_at(const std::string& time) const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> titles_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace stride::tests

#endif
