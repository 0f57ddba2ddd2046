#include <catch2/catch.hpp>

#include "master/trace/instants.h"
#include "tests/master/trace/support.h"

using namespace stride::trace;
using Catch::Contains;

namespace {

/// The total at the end of a dump.
std::int64_t total(const std::string& text) {
  const TemporaryFolder folder;
  Reader reader(folder.write("x.vcd", text));
  std::optional<AdvanceTime> advance = AdvanceTime::of(reader);
  while (const Entry* entry = reader.next()) {
    if (entry->kind == Entry::Kind::Change && advance->is(*entry)) advance->update(reader, *entry);
  }
  return advance->total();
}

std::string declaration_error(const std::string& declarations) {
  return error_of([&] { total(dump(declarations, "")); });
}

std::string value_error(const std::string& changes) {
  return error_of([&] { total(skipping(changes)); });
}

}  // namespace

TEST_CASE("advanceTime is found in any scope, as any integer") {
  for (const char* declaration :
       {"$var integer 64 t advanceTime $end\n", "$var wire 64 t advanceTime [63:0] $end\n",
        "$var wire 64 t advanceTime[63:0] $end\n", "$var reg 40 t advanceTime $end\n",
        "$scope module a $end\n$var time 64 t advanceTime $end\n$upscope $end\n"}) {
    INFO(declaration);
    CHECK(total(dump(declaration, "#0\nb101 t\n")) == 5);
  }
  CHECK(total(dump("$var wire 1 t advanceTime $end\n", "#0\n1t\n")) == 1);
}

TEST_CASE("A trace without advanceTime has none") {
  const TemporaryFolder folder;
  const auto has = [&](const std::string& name) {
    Reader reader(folder.write("x.vcd", dump("$var wire 64 t " + name + " $end\n", "")));
    return AdvanceTime::of(reader).has_value();
  };
  CHECK_FALSE(has("advance"));
  CHECK_FALSE(has("advanceTimes"));
  CHECK_FALSE(has("AdvanceTime"));
  CHECK(has("advanceTime"));
}

TEST_CASE("Totals grow up to 2^63 - 1") {
  CHECK(total(skipping("")) == 0);
  CHECK(total(skipping("$dumpvars\nb0 t\n$end\n#1\nb1 t\n#2\nB0110 t\n#3\nb110 t\n")) == 6);
  CHECK(total(skipping("#1\nb" + std::string(63, '1') + " t\n")) == 9223372036854775807);
  CHECK(total(skipping("#1\nb" + std::string(100, '0') + "11 t\n")) == 3);
}

TEST_CASE("A variable of another type is told") {
  CHECK_THAT(
      declaration_error("$var real 64 t advanceTime $end\n"),
      Contains("x.vcd:3: advanceTime is declared as real 64; expected integer 64 or wire 64"));
  CHECK_THAT(declaration_error("$var string 1 t advanceTime $end\n"),
             Contains("is declared as string 1;"));
  CHECK_THAT(declaration_error("$var event 1 t advanceTime $end\n"),
             Contains("is declared as event 1;"));
  CHECK_THAT(declaration_error("$var wire 65 t advanceTime $end\n"),
             Contains("is declared as wire 65;"));
  CHECK_THAT(declaration_error("$var wire 0 t advanceTime $end\n"),
             Contains("is declared as wire 0;"));
}

TEST_CASE("Two of them are one too many, unless they are the same") {
  const std::string first = "$var wire 64 t advanceTime $end\n";
  CHECK_THAT(declaration_error(first + "$scope module a $end\n$var wire 64 u advanceTime $end\n"),
             Contains("x.vcd:5: there is a second advanceTime, the first is in line 3"));
  CHECK(total(dump(first + "$scope module a $end\n" + first, "#1\nb1 t\n")) == 1);
}

TEST_CASE("What is no number, or falls, is told with its line") {
  CHECK_THAT(value_error("#1\nbx t\n"),
             Contains("x.vcd:8: advanceTime is 'bx'; expected a whole number, such as b1001"));
  CHECK_THAT(value_error("#1\nb1z0 t\n"), Contains("advanceTime is 'b1z0'"));
  CHECK_THAT(value_error("#1\nr5 t\n"), Contains("advanceTime is 'r5'"));
  CHECK_THAT(value_error("#1\nstext t\n"), Contains("advanceTime is 'stext'"));
  CHECK_THAT(value_error("#1\nxt\n"), Contains("advanceTime is 'x'"));
  CHECK_THAT(value_error("#1\nb t\n"), Contains("advanceTime is 'b'"));
  CHECK_THAT(value_error("#1\nb" + std::string(64, '1') + " t\n"),
             Contains("x.vcd:8: advanceTime is negative, or beyond 2^63 - 1"));
  CHECK_THAT(value_error("#1\nb" + std::string(65, '1') + " t\n"), Contains("beyond 2^63 - 1"));
  CHECK_THAT(value_error("#1\nb11 t\n#2\nb10 t\n"),
             Contains("x.vcd:10: advanceTime falls to 2 from 3 in line 8"));
}

TEST_CASE("It is not alone where another name has the same code") {
  const TemporaryFolder folder;
  const auto is_alone = [&](const std::string& further) {
    Reader reader(folder.write("x.vcd", dump("$var wire 64 t advanceTime $end\n" + further, "")));
    return AdvanceTime::of(reader)->is_alone();
  };
  CHECK(is_alone(""));
  CHECK(is_alone("$var wire 64 t advanceTime $end\n"));
  CHECK(is_alone("$var wire 64 u skipped $end\n"));
  CHECK_FALSE(is_alone("$var wire 64 t skipped $end\n"));
}
