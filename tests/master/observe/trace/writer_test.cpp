#include "master/observe/trace/writer.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/trace/support.h"

using namespace stride::trace;
using Catch::Contains;

TEST_CASE("Stamps are written once, totals in binary digits") {
  const TemporaryFolder folder;
  Writer writer(folder / "from", folder / "to");
  writer.write("head\n");
  writer.write_stamp(0);
  writer.write_advance_time(0, "!");
  writer.write_stamp(0);
  writer.write_stamp(9223372036854775807);
  writer.write_advance_time(9223372036854775807, "aaaab");
  writer.finish();
  CHECK(content(folder / "to") ==
        "head\n#0\nb0 !\n#9223372036854775807\nb" + std::string(63, '1') + " aaaab\n");
}

TEST_CASE("Nothing is left of what is not finished") {
  const TemporaryFolder folder;
  { Writer(folder / "from", folder / "to").write("text"); }
  CHECK(std::filesystem::is_empty(folder / ""));
}

TEST_CASE("The file that is read is not written, whatever it is called") {
  const TemporaryFolder folder;
  const auto file = folder.write("x.vcd", "text");
  std::filesystem::create_symlink(file, folder / "link");
  std::filesystem::create_hard_link(file, folder / "same");
  for (const auto& to : {file, folder / "./x.vcd", folder / "link", folder / "same"}) {
    INFO(to);
    CHECK_THROWS_WITH(Writer(file, to), Contains("this is the file that is read"));
  }
  CHECK(content(file) == "text");
}
