#include "master/observe/trace/instants.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

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

TEST_CASE("A variable of another type is an error") {
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

TEST_CASE("What is not a number, or falls, is reported with its line") {
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

TEST_CASE("A code that another name shares is recognised") {
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

namespace {

struct Seen {
  bool has_stamp;
  std::int64_t stamp, time;
  std::uint64_t changes;
  bool is_empty;
  std::string text;

  bool operator==(const Seen&) const = default;
};

[[maybe_unused]] std::ostream& operator<<(std::ostream& stream, const Seen& seen) {
  return stream << seen.has_stamp << " #" << seen.stamp << " = " << seen.time << ", "
                << seen.changes << " changes, " << seen.is_empty << ": " << seen.text;
}

std::string text_of(const Instant& instant) {
  const TemporaryFolder folder;
  stride::core::OutputFile file(folder / "x");
  instant.text.copy_to(file);
  file.close();
  return content(folder / "x");
}

std::vector<Seen> read_instants(const std::string& text, CutOff cut_off = CutOff::Refuse,
                                InstantReader::Text keep = InstantReader::Text::Keep) {
  const TemporaryFolder folder;
  Reader reader(folder.write("x.vcd", text), cut_off);
  InstantReader instants(reader, keep);
  Instant instant;
  std::vector<Seen> seen;
  while (instants.next(instant)) {
    seen.push_back({instant.has_stamp, instant.stamp, instant.time, instant.changes,
                    instant.is_empty, text_of(instant)});
  }
  CHECK_FALSE(instants.next(instant));
  return seen;
}

}  // namespace

TEST_CASE("All between two stamps is one instant, each entry on a line") {
  CHECK(
      read_instants(two_variables(
          "$comment a\nb $end $dumpvars 0! b0\n\" $end #10 1! r0.5 \" s \"\n#20\n")) ==
      std::vector<Seen>{{false, 0, 0, 2, false, "$comment a\nb $end\n$dumpvars\n0!\nb0 \"\n$end\n"},
                        {true, 10, 10, 3, false, "1!\nr0.5 \"\ns \"\n"},
                        {true, 20, 20, 0, true, ""}});
}

TEST_CASE("Equal stamps are one instant; what is before the first stamp is one of its own") {
  CHECK(read_instants(two_variables("0!\n#0\n1!\n#0\n0!\n#1\n1!\n")) ==
        std::vector<Seen>{{false, 0, 0, 1, false, "0!\n"},
                          {true, 0, 0, 2, false, "1!\n0!\n"},
                          {true, 1, 1, 1, false, "1!\n"}});
  CHECK(read_instants(two_variables("")) == std::vector<Seen>{{false, 0, 0, 0, true, ""}});
}

TEST_CASE("A dump ends with its instant, if not before") {
  CHECK(read_instants(two_variables(
            "$dumpvars\n0!\n#1\n1!\n$end\n#2\n$dumpoff\nx!\n$dumpon\n1!\n$end\n$end\n")) ==
        std::vector<Seen>{{false, 0, 0, 1, false, "$dumpvars\n0!\n$end\n"},
                          {true, 1, 1, 1, false, "1!\n"},
                          {true, 2, 2, 2, false, "$dumpoff\nx!\n$end\n$dumpon\n1!\n$end\n"}});
}

TEST_CASE("The total behind all changes of a stamp holds for all of them") {
  CHECK(read_instants(
            skipping("b0 t\n0!\n#10\n1!\nb101 t\n0!\n#10\nb111 t\n#20\n1!\n#30\nb1000 t\n")) ==
        std::vector<Seen>{{false, 0, 0, 1, false, "0!\n"},
                          {true, 10, 17, 2, false, "1!\n0!\n"},
                          {true, 20, 27, 1, false, "1!\n"},
                          {true, 30, 38, 0, true, ""}});
}

TEST_CASE("A name that shares its changes with advanceTime keeps them") {
  const std::string text =
      dump("$var wire 8 t advanceTime $end\n$var wire 8 t skipped $end\n", "#10\nb101 t\n");
  CHECK(read_instants(text) ==
        std::vector<Seen>{{false, 0, 0, 0, true, ""}, {true, 10, 15, 1, false, "b101 t\n"}});
}

TEST_CASE("Of a trace that is cut off the last instant is left out") {
  const std::string text = skipping("#10\n1!\n#20\n0!\nb101");
  CHECK(read_instants(text, CutOff::Accept).size() == 2);
  CHECK(read_instants(text, CutOff::Accept).back().stamp == 10);
  CHECK_THROWS_WITH(read_instants(text),
                    Contains("x.vcd:11: the file is cut off: it ends within 'b101'"));
  CHECK(read_instants(skipping("$dumpvars\n1!\n"), CutOff::Accept).empty());
}

TEST_CASE("Texts are kept only if they are required") {
  const auto seen =
      read_instants(two_variables("#10\n1!\n"), CutOff::Refuse, InstantReader::Text::Drop);
  CHECK(seen.back() == Seen{true, 10, 10, 1, false, ""});
}

TEST_CASE("True time beyond 2^63 - 1 is reported with the line of the stamp") {
  const std::string most = "b" + std::string(63, '1') + " t\n";
  CHECK(read_instants(skipping("#0\n" + most)).back().time == 9223372036854775807);
  CHECK_THROWS_WITH(read_instants(skipping("#0\n1!\n#1\n0!\n" + most + "#2\n")),
                    Contains("x.vcd:9: the true time of #1 is beyond 2^63 - 1, with advanceTime of "
                             "9223372036854775807"));
}
