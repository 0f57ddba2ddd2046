#include "master/observe/coverage/coverage.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

Ranges thirds() { return equal_ranges(0, 3, 3, false, core::ValueType::Float64); }

/// All kinds of points.
GroupDefinition everything() {
  GroupDefinition group =
      group_of({values_of("level", 0, thirds()), transitions_of("changes", 1, truths()),
                messages_of(Kind::Words, "words"), messages_of(Kind::Sequences, "sequences"),
                messages_of(Kind::Lengths, "lengths"),
                messages_of(Kind::Gaps, "gaps", gap_bins({}, {})), values_of("lamp", 1, truths())});
  group.points.push_back(cross_of(group, {0, 6}));
  group.points.push_back(cross_of(group, {2, 0}));
  group.points.back().name = "words when";
  return group;
}

/// What happens between two instants, always alike.
void go_on(Device& device, std::int64_t from, std::int64_t to) {
  for (std::int64_t i = from; i < to; ++i) {
    if (i % 3 == 1) {
      device.message(i, i % 2 == 0 ? "read it" : "write", static_cast<std::size_t>(i % 5));
    }
    device.point(i, static_cast<double>(i % 7) / 2, i % 4 < 2);
  }
}

}  // namespace

TEST_CASE("a value counts once a step has begun with it, and only where its bin changes") {
  Device device(group_of({values_of("level", 0, thirds())}));
  device.point(0, 0.5);
  CHECK(hits(device.report(0)).empty());
  device.point(1, 0.7);
  device.point(2, 2.5);
  device.point(3, 0.1);
  device.point(4, std::nan(""));
  device.point(5, -1);
  device.point(6, 1.5);  // no step begins with it
  CHECK(hits(device.report(0)) == "[0, 1) 2, [2, 3] 1, < 0! 1, NaN! 1");
  CHECK(device.report(0).bins[2].first == 0.002);
  CHECK(device.report(0).percentage() == Approx(200.0 / 3));
}

TEST_CASE("changes are counted from one item to another one") {
  Device device(group_of({transitions_of("lamp", 1, truths())}));
  for (const int time : {0, 1, 2, 3, 4, 5}) device.point(time, 0, time == 2 || time == 3);
  CHECK(hits(device.report(0)) == "false -> true 1, true -> false 1");
}

TEST_CASE("messages are counted by words, lengths, sequences and gaps") {
  Device device(everything());
  device.message(1, "read 3", 2);
  device.message(3, "read 4", 3);
  device.message(3, "  write", 0);
  device.message(4, "", 1);
  CHECK(hits(device.report(2)) == "0x26 1, read 2, write 1");
  CHECK(hits(device.report(3)) == "read -> read 1, read -> write 1, write -> 0x26 1");
  CHECK(hits(device.report(4)) == "0 1, 1 1, 2-3 2");
  CHECK(hits(device.report(5)) == "< 1 us 1, [1 ms, 3 ms) 2");
  CHECK(device.report(2).is_open);
  CHECK_FALSE(device.report(2).percentage());
}

TEST_CASE("of declared words others are shown, and ignored") {
  Device device(group_of({messages_of(Kind::Words, "words", {{"read"}, {"write"}})}));
  device.message(1, "read");
  device.message(2, "erase");
  CHECK(hits(device.report(0)) == "read 1, erase! 1");
  CHECK(device.report(0).percentage() == 50);
}

TEST_CASE("a cross of values is visited where one of them changes, one of messages at each") {
  GroupDefinition group = group_of({values_of("level", 0, thirds()), values_of("lamp", 1, truths()),
                                    messages_of(Kind::Words, "words", {{"read"}, {"write"}})});
  group.points.push_back(cross_of(group, {0, 1}));
  group.points.push_back(cross_of(group, {2, 1}));
  REQUIRE(group.points[3].bins.size() == 6);
  Device device(group);
  device.message(0, "read");  // nothing was sampled yet
  device.point(0, 0.5, false);
  device.message(1, "read");
  device.message(1, "erase");
  device.point(1, 0.6, false);
  device.point(2, 0.6, true);
  device.message(3, "read");
  device.point(3, -1, true);
  device.point(4, 0.6, true);
  device.point(5, 1.6, true);
  device.point(6, 0, false);
  CHECK(hits(device.report(3)) == "[0, 1) × false 1, [0, 1) × true 2, [1, 2) × true 1");
  CHECK(hits(device.report(4)) == "read × false 1, read × true 1");
}

TEST_CASE("what was seen is kept and goes on, as if nothing had been between") {
  for (const std::int64_t cut : {1, 2, 10, 50, 59}) {
    INFO(cut);
    Device whole(everything());
    go_on(whole, 0, 60);
    Device first(everything());
    go_on(first, 0, cut);
    core::StateArchive written;
    first.coverage.persist(written);
    Device second(everything());
    core::StateArchive read(written.bytes());
    second.coverage.persist(read);
    read.end();
    go_on(second, cut, 60);
    CHECK(second.coverage.report("s") == whole.coverage.report("s"));
  }
}

TEST_CASE("the state of other definitions is refused") {
  Device device(everything());
  go_on(device, 0, 60);
  core::StateArchive written;
  device.coverage.persist(written);
  Device other(group_of({values_of("level", 0, thirds())}));
  core::StateArchive read(written.bytes());
  CHECK_THROWS_AS(other.coverage.persist(read), core::BadState);
}

TEST_CASE("there are only so many bins that nobody has declared") {
  Device device(group_of({messages_of(Kind::Words, "words")}));
  for (std::size_t i = 0; i < kMostOpenBins + 10; ++i) device.message(1, "w" + std::to_string(i));
  const PointReport report = device.report(0);
  CHECK(report.bins.size() == kMostOpenBins + 1);
  CHECK(report.bins[0].name == kFurther);
  CHECK((report.bins[0].count == 10 && report.bins[0].is_ignored));
}

TEST_CASE("contents of messages are asked for where words need them") {
  CHECK(Coverage({everything()}).wants_content());
  CHECK_FALSE(Coverage({group_of({messages_of(Kind::Gaps, "gaps")})}).wants_content());
}

TEST_CASE("a first word is short, and fit to be shown") {
  std::string made;
  CHECK(first_word("", made) == "(empty)");
  CHECK(first_word(" \n", made) == "(empty)");
  CHECK(first_word("\tset_led 1", made) == "set_led");
  CHECK(first_word("a\x01z b", made) == "a z");
  CHECK(first_word(std::string(100, 'x'), made).size() < 70);
}
