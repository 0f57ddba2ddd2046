#include "master/trace/instants.h"

#include <catch2/catch.hpp>

#include "tests/master/trace/support.h"

using namespace stride::trace;
using Catch::Contains;

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
  stride::io::OutputFile file(folder / "x");
  instant.text.copy_to(file);
  file.close();
  return content(folder / "x");
}

std::vector<Seen> read(const std::string& text, CutOff cut_off = CutOff::Refuse,
                       Instants::Text keep = Instants::Text::Keep) {
  const TemporaryFolder folder;
  Reader reader(folder.write("x.vcd", text), cut_off);
  Instants instants(reader, keep);
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
      read(two_variables(
          "$comment a\nb $end $dumpvars 0! b0\n\" $end #10 1! r0.5 \" s \"\n#20\n")) ==
      std::vector<Seen>{{false, 0, 0, 2, false, "$comment a\nb $end\n$dumpvars\n0!\nb0 \"\n$end\n"},
                        {true, 10, 10, 3, false, "1!\nr0.5 \"\ns \"\n"},
                        {true, 20, 20, 0, true, ""}});
}

TEST_CASE("Equal stamps are one instant; what stands before the first stamp is one of its own") {
  CHECK(read(two_variables("0!\n#0\n1!\n#0\n0!\n#1\n1!\n")) ==
        std::vector<Seen>{{false, 0, 0, 1, false, "0!\n"},
                          {true, 0, 0, 2, false, "1!\n0!\n"},
                          {true, 1, 1, 1, false, "1!\n"}});
  CHECK(read(two_variables("")) == std::vector<Seen>{{false, 0, 0, 0, true, ""}});
}

TEST_CASE("A dump ends with its instant, if not before") {
  CHECK(read(two_variables(
            "$dumpvars\n0!\n#1\n1!\n$end\n#2\n$dumpoff\nx!\n$dumpon\n1!\n$end\n$end\n")) ==
        std::vector<Seen>{{false, 0, 0, 1, false, "$dumpvars\n0!\n$end\n"},
                          {true, 1, 1, 1, false, "1!\n"},
                          {true, 2, 2, 2, false, "$dumpoff\nx!\n$end\n$dumpon\n1!\n$end\n"}});
}

TEST_CASE("The total behind all changes of a stamp holds for all of them") {
  CHECK(read(skipping("b0 t\n0!\n#10\n1!\nb101 t\n0!\n#10\nb111 t\n#20\n1!\n#30\nb1000 t\n")) ==
        std::vector<Seen>{{false, 0, 0, 1, false, "0!\n"},
                          {true, 10, 17, 2, false, "1!\n0!\n"},
                          {true, 20, 27, 1, false, "1!\n"},
                          {true, 30, 38, 0, true, ""}});
}

TEST_CASE("A name that shares its changes with advanceTime keeps them") {
  const std::string text =
      dump("$var wire 8 t advanceTime $end\n$var wire 8 t skipped $end\n", "#10\nb101 t\n");
  CHECK(read(text) ==
        std::vector<Seen>{{false, 0, 0, 0, true, ""}, {true, 10, 15, 1, false, "b101 t\n"}});
}

TEST_CASE("Of a trace that is cut off the last instant is left out") {
  const std::string text = skipping("#10\n1!\n#20\n0!\nb101");
  CHECK(read(text, CutOff::Accept).size() == 2);
  CHECK(read(text, CutOff::Accept).back().stamp == 10);
  CHECK_THROWS_WITH(read(text), Contains("x.vcd:11: the file is cut off: it ends within 'b101'"));
  CHECK(read(skipping("$dumpvars\n1!\n"), CutOff::Accept).empty());
}

TEST_CASE("Texts are kept only where somebody wants them") {
  const auto seen = read(two_variables("#10\n1!\n"), CutOff::Refuse, Instants::Text::Drop);
  CHECK(seen.back() == Seen{true, 10, 10, 1, false, ""});
}

TEST_CASE("True time beyond 2^63 - 1 is told with the line of the stamp") {
  const std::string most = "b" + std::string(63, '1') + " t\n";
  CHECK(read(skipping("#0\n" + most)).back().time == 9223372036854775807);
  CHECK_THROWS_WITH(read(skipping("#0\n1!\n#1\n0!\n" + most + "#2\n")),
                    Contains("x.vcd:9: the true time of #1 is beyond 2^63 - 1, with advanceTime of "
                             "9223372036854775807"));
}
