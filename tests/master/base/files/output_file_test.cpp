#include "master/base/files/output_file.h"

#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "tests/master/base/file_size_limit.h"
#include "tests/master/base/open_file_limit.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::string text_of(Time time) {
  const TemporaryFolder folder;
  OutputFile file(folder / "x");
  file.write_seconds(time);
  file.close();
  return content(folder / "x");
}

}  // namespace

TEST_CASE("What is written is in the file after close()") {
  const TemporaryFolder folder;
  folder.write("x", "something older and longer than what comes now, which has to go");
  OutputFile file(folder / "x");
  file.write("text ");
  file.write('c');
  file.write(' ');
  file.write_number(0.1);
  file.write(' ');
  file.write_number(std::int64_t{-7});
  file.write(' ');
  file.write_number(std::numeric_limits<double>::lowest());
  file.write(' ');
  const std::uint8_t bytes[] = {0x00, 0x9f, 0xff};
  file.write_hex(bytes);
  file.close();
  file.close();
  CHECK(content(folder / "x") == "text c 0.1 -7 -1.7976931348623157e+308 009fff");
}

TEST_CASE("Texts larger than the buffer arrive whole") {
  const TemporaryFolder folder;
  std::string large;
  for (int i = 0; i < 60'000; ++i) large += std::to_string(i) + "\n";
  OutputFile file(folder / "x");
  file.write("head\n");
  file.write(large);
  for (int i = 0; i < 200'000; ++i) file.write('x');
  file.close();
  CHECK(content(folder / "x") == "head\n" + large + std::string(200'000, 'x'));
}

TEST_CASE("Seconds are written as core writes them") {
  const auto ticks = GENERATE(std::int64_t{0}, 1, 1'000'000'000'000, 14'200'000'000'000,
                              1'500'000'000'001, 9'200'000'000'000'000'000, -1'500'000'000'000);
  CHECK(text_of(Time(Duration(ticks))) == core::to_text(Time(Duration(ticks))));
}

TEST_CASE("Seconds of all lengths are written, also where the buffer is full") {
  const TemporaryFolder folder;
  OutputFile file(folder / "x");
  std::string expected;
  for (int i = 0; i < 4'000; ++i) {
    for (std::int64_t unit = 1; unit <= 1'000'000'000'000; unit *= 10) {
      const Time time(Duration(i * unit));
      file.write_seconds(time);
      file.write('\n');
      expected += core::to_text(time) + "\n";
    }
  }
  file.close();
  CHECK((content(folder / "x") == expected));
}

TEST_CASE("times before 0 s are written like others") {
  CHECK(text_of(Time(Duration(-1))) == "-0.000000000001");
  CHECK(text_of(Time(-std::chrono::milliseconds(1'500))) == "-1.5");
  CHECK(text_of(Time(-std::chrono::seconds(2))) == "-2");
}

TEST_CASE("A file that cannot be created is named, with the reason") {
  CHECK_THROWS_WITH(OutputFile("/nowhere/x.csv"),
                    Contains("/nowhere/x.csv: cannot create the file: No such file or directory") &&
                        Contains("choose a results folder"));
}

TEST_CASE("A full disk is an error that names the file and the simulated time") {
  OutputFile file("/dev/full");
  file.set_time(Time(Duration(14'200'000'000'000)));
  file.write("row\n");
  CHECK_THROWS_WITH(file.close(), Contains("/dev/full: at 14.2 s: cannot write the file: "
                                           "No space left on device") &&
                                      Contains("make room on the disk"));
  CHECK_NOTHROW(file.close());  // it was reported once
}

TEST_CASE("A full disk is noticed as soon as the buffer is full, and only once") {
  OutputFile file("/dev/full");
  const auto write_much = [&] {
    for (int i = 0; i < 100'000; ++i) file.write("0123456789\n");
  };
  CHECK_THROWS_AS(write_much(), core::Error);
  CHECK_NOTHROW(write_much());
  CHECK_NOTHROW(file.close());
}

TEST_CASE("After a failure the file ends with its last whole line") {
  const TemporaryFolder folder;
  const FileSizeLimit limit(100'000);
  OutputFile file(folder / "x");
  const auto write_much = [&] {
    for (int i = 0; i < 100'000; ++i) file.write("0123456\n");
  };
  CHECK_THROWS_WITH(write_much(), Contains("File too large") && Contains("ulimit -f") &&
                                      Contains("the lines before are complete"));
  file.close();
  const std::string text = content(folder / "x");
  CHECK(text.size() == 100'000);
  CHECK(text.substr(text.size() - 8) == "0123456\n");
}

TEST_CASE("Too many open files are no mistake of the user") {
  const TemporaryFolder folder;
  const OpenFileLimit limit(0);
  try {
    OutputFile file(folder / "x");
    FAIL("it was created");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Run);
    CHECK_THAT(error.what(),
               Contains("cannot create the file: Too many open files") && Contains("ulimit -n"));
  }
}

TEST_CASE("A line that was begun is cut off, even when an earlier piece of it was taken") {
  const TemporaryFolder folder;
  const FileSizeLimit limit(100'000);
  OutputFile file(folder / "x");
  const std::string endless(80'000, 'x');
  file.write("whole\n");
  CHECK_THROWS_AS((file.write(endless), file.write(endless)), core::Error);
  file.close();
  CHECK(content(folder / "x") == "whole\n");
}

TEST_CASE("The whole lines of all open files can be written at any time, and nothing twice") {
  const TemporaryFolder folder;
  OutputFile first(folder / "first");
  OutputFile second(folder / "second");
  OutputFile closed(folder / "closed");
  closed.close();
  first.write("1\n2\n3");
  second.write("a");
  OutputFile::rescue_all();
  CHECK(content(folder / "first") == "1\n2\n");
  CHECK(content(folder / "second").empty());
  OutputFile::rescue_all();
  first.write("4\n");
  first.close();
  CHECK(content(folder / "first") == "1\n2\n4\n");  // what was not a whole line is lost
}

TEST_CASE("A pipe without a reader is not waited for; one with a reader is written") {
  const TemporaryFolder folder;
  const std::string pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THAT(error_of([&] { OutputFile file(pipe); }),
             Contains("this is a pipe (FIFO) that no program reads") && Contains("hint:"));
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  REQUIRE(reader >= 0);
  OutputFile file(pipe);
  file.write("text");
  file.close();
  char bytes[8] = {};
  CHECK(::read(reader, bytes, sizeof bytes) == 4);
  CHECK(std::string(bytes) == "text");
  ::close(reader);
}

namespace {

/// The number that the next file gets which is opened.
int next_descriptor() {
  const int number = ::open("/dev/null", O_RDONLY);
  ::close(number);
  return number;
}

}  // namespace

TEST_CASE(
    "A file that other code has closed or replaced is written to its end, which is an error") {
  const bool is_closed = GENERATE(true, false);
  const TemporaryFolder folder;
  const int number = next_descriptor();
  OutputFile file(folder / "x");
  file.write("a line that is on the disk\n");
  file.flush();
  file.write("a line that is not\n");
  const int other = is_closed ? -1 : ::open("/dev/null", O_WRONLY);
  is_closed ? ::close(number) : ::dup2(other, number);
  CHECK_THROWS_WITH(file.close(), Contains("/x: other code in this process") &&
                                      Contains("the lines up to here are complete") &&
                                      Contains("--isolate"));
  CHECK(content(folder / "x") == "a line that is on the disk\na line that is not\n");
  if (!is_closed) ::close(other);
  ::close(number);
}

TEST_CASE("A file that has been closed and renamed is lost") {
  const TemporaryFolder folder;
  const int number = next_descriptor();
  OutputFile file(folder / "x");
  file.write("a line\n");
  std::filesystem::rename(folder / "x", folder / "y");
  folder.write("x", "another file");
  ::close(number);
  CHECK_THROWS_WITH(file.close(), Contains("cannot be opened again, so lines are lost"));
  CHECK(content(folder / "x") == "another file");
  CHECK(content(folder / "y") == "");
}

TEST_CASE("A file that is rescued is opened again, too") {
  const TemporaryFolder folder;
  const int number = next_descriptor();
  OutputFile file(folder / "x");
  file.write("a line\nand half a");
  ::close(number);
  OutputFile::rescue_all();
  CHECK(content(folder / "x") == "a line\n");
}

TEST_CASE("A file that is no longer where it was made is an error at its end") {
  const bool is_replaced = GENERATE(true, false);
  const TemporaryFolder folder;
  OutputFile file(folder / "x.csv");
  file.write("one\n");
  std::filesystem::rename(folder / "x.csv", folder / "y.csv");
  if (is_replaced) folder.write("x.csv", "other\n");
  CHECK_THROWS_WITH(file.close(), Contains("x.csv: ") && Contains("moved or removed the file"));
  CHECK(content(folder / "y.csv") == "one\n");
}

TEST_CASE("Where the open file has been moved elsewhere, lines are behind each other") {
  const TemporaryFolder folder;
  const int number = next_descriptor();
  OutputFile file(folder / "x");
  file.write("first\n");
  file.flush();
  ::lseek(number, 0, SEEK_SET);
  file.write("second\n");
  file.close();
  CHECK(content(folder / "x") == "first\nsecond\n");
}

TEST_CASE("A file that is cut off while it is written is an error") {
  const TemporaryFolder folder;
  OutputFile file(folder / "x");
  file.write("first\n");
  file.flush();
  std::filesystem::resize_file(folder / "x", 2);
  file.write("second\n");
  CHECK_THROWS_WITH(file.close(), Contains("cut the file off") && Contains("2 bytes of 6"));
}

namespace {

/// Written by a process that has gone on, and was then killed.
std::vector<std::byte> place_behind(const std::string& text, const std::filesystem::path& path) {
  OutputFile file(path);
  file.write(text);
  StateArchive state;
  file.persist(state);
  file.write("what was written behind it\n");
  return state.bytes();
}

void go_on(const std::vector<std::byte>& bytes, const std::filesystem::path& path) {
  OutputFile file(path, {}, OutputFile::Existing::Kept);
  file.write("a head that is there already\n");
  StateArchive state(bytes);
  file.persist(state);
  file.go_on();
  file.write("second\n");
  file.close();
}

}  // namespace

TEST_CASE("A file goes on where another process was") {
  const TemporaryFolder folder;
  const std::vector<std::byte> place = place_behind("first\n", folder / "x");
  CHECK(content(folder / "x") == "first\nwhat was written behind it\n");
  go_on(place, folder / "x");
  CHECK(content(folder / "x") == "first\nsecond\n");

  const std::string long_text(200'000, 'x');
  go_on(place_behind(long_text + "\n", folder / "long"), folder / "long");
  CHECK(content(folder / "long") == long_text + "\nsecond\n");
}

TEST_CASE("A file does not go on in one that is shorter, another one or none") {
  const TemporaryFolder folder;
  const std::vector<std::byte> place = place_behind("first\n", folder / "x");
  std::filesystem::resize_file(folder / "x", 3);
  CHECK_THROWS_WITH(go_on(place, folder / "x"),
                    Contains("x: the file has 3 bytes, and 6 of the run"));
  folder.write("x", "other\nand longer\n");
  CHECK_THROWS_WITH(go_on(place, folder / "x"), Contains("is not the one that the run"));
  CHECK(content(folder / "x") == "other\nand longer\n");
  std::filesystem::remove(folder / "x");
  CHECK_THROWS_WITH(go_on(place, folder / "x"), Contains("cannot write on in this file: No such"));
  CHECK_THROWS_WITH(go_on(place, "/dev/null"), Contains("no regular file"));
}

TEST_CASE("A file that is kept stays as it is until it goes on") {
  const TemporaryFolder folder;
  const std::vector<std::byte> place = place_behind("first\n", folder / "x");
  const std::string before = content(folder / "x");
  {
    OutputFile file(folder / "x", {}, OutputFile::Existing::Kept);
    CHECK(file.is_untouched());
    file.write(std::string(200'000, 'x'));
    OutputFile::rescue_all();
    StateArchive state(place);
    file.persist(state);
    file.write("dropped\n");
    file.flush();
    CHECK(file.is_untouched());
    file.close();
  }
  CHECK(content(folder / "x") == before);
}

TEST_CASE("A byte that has changed far before the place is seen") {
  const TemporaryFolder folder;
  std::string text(300'000, 'x');
  const std::vector<std::byte> place = place_behind(text, folder / "x");
  text[100'000] = 'y';
  folder.write("x", text);
  CHECK_THROWS_WITH(go_on(place, folder / "x"), Contains("is not the one that the run"));
}

TEST_CASE("A file that has gone on knows its first bytes, and so does a copy of it") {
  const TemporaryFolder folder;
  const std::vector<std::byte> place = place_behind("first\n", folder / "x");
  OutputFile file(folder / "x", {}, OutputFile::Existing::Kept);
  StateArchive state(place);
  file.persist(state);
  file.go_on();
  file.write("second\n");
  file.flush();
  file.continue_in_copy(folder / "copy");
  file.write("third\n");
  StateArchive later;
  file.persist(later);
  file.close();
  OutputFile again(folder / "copy", {}, OutputFile::Existing::Kept);
  StateArchive read(later.bytes());
  CHECK_NOTHROW(again.persist(read));
  CHECK(content(folder / "copy") == "first\nsecond\nthird\n");
}
