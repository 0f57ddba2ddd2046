#include "master/base/files/replacement.h"

#include <string>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/error.h"
#include "tests/master/base/file_size_limit.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::tests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

void replace(const fs::path& path, const std::string& text) {
  Replacement replacement(path);
  replacement.file().write(text);
  replacement.commit();
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("A file is made, or replaced") {
  const TemporaryFolder folder;
  replace(folder / "x", "first");
  CHECK(content(folder / "x") == "first");
  replace(folder / "x", "2nd");
  CHECK(content(folder / "x") == "2nd");
  CHECK(files_in(folder / "") == 1);
}

TEST_CASE("The old file is there until commit(), and stays without it") {
  const TemporaryFolder folder;
  folder.write("x", "old");
  {
    Replacement replacement(folder / "x");
    replacement.file().write("new");
    replacement.file().flush();
    CHECK(content(folder / "x") == "old");
  }
  CHECK(content(folder / "x") == "old");
  CHECK(files_in(folder / "") == 1);
  { Replacement none(folder / "y"); }
  CHECK(files_in(folder / "") == 1);
}

TEST_CASE("A link stays, and the file that it leads to is replaced") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "there");
  folder.write("there/x", "old");
  fs::create_symlink("there/x", folder / "link");
  replace(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(content(folder / "there/x") == "new");
  CHECK(files_in(folder / "there") == 1);
}

TEST_CASE("What is in the place of the new file is removed, and no link there is followed") {
  const TemporaryFolder folder;
  folder.write("other", "other");
  folder.write("x", "old");
  fs::create_symlink(folder / "other", folder / "x.stride-new");
  replace(folder / "x", "new");
  folder.write("x.stride-new", "left by a killed process");
  replace(folder / "x", "newer");
  CHECK(content(folder / "x") == "newer");
  CHECK(content(folder / "other") == "other");
  CHECK(files_in(folder / "") == 2);
  fs::create_directories(folder / "x.stride-new/full");
  CHECK_THAT(error_of([&] { replace(folder / "x", ""); }),
             Contains("x.stride-new: cannot create the file: File exists"));
}

TEST_CASE("What is not a regular file is written, not replaced") {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  REQUIRE(reader >= 0);
  replace(pipe, "text");
  char text[8];
  CHECK(::read(reader, text, sizeof text) == 4);
  ::close(reader);
  CHECK(fs::is_fifo(pipe));
  CHECK(files_in(folder / "") == 1);
}

TEST_CASE("A path of an open file is written, not replaced") {
  const TemporaryFolder folder;
  const int open = ::open((folder / "x").c_str(), O_RDWR | O_CREAT, 0600);
  REQUIRE(open >= 0);
  replace("/dev/fd/" + std::to_string(open), "text");
  char text[8];
  CHECK(::read(open, text, sizeof text) == 4);
  ::close(open);
  CHECK(content(folder / "x") == "text");
}

TEST_CASE("A disk that is full leaves the old file as it was") {
  const TemporaryFolder folder;
  folder.write("x", "old");
  const FileSizeLimit limit(1000);
  CHECK_THAT(error_of([&] { replace(folder / "x", std::string(2000, 'x')); }),
             Contains("x.stride-new: cannot write the file: File too large") &&
                 Contains("nothing is left of it"));
  CHECK(content(folder / "x") == "old");
  CHECK(files_in(folder / "") == 1);
}

TEST_CASE("What cannot be written is named, and nothing is left") {
  const TemporaryFolder folder;
  const auto error = [](const fs::path& path) { return error_of([&] { replace(path, "text"); }); };
  CHECK_THAT(error(folder / "none/x"), Contains("none/x: the folder of this file does not exist") &&
                                           Contains("make the folder"));
  CHECK_THAT(error(folder / ""), Contains("this is a folder; expected a file to write to"));
  CHECK_THAT(error(""), Contains("no file is named to write to"));
  CHECK_THAT(error("/sys/x"), Contains("/sys/x.stride-new: cannot create the file") &&
                                  Contains("a folder in which you may write"));
  CHECK(files_in(folder / "") == 0);
}

TEST_CASE("A name may be as long as the file system allows") {
  const TemporaryFolder folder;
  for (const std::size_t size : {255U, 252U}) {
    const std::string name(size, 'x');
    replace(folder / name, "text");
    CHECK(content(folder / name) == "text");
  }
  std::string umlauts;
  for (int i = 0; i < 127; ++i) umlauts += "ü";
  replace(folder / umlauts, "text");
  CHECK(content(folder / umlauts) == "text");
  CHECK(files_in(folder / "") == 3);
}

TEST_CASE("Links that lead to each other are refused, with what to do") {
  const TemporaryFolder folder;
  fs::create_symlink("loop", folder / "loop");
  CHECK_THROWS_WITH(replace(folder / "loop", "text"),
                    Contains("symbolic link") && Contains("leads back to itself"));
  CHECK(fs::is_symlink(folder / "loop"));
}
