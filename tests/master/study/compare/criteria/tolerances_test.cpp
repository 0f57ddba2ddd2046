#include "master/study/compare/criteria/tolerances.h"

#include <limits>

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<SignalTolerance> read(const std::string& text) {
  const TemporaryFolder folder;
  return read_tolerances(folder.write("tolerances.csv", text));
}

}  // namespace

TEST_CASE("without a tolerance reals are equal bit by bit, and NaN is equal to NaN") {
  const Tolerance exact;
  CHECK(exact.allows(1, 1));
  CHECK(exact.allows(kNan, -kNan));
  CHECK(exact.allows(kInfinity, kInfinity));
  CHECK_FALSE(exact.allows(1, 1 + std::numeric_limits<double>::epsilon()));
  CHECK_FALSE(exact.allows(0, -0.0));
  CHECK_FALSE(exact.allows(kNan, 1));
}

TEST_CASE("a tolerance is the absolute part and the relative part of the second value") {
  const Tolerance tolerance{0.5, 0.25};
  CHECK(tolerance.allows(6.5, 5));
  CHECK(tolerance.allows(0, -0.0));
  CHECK(tolerance.allows(5.5, 4));
  CHECK_FALSE(tolerance.allows(5.51, 4));
  CHECK_FALSE(tolerance.allows(4, 5.51 + 0.5));
  CHECK(tolerance.allows(-2.5, -4));
}

TEST_CASE("what is not finite is near to itself only") {
  const Tolerance tolerance{1e300, 1};
  CHECK(tolerance.allows(kInfinity, kInfinity));
  CHECK(tolerance.allows(kNan, kNan));
  CHECK_FALSE(tolerance.allows(1, kInfinity));
  CHECK_FALSE(tolerance.allows(kInfinity, -kInfinity));
  CHECK_FALSE(tolerance.allows(kInfinity, 1));
  CHECK_FALSE(tolerance.allows(1, kNan));
}

TEST_CASE("a tolerance of some signals is read from the command line") {
  const SignalTolerance one = parse_tolerance("a.*=1e-3");
  CHECK(one.pattern == "a.*");
  CHECK(one.tolerance.absolute == 1e-3);
  CHECK(one.tolerance.relative == 0);
  const SignalTolerance both = parse_tolerance("a.x=0,0.5");
  CHECK(both.tolerance.absolute == 0);
  CHECK(both.tolerance.relative == 0.5);
}

TEST_CASE("what is no tolerance is refused") {
  CHECK_THAT(error_of([] { parse_tolerance("a.x"); }),
             Contains("--tolerance a.x: expected SIGNAL=ABSOLUTE"));
  CHECK_THAT(error_of([] { parse_tolerance("=1"); }), Contains("expected SIGNAL=ABSOLUTE"));
  CHECK_THAT(error_of([] { parse_tolerance("a.x=-1"); }), Contains("--tolerance a.x=-1: "));
  CHECK_THAT(error_of([] { parse_tolerance("a.x=1,"); }), Contains("--tolerance a.x=1,: "));
}

TEST_CASE("the file of a golden folder has a row for each signal with a tolerance") {
  const auto rules = read("signal,absolute,relative\na.x [m],1e-9,0.25\n\"b,c.y\",0,1\n");
  REQUIRE(rules.size() == 2);
  CHECK(rules[0].pattern == "a.x [m]");
  CHECK(rules[0].tolerance.absolute == 1e-9);
  CHECK(rules[0].tolerance.relative == 0.25);
  CHECK(rules[1].pattern == "b,c.y");
  CHECK(rules[1].where.line == 3);
  CHECK(read("").empty());
}

TEST_CASE("a mistake in that file is named with its line and column") {
  CHECK_THAT(error_of([] { read("signal,absolute\na,1\n"); }),
             Contains("tolerances.csv:1: the header has no column 'relative'"));
  CHECK_THAT(error_of([] { read("signal,absolute,relative\na,0,0\nb,x,0\n"); }),
             Contains("tolerances.csv:3: ") && Contains("absolute"));
  CHECK_THAT(error_of([] { read("signal,absolute,relative\na,0\n"); }),
             Contains("tolerances.csv:2: expected 3 fields"));
}

TEST_CASE("of several rules the last one counts") {
  const Tolerances tolerances({1, 0}, {{"a.*", {2, 0}, {}}, {"a.x", {3, 0}, {}}});
  CHECK(tolerances.of("b.x", "").absolute == 1);
  CHECK(tolerances.of("a.y", "").absolute == 2);
  CHECK(tolerances.of("a.x", "m").absolute == 3);
}

TEST_CASE("a rule is about a signal with its unit of measure, or all elements of an array") {
  const Tolerances tolerances({}, {{"a.x [m]", {1, 0}, {}}, {"a.v", {2, 0}, {}}});
  CHECK(tolerances.of("a.x", "m").absolute == 1);
  CHECK(tolerances.of("a.x", "mm").absolute == 0);
  CHECK(tolerances.of("a.v[2]", "").absolute == 2);
  CHECK(tolerances.of("a.velocity", "").absolute == 0);
}

TEST_CASE("tolerances are exact if all are zeros") {
  CHECK(Tolerances({}, {{"a", {}, {}}}).are_exact());
  CHECK_FALSE(Tolerances({}, {{"a", {0, 1}, {}}}).are_exact());
  CHECK_FALSE(Tolerances({1, 0}, {}).are_exact());
}

TEST_CASE("a rule about no signal is refused, with its place and what was meant") {
  const Tolerances tolerances({}, {{"tank.levle", {1, 0}, {"tolerances.csv", 2}}});
  const Names signals{"tank.level"};
  const Names units{"m"};
  const std::string error = error_of([&] { tolerances.require_use(signals, units); });
  CHECK_THAT(error, Contains("tolerances.csv:2: 'tank.levle' is no signal of either run"));
  CHECK_THAT(error, Contains("did you mean 'tank.level'?"));
  CHECK_NOTHROW(Tolerances({}, {{"tank.level [m]", {}, {}}}).require_use(signals, units));
}
