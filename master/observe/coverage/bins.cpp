#include "master/observe/coverage/bins.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "master/engine/model/number_range.h"

namespace stride::coverage {
namespace {

using namespace std::chrono_literals;

constexpr std::array<Duration, 17> kGapEdges{1us,  3us,   10us,  30us, 100us, 300us, 1ms, 3ms, 10ms,
                                             30ms, 100ms, 300ms, 1s,   3s,    10s,   30s, 100s};
constexpr std::array<const char*, 17> kGapNames{
    "1 us",  "3 us",   "10 us",  "30 us", "100 us", "300 us", "1 ms", "3 ms", "10 ms",
    "30 ms", "100 ms", "300 ms", "1 s",   "3 s",    "10 s",   "30 s", "100 s"};

/// Of few digits, so that the names of bins are short and the edges what these say.
double short_number(double number, int digits) {
  return std::stod(fmt::format("{:.{}g}", number, digits));
}

/// As a variable of this type has it.
double number_of_type(double number, core::ValueType type) {
  return type == core::ValueType::Float32 ? static_cast<double>(static_cast<float>(number))
                                          : number;
}

/// The shortest that reads back the same, also where it was a Float32.
std::string edge_text(double edge) {
  const auto narrow = static_cast<float>(edge);
  return static_cast<double>(narrow) == edge ? fmt::format("{}", narrow) : fmt::format("{}", edge);
}

/// Of the bin from this edge on.
std::string range_name(const std::vector<double>& edges, std::size_t i) {
  const char* const end = i + 2 == edges.size() ? "]" : ")";
  return fmt::format("[{}, {}{}", edge_text(edges[i]), edge_text(edges[i + 1]), end);
}

/// Each bin of an integer variable has to hold one that its type has.
void require_integers(const std::vector<double>& edges, core::ValueType type) {
  const core::NumberRange all = *core::range_of(type);
  for (const double edge : edges) {
    if (std::abs(edge) <= kExactIntegers) continue;
    throw std::invalid_argument(fmt::format(
        "expected edges up to {:.0f}, as far as bins of integers are exact, and there is {:.0f}",
        kExactIntegers, edge));
  }
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const bool is_last = i + 2 == edges.size();
    const double end = edges[i + 1];
    const double least = std::max(std::ceil(edges[i]), static_cast<double>(all.least));
    const double most =
        std::min(is_last ? std::floor(end) : std::ceil(end) - 1, static_cast<double>(all.most));
    if (least <= most) continue;
    throw std::invalid_argument(
        fmt::format("no {} is in the bin {}", core::name(type), range_name(edges, i)));
  }
}

}  // namespace

std::size_t Ranges::bin_of(double value) const {
  if (std::isnan(value)) return size() + 2;
  if (value < edges_.front()) return size();
  if (value > edges_.back()) return size() + 1;
  if (value == edges_.back()) return size() - 1;
  return static_cast<std::size_t>(std::ranges::upper_bound(edges_, value) - edges_.begin()) - 1;
}

std::vector<DeclaredBin> Ranges::bins() const {
  std::vector<DeclaredBin> bins;
  for (std::size_t i = 0; i < size(); ++i) bins.push_back({range_name(edges_, i)});
  bins.push_back({fmt::format("< {}", edge_text(edges_.front())), true});
  bins.push_back({fmt::format("> {}", edge_text(edges_.back())), true});
  bins.push_back({"NaN", true});
  return bins;
}

Items::Items(std::vector<std::pair<std::int64_t, std::string>> items) : items_(std::move(items)) {
  std::ranges::sort(items_);
}

std::size_t Items::bin_of(std::int64_t value) const {
  const auto found =
      std::ranges::lower_bound(items_, value, {}, [](const auto& i) { return i.first; });
  if (found == items_.end() || found->first != value) return items_.size();
  return static_cast<std::size_t>(found - items_.begin());
}

std::vector<DeclaredBin> Items::bins() const {
  std::vector<DeclaredBin> bins;
  for (const auto& [number, name] : items_) bins.push_back({name});
  bins.push_back({"other", true});
  return bins;
}

std::vector<DeclaredBin> Items::transitions() const {
  std::vector<DeclaredBin> bins;
  for (const auto& from : items_) {
    for (const auto& to : items_) {
      if (from.first != to.first) set_pair(bins.emplace_back().name, from.second, to.second);
    }
  }
  return bins;
}

std::optional<std::size_t> Items::transition_bin(std::size_t from, std::size_t to) const {
  if (from == to || from >= size() || to >= size()) return std::nullopt;
  return from * (size() - 1) + (to < from ? to : to - 1);
}

std::size_t bin_of(const Classes& classes, const core::ValueBlock& block, std::size_t element) {
  return core::visit(block, [&](auto values) -> std::size_t {
    using T = std::remove_const_t<typename decltype(values)::element_type>;
    if constexpr (std::is_arithmetic_v<T>) {
      if (const auto* ranges = std::get_if<Ranges>(&classes)) {
        return ranges->bin_of(static_cast<double>(values[element]));
      }
      if constexpr (std::is_integral_v<T>) {
        return std::get<Items>(classes).bin_of(static_cast<std::int64_t>(values[element]));
      }
    }
    throw std::logic_error("a value without bins");
  });
}

Ranges ranges_between(std::vector<double> edges, core::ValueType type) {
  if (edges.size() < 2) throw std::invalid_argument("expected two edges at least");
  if (edges.size() > kMostBins) {
    throw std::invalid_argument(fmt::format("expected at most {} edges", kMostBins));
  }
  for (double& edge : edges) edge = number_of_type(edge, type);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!std::isfinite(edges[i])) throw std::invalid_argument("expected finite edges");
    if (i == 0 || edges[i] > edges[i - 1]) continue;
    throw std::invalid_argument(
        fmt::format("expected ascending edges, and {} does not follow {}", edges[i], edges[i - 1]));
  }
  if (core::is_integer(type)) require_integers(edges, type);
  return Ranges(std::move(edges));
}

Ranges equal_ranges(double low, double high, std::size_t count, bool is_logarithmic,
                    core::ValueType type) {
  if (!(low < high)) {
    throw std::invalid_argument(fmt::format("expected a range, and {} is not below {}", low, high));
  }
  if (count == 0 || count > kMostBins) {
    throw std::invalid_argument(fmt::format("expected from 1 to {} bins", kMostBins));
  }
  if (is_logarithmic && low <= 0) {
    throw std::invalid_argument(
        fmt::format("expected a range above 0 for a logarithmic scale, and it begins at {}", low));
  }
  std::vector<double> edges;
  for (std::size_t i = 0; i <= count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    double edge = is_logarithmic ? low * std::pow(high / low, part) : low + (high - low) * part;
    edge = core::is_real(type) ? short_number(edge, is_logarithmic ? 4 : 9) : std::round(edge);
    edges.push_back(i == 0 ? low : i == count ? high : edge);
  }
  const auto is_short = [](double a, double b) { return !(a < b); };
  if (std::ranges::adjacent_find(edges, is_short) != edges.end()) {
    throw std::invalid_argument(
        fmt::format("there are no {} different bins from {} to {}", count, low, high));
  }
  return ranges_between(std::move(edges), type);
}

std::string length_bin(std::uint64_t bytes, std::optional<std::uint64_t> greatest) {
  if (greatest && bytes > *greatest) return fmt::format("> {}", *greatest);
  if (bytes <= 1) return std::to_string(bytes);
  const std::uint64_t low = std::bit_floor(bytes);
  std::uint64_t high = low + (low - 1);
  if (greatest) high = std::min(high, *greatest);
  return low == high ? std::to_string(low) : fmt::format("{}-{}", low, high);
}

std::vector<DeclaredBin> length_bins(std::uint64_t greatest) {
  std::vector<DeclaredBin> bins{{"0"}};
  for (std::uint64_t low = 1; low != 0 && low <= greatest; low *= 2) {
    bins.push_back({length_bin(low, greatest)});
  }
  bins.push_back({fmt::format("> {}", greatest), true});
  return bins;
}

std::size_t gap_bin(Duration gap) {
  return static_cast<std::size_t>(std::ranges::upper_bound(kGapEdges, gap) - kGapEdges.begin());
}

std::vector<DeclaredBin> gap_bins(std::optional<Duration> shortest,
                                  std::optional<Duration> longest) {
  std::vector<DeclaredBin> bins;
  for (std::size_t i = 0; i <= kGapEdges.size(); ++i) {
    const bool is_first = i == 0;
    const bool is_last = i == kGapEdges.size();
    DeclaredBin& bin = bins.emplace_back();
    bin.name = is_first  ? fmt::format("< {}", kGapNames.front())
               : is_last ? fmt::format(">= {}", kGapNames.back())
                         : fmt::format("[{}, {})", kGapNames[i - 1], kGapNames[i]);
    const bool is_too_short = shortest && !is_last && kGapEdges[i] <= *shortest;
    const bool is_too_long = longest && !is_first && kGapEdges[i - 1] >= *longest;
    bin.is_ignored = is_too_short || is_too_long;
  }
  return bins;
}

void set_pair(std::string& text, std::string_view from, std::string_view to) {
  text.assign(from);
  text.append(" -> ");
  text.append(to);
}

}  // namespace stride::coverage
