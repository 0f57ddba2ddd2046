#include "master/observe/trace/expand.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

using namespace stride;
using namespace stride::trace;
using Catch::Contains;

namespace {

std::string expanded(const std::string& text) {
  const TemporaryFolder folder;
  CHECK_FALSE(expand(folder.write("in.vcd", text), folder / "out.vcd", CutOff::Refuse).has_value());
  return content(folder / "out.vcd");
}

/// The error, which leaves the file as it was.
std::string expand_error(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("in.vcd", text);
  folder.write("out.vcd", "old");
  const std::string message =
      error_of([&] { expand(folder / "in.vcd", folder / "out.vcd", CutOff::Refuse); });
  CHECK(content(folder / "out.vcd") == "old");
  CHECK_FALSE(std::filesystem::exists(folder / "out.vcd.stride-new"));
  return message;
}

/// The changes behind the header of a dump with one variable and advanceTime.
std::string expanded_changes(const std::string& changes) {
  const std::string text = expanded(skipping(changes));
  const std::string header = dump("$var wire 1 ! a $end\n", "");
  CHECK(text.substr(0, header.size()) == header);
  return text.substr(header.size());
}

}  // namespace

TEST_CASE("True time is put in, and advanceTime taken out") {
  CHECK(
      expanded_changes("$comment begin $end\n$dumpvars\n0!\nb0 t\n$end\n#10\n1!\n#20\nb1100100 t\n"
                       "0!\n#30\n1!\n#31\nb1100101 t\n0!\n") ==
      "$comment begin $end\n$dumpvars\n0!\n$end\n#10\n1!\n#120\n0!\n#130\n1!\n#132\n0!\n");
}

TEST_CASE("Where only advanceTime changed nothing happened, but for the end") {
  CHECK(expanded_changes("#0\nb0 t\n0!\n#10\nb101 t\n#15\n1!\n#20\nb111 t\n") ==
        "#0\n0!\n#20\n1!\n#27\n");
  CHECK(expanded_changes("#0\nb0 t\n0!\n#10\n#20\n1!\n#30\n#40\n") == "#0\n0!\n#20\n1!\n#40\n");
  CHECK(expanded_changes("#0\nb0 t\n#7\n") == "#7\n");
  CHECK(expanded_changes("").empty());
}

TEST_CASE("A trace that began in the middle of a run has skipped already") {
  CHECK(expanded_changes("$dumpvars\n0!\nb101 t\n$end\n#1\n1!\n") ==
        "#5\n$dumpvars\n0!\n$end\n#6\n1!\n");
}

TEST_CASE("The header stays as it is, but for the line of advanceTime") {
  const std::string before =
      "$date\n  today\n$end\n\n$timescale\n 100 ns $end\n$scope module m $end\n";
  const std::string behind = "  $var wire 1 ! a $end\n$upscope $end\n$enddefinitions  $end\n";
  const std::string variable = "$var wire 64 t advanceTime [63:0]  $end";
  CHECK(expanded(before + "\t" + variable + " \r\n" + behind) == before + behind);
  CHECK(expanded(before + variable + " " + behind) == before + " " + behind);
  CHECK(expanded(before + "$var wire\n 64\n t advanceTime\n$end\n" + behind) == before + behind);
  CHECK(expanded(before + variable + "\n" + variable + "\n" + behind) == before + behind);
}

TEST_CASE("An instant at which very much happens has its time, too") {
  std::string changes;
  for (int i = 0; i < 2'000'000; ++i) changes += i % 2 == 0 ? "0!\n" : "1!\n";
  CHECK(expanded_changes("#0\n0!\nb0 t\n#10\n" + changes + "b101 t\n#20\n0!\n") ==
        "#0\n0!\n#15\n" + changes + "#25\n0!\n");
}

TEST_CASE("A trace without advanceTime is not expanded") {
  CHECK_THAT(expand_error(two_variables("#0\n0!\n")),
             Contains("in.vcd: the trace has no variable advanceTime") &&
                 Contains("its time is true already"));
}

TEST_CASE("What is wrong far behind in the trace leaves nothing") {
  CHECK_THAT(expand_error(skipping("#0\n0!\n#5\n1!\n#4\n0!\n")),
             Contains("in.vcd:11: time goes back"));
  CHECK_THAT(expand_error(skipping("#0\n0!\n#5\nb1")),
             Contains("in.vcd:10: the file is cut off: it ends within 'b1'"));
  CHECK_THAT(expand_error(skipping("#0\nb11 t\n#5\nb1 t\n")),
             Contains("in.vcd:10: advanceTime falls"));
}

TEST_CASE(
    "Of a compressed trace that was cut off, all but the last instant is there if that is "
    "accepted") {
  const TemporaryFolder folder;
  folder.write("in.vcd", skipping("#0\nb0 t\n0!\n#10\n1!\n#20\n0!\nb110"));
  CHECK(expand(folder / "in.vcd", folder / "out.vcd", CutOff::Accept) == 14);
  CHECK(content(folder / "out.vcd") == dump("$var wire 1 ! a $end\n", "#0\n0!\n#10\n1!\n"));
}
