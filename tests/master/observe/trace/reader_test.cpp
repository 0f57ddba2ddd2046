#include "master/observe/trace/reader.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

using namespace stride;
using namespace stride::trace;
using Catch::Contains;
using Texts = std::vector<std::string>;

namespace {

Texts read_entries(const std::string& text) {
  const TemporaryFolder folder;
  Reader reader(folder.write("x.vcd", text));
  return entries(reader);
}

/// The error of a dump with these changes, which begin in line 7.
std::string reader_error(const std::string& changes) {
  return error_of([&] { read_entries(two_variables(changes)); });
}

}  // namespace

TEST_CASE("All kinds of entries are read, on lines of their own or not") {
  CHECK(
      read_entries(two_variables("$dumpvars\n0!\nbxX01zZ \"\n$end\n#10 1! r-1.5e-09\n\"\n\n"
                                 "$comment all\nis well $end\n#0020\n$dumpoff x! $end\nsa\\040b !\n"
                                 "s \"\nR1 ! B0\n\" #20\nZ! u! W! l! H! -! ?!\n$vcdclose #30 $end\n"
                                 "#9223372036854775807\n")) == Texts{"$dumpvars",
                                                                     "0|!",
                                                                     "bxX01zZ|\"",
                                                                     "$end",
                                                                     "#10",
                                                                     "1|!",
                                                                     "r-1.5e-09|\"",
                                                                     "$comment all\nis well $end",
                                                                     "#20",
                                                                     "$dumpoff",
                                                                     "x|!",
                                                                     "$end",
                                                                     "sa\\040b|!",
                                                                     "s|\"",
                                                                     "R1|!",
                                                                     "B0|\"",
                                                                     "#20",
                                                                     "Z|!",
                                                                     "u|!",
                                                                     "W|!",
                                                                     "l|!",
                                                                     "H|!",
                                                                     "-|!",
                                                                     "?|!",
                                                                     "$vcdclose #30 $end",
                                                                     "#9223372036854775807"});
}

TEST_CASE("A code may look like something else") {
  const std::string text = dump(
      "$var wire 1 # a $end\n$var wire 8 $end b $end\n$var real 64 b1 c $end\n", "#1\n1#\n0b1\n");
  CHECK_THROWS_WITH(read_entries(text), Contains("has only 2 of them"));
  CHECK(read_entries(dump("$var wire 1 # a $end\n$var wire 8 $ b $end\n$var real 64 b1 c $end\n",
                          "#1\n1#\nb101 #\n0$\nr1 $\nr2 b1\n0b1\n")) ==
        Texts{"#1", "1|#", "b101|#", "0|$", "r1|$", "r2|b1", "0|b1"});
}

TEST_CASE("Codes are numbered as the declarations are") {
  const TemporaryFolder folder;
  Reader reader(folder.write("x.vcd", two_variables("#1\n1\"\n")));
  CHECK(reader.next()->line == 7);
  const Entry* entry = reader.next();
  CHECK(entry->line == 8);
  CHECK(entry->code == 1);
}

TEST_CASE("An empty trace has no entries") { CHECK(read_entries(two_variables("")).empty()); }

TEST_CASE("Lines may end as on other systems") {
  CHECK(
      read_entries(
          "$timescale 1 ps $end\r\n$var wire 1 ! a $end\r\n$enddefinitions $end\r\n#1\r\n1!\r\n") ==
      Texts{"#1", "1|!"});
}

TEST_CASE("What is no entry is reported with its line") {
  CHECK_THAT(reader_error("#0\nq!\n"),
             Contains("x.vcd:8: 'q!' is not a time stamp, no change and no section") &&
                 Contains("hint: expected #TIME"));
  CHECK_THAT(reader_error("#0\npD 6 0 !\n"),
             Contains("extended dumps ($dumpports) are not supported"));
  CHECK_THAT(reader_error("#0\n1 !\n"),
             Contains("x.vcd:8: the value '1' has no identifier code behind it"));
  CHECK_THAT(reader_error("#\n"), Contains("x.vcd:7: '#' is not a time stamp"));
  CHECK_THAT(reader_error("#1.5\n"), Contains("'#1.5' is not a time stamp"));
  CHECK_THAT(reader_error("#-1\n"), Contains("'#-1' is not a time stamp"));
  CHECK_THAT(reader_error("#9223372036854775808\n"),
             Contains("x.vcd:7: the time stamp #9223372036854775808 is beyond 2^63 - 1"));
  CHECK_THAT(reader_error("#0\n1!\n" + std::string(3, '\0') + "\n"),
             Contains("x.vcd:9: '\\x00\\x00\\x00'"));
}

TEST_CASE("Time does not go back") {
  CHECK_THAT(reader_error("#5\n1!\n#7\n0!\n#6\n"),
             Contains("x.vcd:11: time goes back to #6 from #7 in line 9"));
  CHECK(read_entries(two_variables("#5\n#5\n")).size() == 2);
}

TEST_CASE("A change is of a variable") {
  CHECK_THAT(reader_error("#5\n1%\n"),
             Contains("x.vcd:8: no variable has the identifier code '%'"));
  CHECK_THAT(reader_error("#5\nb1\n%\n"), Contains("no variable has the identifier code '%'"));
}

TEST_CASE("A file that is cut off is reported with the line and what it ends in") {
  CHECK_THAT(reader_error("#5\n1!\n#15"),
             Contains("x.vcd:9: the file is cut off: it ends within '#15' (no line end follows)") &&
                 Contains("--cut-off"));
  CHECK_THAT(reader_error("#5\n1"), Contains("x.vcd:8: the file is cut off: it ends within '1'"));
  CHECK_THAT(reader_error("#5\nb101"),
             Contains("x.vcd:8: the file is cut off: it ends within 'b101'"));
  CHECK_THAT(reader_error("#5\nb101\n"), Contains("it ends within the change 'b101'"));
  CHECK_THAT(reader_error("#5\nb101 !"), Contains("it ends within the change 'b101'"));
  CHECK_THAT(reader_error("#5\n1!\n$comm"),
             Contains("x.vcd:9: the file is cut off: it ends within '$comm'"));
  CHECK_THAT(reader_error("#5\n$comment this is\n"),
             Contains("it ends within the $comment of line 8"));
  CHECK_THAT(reader_error("#5\n$dumpvars\n1!\n"), Contains("it ends within the $dumpvars"));
}

TEST_CASE(
    "A section that has ended is not a sign of a cut, and neither is one before a later stamp") {
  CHECK(read_entries(two_variables("#5\n$dumpvars\n1!\n$end")).size() == 4);
  CHECK(read_entries(two_variables("$dumpvars\n#5\n1!\n")).size() == 3);
}

TEST_CASE("Where a cut is accepted, the entries end there") {
  const TemporaryFolder folder;
  Reader reader(folder.write("x.vcd", two_variables("#5\n1!\nb10")), CutOff::Accept);
  CHECK(entries(reader) == Texts{"#5", "1|!"});
  CHECK(reader.cut() == 9);
  CHECK(reader.next() == nullptr);
  Reader whole(folder.write("x.vcd", two_variables("#5\n1!\n")), CutOff::Accept);
  CHECK(entries(whole) == Texts{"#5", "1|!"});
  CHECK_FALSE(whole.cut().has_value());
  CHECK_THROWS_AS(Reader(folder.write("x.vcd", "$timescale 1 ps $end\n$var wire"), CutOff::Accept),
                  core::Error);
}

TEST_CASE("A trace that is cut within a word or a section is never taken for a whole one") {
  const TemporaryFolder folder;
  const std::string header = two_variables("");
  const std::string text = header + "$dumpvars\n0!\nb0 \"\n$end\n#10\n1!\nb101 \"\n#20\n0!\n";
  const std::size_t end_of_dump = text.find("$end\n#10") + 4;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto file = folder.write("x.vcd", text.substr(0, length));
    const std::string message = error_of([&] {
      Reader reader(file);
      entries(reader);
    });
    INFO(text.substr(0, length));
    if (length < header.size() - 1) {  // the last line needs no end
      CHECK_THAT(message, Contains("x.vcd:") && Contains("the file ends"));
    } else if (length <= header.size() || length == end_of_dump) {
      CHECK(message == "(no error)");
    } else if (text[length - 1] == '\n' && length > end_of_dump) {
      CHECK(message == "(no error)");
    } else {
      CHECK_THAT(message, Contains("x.vcd:") && Contains("it ends within"));
    }
  }
}
