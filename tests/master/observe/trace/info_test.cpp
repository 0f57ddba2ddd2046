#include "master/observe/trace/info.h"

#include <catch2/catch.hpp>

#include "master/observe/trace/compress.h"
#include "tests/master/observe/trace/support.h"

using namespace stride;
using namespace stride::trace;

namespace {

Info info_of(const std::string& text, CutOff cut_off = CutOff::Refuse) {
  const TemporaryFolder folder;
  return info(folder.write("x.vcd", text), Duration(10), cut_off);
}

void check_gap(const Gap& gap, std::int64_t from, std::int64_t to, std::int64_t skipped) {
  CHECK(gap.from == from);
  CHECK(gap.to == to);
  CHECK(gap.skipped == skipped);
}

}  // namespace

TEST_CASE("A trace with true time has gaps, and no skips") {
  const std::string text = two_variables(
      "$dumpvars\n0!\nb0 \"\n$end\n#10\n1!\n#21\n0!\n1!\n#30\n#121\n1!\n#130\n#140\n");
  const Info info = info_of(text);
  CHECK(info.bytes == text.size());
  CHECK(info.timescale.text() == "1 ps");
  CHECK(info.variables == 2);
  CHECK(info.changes == 6);
  CHECK(info.instants == 4);
  CHECK_FALSE(info.has_advance_time);
  CHECK(info.kernel_time == 140);
  CHECK(info.true_time == 140);
  CHECK(info.skips == 0);
  CHECK(info.gaps == 3);
  REQUIRE(info.longest.size() == 3);
  check_gap(info.longest[0], 21, 121, 0);
  check_gap(info.longest[1], 121, 140, 0);
  check_gap(info.longest[2], 10, 21, 0);
}

TEST_CASE("A trace with advanceTime has skips, which are in its gaps") {
  const Info info =
      info_of(skipping("#5\n0!\nb0 t\n#10\n1!\n#12\nb1100100 t\n0!\n#15\n1!\n#16\nb1100101 "
                       "t\n#20\n0!\n#25\nb11001000 t\n"));
  CHECK(info.variables == 1);
  CHECK(info.changes == 5);
  CHECK(info.instants == 5);
  CHECK(info.has_advance_time);
  CHECK(info.kernel_time == 20);
  CHECK(info.true_time == 220);
  CHECK(info.skips == 3);
  CHECK(info.gaps == 2);
  REQUIRE(info.longest.size() == 2);
  check_gap(info.longest[0], 121, 225, 99);
  check_gap(info.longest[1], 10, 112, 100);
}

TEST_CASE("The ten longest gaps are listed, of equal ones the first") {
  std::string changes = "#0\n0!\n";
  std::int64_t time = 0;
  for (int i = 0; i < 20; ++i) {
    time += 100 + 10 * (i % 3);
    changes += "#" + std::to_string(time) + "\n1!\n";
  }
  const Info info = info_of(two_variables(changes));
  CHECK(info.gaps == 20);
  REQUIRE(info.longest.size() == 10);
  for (std::size_t i = 0; i < 10; ++i) CHECK(info.longest[i].length() == (i < 6 ? 120 : 110));
  CHECK(info.longest[0].from == 210);
  CHECK(info.longest[1].from == 540);
  CHECK(info.longest[6].from == 100);
}

TEST_CASE("A trace of nothing has no time") {
  const Info info = info_of(two_variables(""));
  CHECK(info.instants == 0);
  CHECK(info.true_time == 0);
  CHECK(info.longest.empty());
  CHECK(info_of(two_variables("$comment c $end\n#100\n#200\n")).true_time == 100);
}

TEST_CASE("Of a trace that is cut off, all up to its last whole instant is counted") {
  const Info info = info_of(two_variables("#0\n0!\n#10\n1!\n#20\n1"), CutOff::Accept);
  CHECK(info.cut == 12);
  CHECK(info.changes == 2);
  CHECK(info.true_time == 10);
}
