#include "master/base/files/csv_reader.h"

#include <random>

#include <catch2/catch.hpp>

#include "master/observe/recorders/signal_text.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::tests;
using Catch::Contains;

namespace {

using Rows = std::vector<std::vector<std::string>>;

struct ReadRows {
  Rows rows;
  std::vector<std::size_t> lines;
  bool is_cut = false;
};

ReadRows read_rows(const std::string& text) {
  const TemporaryFolder folder;
  CsvReader reader(folder.write("x.csv", text));
  ReadRows read;
  while (reader.next()) {
    auto& row = read.rows.emplace_back();
    for (const CsvReader::Field& field : reader.fields()) row.push_back(field.value());
    read.lines.push_back(reader.line());
  }
  read.is_cut = reader.is_cut();
  return read;
}

}  // namespace

TEST_CASE("rows are split into fields") {
  CHECK(read_rows("time,a\n0,1\n").rows == Rows{{"time", "a"}, {"0", "1"}});
  CHECK(read_rows("a,,c\n,\n\n").rows == Rows{{"a", "", "c"}, {"", ""}, {""}});
  CHECK(read_rows("a,b\r\n1,2\r\n").rows == Rows{{"a", "b"}, {"1", "2"}});
  CHECK(read_rows("").rows.empty());
}

TEST_CASE("quoted fields hold what would end others") {
  const ReadRows found =
      read_rows("\"a, b\",\"say \"\"no\"\"\"\r\n\"two\nlines\",\"\"\nlast,\"\"\"\"\n");
  CHECK(found.rows == Rows{{"a, b", "say \"no\""}, {"two\nlines", ""}, {"last", "\""}});
  CHECK(found.lines == std::vector<std::size_t>{1, 2, 4});
  CHECK_FALSE(found.is_cut);
}

TEST_CASE("a last line that was cut off is skipped and reported") {
  for (const char* rest : {"0.2,1", "0.2,", "0", "0.2,\"te", "0.2,\"text\"", "\"", "0.2,1\r"}) {
    INFO(rest);
    const ReadRows found = read_rows(std::string("time,a\n0.1,2\n") + rest);
    CHECK(found.rows == Rows{{"time", "a"}, {"0.1", "2"}});
    CHECK(found.is_cut);
  }
  CHECK_FALSE(read_rows("time,a\n").is_cut);
}

TEST_CASE("a quotation mark out of place is an error with its line") {
  CHECK_THAT(error_of([] { read_rows("a,b\n1,2\n\"x\"y,2\n"); }),
             Contains("x.csv:3: a quotation mark ends a field, but no comma"));
}

TEST_CASE("what cannot be read is named") {
  const TemporaryFolder folder;
  CHECK_THAT(error_of([&] { CsvReader(folder / "none.csv"); }),
             Contains("none.csv: the file does not exist"));
  CHECK_THAT(error_of([&] { CsvReader("/dev/zero"); }),
             Contains("/dev/zero: this is a device, not a regular file"));
}

TEST_CASE("what the recorders write comes back, across all borders of the buffer") {
  std::mt19937 random(9);
  const std::string alphabet = "ab,\"\n\r ";
  Rows rows;
  std::string text;
  for (int i = 0; i < 20'000; ++i) {
    auto& row = rows.emplace_back();
    for (int k = 0; k < 3; ++k) {
      std::string field(random() % 40, ' ');
      for (char& c : field) c = alphabet[random() % alphabet.size()];
      row.push_back(field);
      text += stride::recorders::csv_field(field) + (k < 2 ? "," : "\n");
    }
  }
  CHECK(text.size() > 600'000);
  CHECK(read_rows(text).rows == rows);
}

TEST_CASE("a row may be longer than the buffer") {
  const std::string field(3'000'000, 'x');
  CHECK(read_rows("a," + field + "\n1,2\n").rows == Rows{{"a", field}, {"1", "2"}});
}
