#include "master/base/child_process/open_files.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"
#include "tests/scratch_folder.h"

using namespace stride::isolation;

namespace {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Descriptor opened_file(const std::filesystem::path& file, int how) {
  Descriptor opened(::open(file.c_str(), how, 0600));
  REQUIRE(opened.is_open());
  return opened;
}

void write_text(const Descriptor& file, const std::string& text) {
  write_all(file.number(), text.data(), text.size());
}

std::string read_text(const Descriptor& file, std::size_t size) {
  std::string text(size, '\0');
  REQUIRE(::read(file.number(), text.data(), size) == static_cast<ssize_t>(size));
  return text;
}

}  // namespace

TEST_CASE("what was written since is taken back") {
  const stride::tests::ScratchFolder scratch;
  const int how = GENERATE(O_WRONLY, O_RDWR, O_WRONLY | O_APPEND);
  const Descriptor file = opened_file(scratch / "trace", how | O_CREAT);
  write_text(file, "one\n");
  OpenFiles files({});
  files.note();
  write_text(file, "two\n");
  files.set_back();
  CHECK(text_of(scratch / "trace") == "one\n");
  write_text(file, "three\n");
  CHECK(text_of(scratch / "trace") == "one\nthree\n");
  files.set_back();
  CHECK(text_of(scratch / "trace") == "one\n");
}

TEST_CASE("after the reset of its position a file gives the same bytes again") {
  const stride::tests::ScratchFolder scratch;
  std::ofstream(scratch / "stimuli") << "abcdef";
  const Descriptor file = opened_file(scratch / "stimuli", O_RDONLY);
  CHECK(read_text(file, 2) == "ab");
  OpenFiles files({});
  files.note();
  CHECK(read_text(file, 3) == "cde");
  files.set_back();
  CHECK(read_text(file, 4) == "cdef");
  CHECK(text_of(scratch / "stimuli") == "abcdef");
}

TEST_CASE("a file that has lost its end is an error that names it") {
  const stride::tests::ScratchFolder scratch;
  const Descriptor file = opened_file(scratch / "short", O_WRONLY | O_CREAT);
  write_text(file, "text");
  OpenFiles files({});
  files.note();
  REQUIRE(::ftruncate(file.number(), 1) == 0);
  CHECK_THROWS_WITH(files.set_back(), Catch::Contains((scratch / "short").string()) &&
                                          Catch::Contains("its end is gone"));
}

TEST_CASE("files of others, pipes and what has no position stay what they are") {
  const stride::tests::ScratchFolder scratch;
  const Descriptor other = opened_file(scratch / "other", O_WRONLY | O_CREAT);
  const Pipe pipe;
  OpenFiles files({other.number()});
  files.note();
  write_text(other, "text");
  write_text(pipe.write, "x");
  files.set_back();
  CHECK(text_of(scratch / "other") == "text");
  CHECK(read_text(pipe.read, 1) == "x");
}

TEST_CASE("what was noted before is forgotten") {
  const stride::tests::ScratchFolder scratch;
  OpenFiles files({});
  {
    const Descriptor first = opened_file(scratch / "first", O_WRONLY | O_CREAT);
    files.note();
  }
  const Descriptor second = opened_file(scratch / "second", O_WRONLY | O_CREAT);
  write_text(second, "text");
  files.note();
  files.set_back();
  CHECK(text_of(scratch / "second") == "text");
}
