#include "units/xml/file.h"

#include <fstream>

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include "tests/scratch_folder.h"

using Catch::Contains;
using namespace xml;

TEST_CASE("a regular file is read whole") {
  const stride::tests::ScratchFolder folder;
  const std::string text(200'000, 'x');
  std::ofstream(folder / "x") << text;
  CHECK(read_file((folder / "x").string(), "text") == text);
  CHECK_NOTHROW(require_file((folder / "x").string(), "text"));
}

TEST_CASE("anything else is refused, with what it is") {
  const stride::tests::ScratchFolder folder;
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  const std::string fifo = (folder / "fifo").string();
  CHECK_THROWS_WITH(read_file(fifo, "text"),
                    fifo + ": cannot be read: expected text (it is a FIFO)");
  CHECK_THROWS_WITH(require_file(fifo, "text"), Contains("(it is a FIFO)"));
  CHECK_THROWS_WITH(read_file("/dev/zero", "text"), Contains("(it is not a regular file)"));
  CHECK_THROWS_WITH(read_file("/", "text"),
                    Contains("/: cannot be read: expected text (it is a folder)"));
  CHECK_THROWS_WITH(read_file("/nowhere", "text"), Contains("No such file"));
  CHECK_THROWS_WITH(read_file("/proc/self/mem", "text"),
                    Contains("/proc/self/mem: cannot be read"));
}
