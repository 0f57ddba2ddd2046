#ifndef STRIDE_MASTER_STUDY_COMPARE_CRITERIA_TOLERANCES_H
#define STRIDE_MASTER_STUDY_COMPARE_CRITERIA_TOLERANCES_H

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/base/error.h"

namespace stride::compare {

/// How far two reals may be apart. With zeros they are equal bit by bit.
struct Tolerance {
  double absolute = 0;
  double relative = 0;  ///< to the second one

  bool is_exact() const { return absolute == 0 && relative == 0; }
  /// |a - b| <= absolute + relative |b|; what is not finite is equal to itself only, NaN to any
  /// NaN.
  bool allows(double a, double b) const;
};

struct SignalTolerance {
  std::string pattern;  ///< a name, also with its unit of measure, or a glob
  Tolerance tolerance;
  core::Location where;  ///< "--tolerance x=1", or the line of the file
};

/// "SIGNAL=ABSOLUTE" or "SIGNAL=ABSOLUTE,RELATIVE". Throws core::Error (Input).
SignalTolerance parse_tolerance(const std::string& text);

/// The file in a golden folder: a header "signal,absolute,relative", and a row for each signal with
/// a tolerance. Throws core::Error (Input).
std::vector<SignalTolerance> read_tolerances(const std::filesystem::path& file);
inline constexpr const char* kTolerancesFile = "tolerances.csv";

class Tolerances {
 public:
  /// `all`: of signals that none of the rules is about. Of the others the last one counts.
  Tolerances(Tolerance all, std::vector<SignalTolerance> rules)
      : all_(all), rules_(std::move(rules)) {}

  Tolerance of(const std::string& signal, const std::string& unit) const;
  bool are_exact() const;
  /// Throws core::Error (Input) for a rule that is about none of these signals, with and without
  /// their units of measure.
  void require_use(std::span<const std::string> signals, std::span<const std::string> units) const;

 private:
  Tolerance all_;
  std::vector<SignalTolerance> rules_;
};

}  // namespace stride::compare

#endif
