// Into which bin a value, a length or a gap falls.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_BINS_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_BINS_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/description.h"
#include "master/engine/model/values.h"

namespace stride::coverage {

/// A bin that is known before the run. An ignored one is shown, and outside of the percentage.
struct DeclaredBin {
  std::string name;
  bool is_ignored = false;
  bool operator==(const DeclaredBin&) const = default;
};

/// A point has no more bins of which none was declared; what is seen beyond falls into kFurther.
inline constexpr std::size_t kMostOpenBins = 1000;
inline constexpr const char* kFurther = "(further bins)";
/// Nor more bins that were declared.
inline constexpr std::size_t kMostBins = 10'000;

/// Of integers up to there a double is one and no other.
inline constexpr double kExactIntegers = 9'007'199'254'740'991;

/// Not in any bin, since nothing has been seen.
inline constexpr std::size_t kNoBin = static_cast<std::size_t>(-1);

/// Ranges of numbers between successive edges: the lower edge is included, the upper one is not,
/// but for the last. Behind them the ignored bins for what is below, above, and not a number.
class Ranges {
 public:
  /// Two edges at least, finite and ascending.
  explicit Ranges(std::vector<double> edges) : edges_(std::move(edges)) {}

  std::size_t bin_of(double value) const;
  std::vector<DeclaredBin> bins() const;

 private:
  std::size_t size() const { return edges_.size() - 1; }

  std::vector<double> edges_;
};

/// Single values of a Boolean, an Enumeration or an integer. Behind them the ignored bin `other`.
class Items {
 public:
  /// Names of numbers, each number once.
  explicit Items(std::vector<std::pair<std::int64_t, std::string>> items);

  std::size_t size() const { return items_.size(); }
  std::size_t bin_of(std::int64_t value) const;
  std::vector<DeclaredBin> bins() const;
  /// For a change between two different items: "a -> b", in the order of transition_bin().
  std::vector<DeclaredBin> transitions() const;
  /// Nothing for a change from or to what is no item.
  std::optional<std::size_t> transition_bin(std::size_t from, std::size_t to) const;

 private:
  std::vector<std::pair<std::int64_t, std::string>> items_;  ///< ascending
};

using Classes = std::variant<Ranges, Items>;

/// Of an element of a block of numbers; of real numbers with Ranges only.
std::size_t bin_of(const Classes& classes, const core::ValueBlock& block, std::size_t element);

/// `count` equal parts from `low` to `high`, on a logarithmic scale if `is_logarithmic`. Edges are
/// as near to that as short numbers are; those of an integer variable are whole. Throws
/// std::invalid_argument, whose text contains what was expected, where these are no ranges.
Ranges equal_ranges(double low, double high, std::size_t count, bool is_logarithmic,
                    core::ValueType type);
/// Throws likewise, also for an integer variable where a bin has no value of its type, or an edge
/// is beyond kExactIntegers.
Ranges ranges_between(std::vector<double> edges, core::ValueType type);

/// The bin of a message of so many bytes: "0", "1", "2-3", "4-7", ...; with a greatest length the
/// last bin ends there, and longer ones are in "> GREATEST".
std::string length_bin(std::uint64_t bytes, std::optional<std::uint64_t> greatest);
std::vector<DeclaredBin> length_bins(std::uint64_t greatest);

/// Times between messages: two bins a decade from 1 us to 100 s, 1 and 3 being their edges, and one
/// for what is shorter or longer.
std::size_t gap_bin(Duration gap);
/// Those that have nothing between the shortest and the longest gap are ignored.
std::vector<DeclaredBin> gap_bins(std::optional<Duration> shortest,
                                  std::optional<Duration> longest);

/// "a -> b", into a text that is there.
void set_pair(std::string& text, std::string_view from, std::string_view to);

}  // namespace stride::coverage

#endif
