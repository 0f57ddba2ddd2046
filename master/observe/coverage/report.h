// How often which bins were hit, of one run or of several.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_REPORT_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_REPORT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/observe/coverage/definition.h"

namespace stride::coverage {

struct BinCount {
  std::string name;
  bool is_ignored = false;
  std::uint64_t count = 0;
  std::optional<double> first{};           ///< the first visit [s], if there was one
  std::optional<std::uint64_t> in_case{};  ///< of a campaign: the case of that visit
  bool operator==(const BinCount&) const = default;
};

/// What runs have counted of one definition of a point. Of several runs a group may have more than
/// one of the same name, with other definitions.
struct PointReport {
  std::string name;
  std::string definition{};  ///< hash() of it
  std::size_t place = 0;     ///< in its group, of the definitions the first one
  Kind kind = Kind::Values;
  std::string signal{};
  std::string unit{};
  std::vector<std::string> of{};              ///< of a cross: the names of its parts,
  std::vector<std::string> of_definitions{};  ///< and their definitions
  std::uint64_t at_least = 1;
  bool is_open = false;
  std::size_t declared = 0;  ///< how many of the bins were declared
  /// Those that were declared in their order, and behind them the others in that of bin_order().
  std::vector<BinCount> bins{};
  std::uint64_t runs = 0;                     ///< that have had it
  std::optional<std::uint64_t> first_case{};  ///< of a campaign: the first case that had it

  std::size_t countable() const;  ///< bins that are not ignored
  std::size_t covered() const;    ///< those of them with at_least visits
  /// Nothing where the point is open, or nothing counts.
  std::optional<double> percentage() const;
  bool operator==(const PointReport&) const = default;
};

struct GroupReport {
  std::string component;
  std::optional<double> goal{};
  std::size_t place = 0;  ///< among the groups, of the definitions the first one
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
  std::uint64_t runs = 0;                ///< cases or others
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
/// both begin with one, else as texts. No two names are equal in it.
bool bin_order(const std::string& a, const std::string& b);

/// Of so many runs in which nothing was hit.
Report empty_report(std::string scenario, std::span<const GroupDefinition> definitions,
                    std::uint64_t runs);

CoveredBins covered_bins(const Report& report);

}  // namespace stride::coverage

#endif
