// How often which bins were hit, of one run or of several.
#ifndef STRIDE_MASTER_COVERAGE_REPORT_H
#define STRIDE_MASTER_COVERAGE_REPORT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/coverage/definition.h"

namespace stride::coverage {

struct BinCount {
  std::string name;
  bool is_ignored = false;
  std::uint64_t count = 0;
  std::optional<double> first{};           ///< the first visit [s], if there was one
  std::optional<std::uint64_t> in_case{};  ///< of a campaign: the case of that visit
  bool operator==(const BinCount&) const = default;
};

struct PointReport {
  std::string name;
  Kind kind = Kind::Values;
  std::string signal{};
  std::string unit{};
  std::vector<std::string> of{};  ///< of a cross: the names of its parts
  std::uint64_t at_least = 1;
  bool is_open = false;
  /// Those that were declared in their order, and behind them the others in that of bin_order().
  std::vector<BinCount> bins{};

  std::size_t countable() const;  ///< bins that are not ignored
  std::size_t covered() const;    ///< those of them with at_least visits
  /// Nothing where the point is open, or nothing counts.
  std::optional<double> percentage() const;
  bool operator==(const PointReport&) const = default;
};

struct GroupReport {
  std::string component;
  std::optional<double> goal{};
  std::vector<PointReport> points{};

  /// The mean of those of the points; nothing where none has one.
  std::optional<double> percentage() const;
  /// Whether there is a goal and the percentage is less.
  bool misses_goal() const;
  bool operator==(const GroupReport&) const = default;
};

struct Report {
  std::string scenario{};                ///< or several, with commas
  std::string definition{};              ///< hash() of it
  std::optional<std::uint64_t> cases{};  ///< of a campaign
  std::vector<GroupReport> groups{};
  bool operator==(const Report&) const = default;
};

/// What is hit of one run, in short: the bins with a count.
struct CoveredBin {
  std::string name;
  std::uint64_t count = 0;
  double first = 0;  ///< [s]
  bool operator==(const CoveredBin&) const = default;
};
struct CoveredPoint {
  std::string name;
  std::vector<CoveredBin> bins{};
  bool operator==(const CoveredPoint&) const = default;
};
struct CoveredGroup {
  std::string component;
  std::vector<CoveredPoint> points{};
  bool operator==(const CoveredGroup&) const = default;
};
using CoveredBins = std::vector<CoveredGroup>;

/// In which order bins stand that were not declared: by the number that their names begin with, if
/// both begin with one, else as texts.
bool bin_order(const std::string& a, const std::string& b);

/// Of a run that has not begun.
Report empty_report(std::string scenario, std::span<const GroupDefinition> definitions);

CoveredBins covered_bins(const Report& report);
/// Adds what a case has hit; in ascending order of the cases. Groups and points that the
/// definitions have not are passed over. `report` began as an empty_report() of them.
void add_case(Report& report, std::span<const GroupDefinition> definitions,
              const CoveredBins& covered, std::uint64_t index);
/// The percentages of the groups after one run that has hit this.
std::vector<std::optional<double>> percentages(std::span<const GroupDefinition> definitions,
                                               const CoveredBins& covered);

/// Adds the counts of another one of the same definition. Of a bin that both have hit the first
/// visit is the one in the earlier case, or at the earlier instant. Throws std::invalid_argument
/// with the first difference if the definitions are not the same.
void merge(Report& report, const Report& other);

}  // namespace stride::coverage

#endif
