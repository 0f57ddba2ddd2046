#include "master/observe/coverage/bins.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

using namespace stride;
using namespace stride::coverage;
using namespace std::chrono_literals;
using core::ValueType;

namespace {

std::string names_of(const std::vector<DeclaredBin>& bins) {
  std::vector<std::string> names;
  for (const DeclaredBin& bin : bins) names.push_back(bin.name + (bin.is_ignored ? "!" : ""));
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace

TEST_CASE("ranges hold their lower edges, and the last one its upper edge") {
  const Ranges ranges = equal_ranges(0, 0.3, 3, false, ValueType::Float64);
  CHECK(names_of(ranges.bins()) == "[0, 0.1) [0.1, 0.2) [0.2, 0.3] < 0! > 0.3! NaN!");
  CHECK(ranges.bin_of(0) == 0);
  CHECK(ranges.bin_of(std::nextafter(0.1, 0)) == 0);
  CHECK(ranges.bin_of(0.1) == 1);
  CHECK(ranges.bin_of(0.3) == 2);
  CHECK(ranges.bin_of(-1e-300) == 3);
  CHECK(ranges.bin_of(std::nextafter(0.3, 1)) == 4);
  CHECK(ranges.bin_of(std::numeric_limits<double>::infinity()) == 4);
  CHECK(ranges.bin_of(std::nan("")) == 5);
}

TEST_CASE("edges are those of the variable's type, so its limit is within") {
  const Ranges ranges = equal_ranges(0, 0.05, 10, false, ValueType::Float32);
  CHECK(ranges.bin_of(static_cast<double>(0.05F)) == 9);
  CHECK(ranges.bin_of(static_cast<double>(0.005F)) == 1);
  CHECK(names_of(ranges.bins()).find("[0.045, 0.05]") != std::string::npos);
  CHECK(names_of(equal_ranges(0, 255, 4, false, ValueType::UInt8).bins()) ==
        "[0, 64) [64, 128) [128, 191) [191, 255] < 0! > 255! NaN!");
}

TEST_CASE("on a logarithmic scale ranges grow") {
  const Ranges ranges = equal_ranges(1e-6, 1e-2, 4, true, ValueType::Float64);
  CHECK(names_of(ranges.bins()) ==
        "[1e-06, 1e-05) [1e-05, 0.0001) [0.0001, 0.001) [0.001, 0.01] < 1e-06! > 0.01! NaN!");
}

TEST_CASE("what are no ranges is refused") {
  CHECK_THROWS_AS(equal_ranges(1, 1, 3, false, ValueType::Float64), std::invalid_argument);
  CHECK_THROWS_AS(equal_ranges(0, 1, 0, false, ValueType::Float64), std::invalid_argument);
  CHECK_THROWS_AS(equal_ranges(0, 1, 3, true, ValueType::Float64), std::invalid_argument);
  CHECK_THROWS_AS(equal_ranges(0, 2, 3, false, ValueType::Int32), std::invalid_argument);
  CHECK_THROWS_AS(ranges_between({1}, ValueType::Float64), std::invalid_argument);
  CHECK_THROWS_AS(ranges_between({1, 3, 2}, ValueType::Float64), std::invalid_argument);
  CHECK_THROWS_AS(ranges_between({0, INFINITY}, ValueType::Float64), std::invalid_argument);
}

TEST_CASE("each bin of an integer has one that its type has") {
  const auto mistake = [](std::vector<double> edges, ValueType type) -> std::string {
    try {
      ranges_between(std::move(edges), type);
    } catch (const std::invalid_argument& refused) {
      return refused.what();
    }
    return "";
  };
  CHECK(mistake({0, 0.5, 1}, ValueType::Int32).empty());
  CHECK(mistake({0, 0.3, 0.6, 1}, ValueType::Int32) == "no Int32 is in the bin [0.3, 0.6)");
  CHECK(mistake({0, 0.3, 0.6, 1}, ValueType::Float64).empty());
  CHECK(mistake({0.1, 1, 2}, ValueType::Int32) == "no Int32 is in the bin [0.1, 1)");
  CHECK(mistake({0, 1.1, 1.9}, ValueType::Int32) == "no Int32 is in the bin [1.1, 1.9]");
  CHECK(mistake({0, 255, 300}, ValueType::UInt8).empty());
  CHECK(mistake({0, 256, 300}, ValueType::UInt8) == "no UInt8 is in the bin [256, 300]");
  CHECK(mistake({-5, 0, 3}, ValueType::UInt64) == "no UInt64 is in the bin [-5, 0)");
}

TEST_CASE("integers beyond those that are exact are above the bins, and no edges") {
  constexpr std::int64_t kMost = 9'007'199'254'740'991;
  const Classes ranges = ranges_between({0, 10, kExactIntegers}, ValueType::Int64);
  core::ValueBlock block(ValueType::Int64, 1);
  const auto bin = [&](std::int64_t value) {
    block.numbers<std::int64_t>()[0] = value;
    return bin_of(ranges, block, 0);
  };
  CHECK((bin(kMost) == 1 && bin(kMost + 1) == 3 && bin(kMost + 2) == 3));
  for (const double edge : {kExactIntegers + 1, 9.3e18}) {
    CHECK_THROWS_WITH(ranges_between({0, edge}, ValueType::Int64),
                      Catch::StartsWith("expected edges up to 9007199254740991, "));
    CHECK_THROWS_AS(equal_ranges(-edge, 0, 4, false, ValueType::Int64), std::invalid_argument);
  }
  CHECK_NOTHROW(ranges_between({0, 9.3e18}, ValueType::Float64));
}

TEST_CASE("items are bins, in ascending order, and so are their changes") {
  const Items items({{7, "on"}, {2, "off"}, {9, "broken"}});
  CHECK(names_of(items.bins()) == "off on broken other!");
  CHECK((items.bin_of(7) == 1 && items.bin_of(8) == 3 && items.bin_of(-1) == 3));
  const auto transitions = items.transitions();
  REQUIRE(transitions.size() == 6);
  CHECK(transitions[*items.transition_bin(0, 2)].name == "off -> broken");
  CHECK(transitions[*items.transition_bin(2, 1)].name == "broken -> on");
  CHECK(transitions[*items.transition_bin(1, 0)].name == "on -> off");
  CHECK_FALSE(items.transition_bin(1, 1));
  CHECK_FALSE(items.transition_bin(3, 1));
}

TEST_CASE("lengths are binned by powers of two") {
  CHECK(length_bin(0, {}) == "0");
  CHECK(length_bin(1, {}) == "1");
  CHECK(length_bin(3, {}) == "2-3");
  CHECK(length_bin(16, {}) == "16-31");
  CHECK(length_bin(18, 20) == "16-20");
  CHECK(length_bin(21, 20) == "> 20");
  CHECK(length_bin(std::numeric_limits<std::uint64_t>::max(), {}) ==
        "9223372036854775808-18446744073709551615");
  CHECK(names_of(length_bins(9)) == "0 1 2-3 4-7 8-9 > 9!");
  CHECK(names_of(length_bins(8)) == "0 1 2-3 4-7 8 > 8!");
  CHECK(names_of(length_bins(0)) == "0 > 0!");
}

TEST_CASE("gaps have two bins a decade, of which those out of reach are ignored") {
  const auto bins = gap_bins({}, {});
  REQUIRE(bins.size() == 18);
  CHECK(bins[gap_bin(Duration{})].name == "< 1 us");
  CHECK(bins[gap_bin(1us - Duration(1))].name == "< 1 us");
  CHECK(bins[gap_bin(1us)].name == "[1 us, 3 us)");
  CHECK(bins[gap_bin(50ms)].name == "[30 ms, 100 ms)");
  CHECK(bins[gap_bin(100s)].name == ">= 100 s");
  CHECK(bins[gap_bin(1000s)].name == ">= 100 s");
  CHECK(names_of(gap_bins(300ms, 3s))
            .find("[100 ms, 300 ms)! [300 ms, 1 s) [1 s, 3 s) "
                  "[3 s, 10 s)!") != std::string::npos);
}
