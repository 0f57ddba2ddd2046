#include "master/base/child_process/descriptor.h"

#include <cerrno>
#include <system_error>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/surroundings.h"

using namespace stride::isolation;

namespace {

bool is_open(int file) { return ::fcntl(file, F_GETFD) >= 0; }

}  // namespace

TEST_CASE("a descriptor closes its file once") {
  Pipe pipe;
  const int number = pipe.write.number();
  Descriptor moved = std::move(pipe.write);
  CHECK_FALSE(pipe.write.is_open());
  CHECK(is_open(number));
  moved.close();
  CHECK_FALSE(is_open(number));
  moved.close();
}

TEST_CASE("a descriptor that takes over another file closes its own") {
  Pipe pipe;
  const int own = pipe.read.number();
  const int other = pipe.write.number();
  pipe.read = std::move(pipe.write);
  CHECK_FALSE(is_open(own));
  CHECK_FALSE(pipe.write.is_open());
  CHECK(pipe.read.number() == other);
  CHECK(is_open(other));
}

TEST_CASE("what is in a pipe is read in pieces, and the file is closed at its end") {
  Pipe pipe;
  std::string text;
  CHECK_FALSE(read_some(pipe.read, text));
  CHECK(pipe.read.is_open());
  write_all(pipe.write.number(), "abc", 3);
  CHECK(read_some(pipe.read, text));
  CHECK(text == "abc");
  write_all(pipe.write.number(), "def", 3);
  pipe.write.close();
  drain(pipe.read, text);
  CHECK(text == "abcdef");
  CHECK_FALSE(pipe.read.is_open());
  CHECK_FALSE(read_some(pipe.read, text));
}

TEST_CASE("a failure has what failed and the reason") {
  errno = ENOENT;
  try {
    fail("the thing");
  } catch (const std::system_error& failure) {
    CHECK(failure.code().value() == ENOENT);
    CHECK(std::string(failure.what()).find("the thing: ") == 0);
  }
}

TEST_CASE("all files are closed but the standard ones and those that are kept") {
  Pipe first;
  Pipe second;
  const ChildOutcome outcome = run_in_child([&] {
    const int answer = ::dup(STDOUT_FILENO);  // the child's own pipe is closed, too
    close_other_files({second.write.number(), first.read.number(), answer});
    std::string text;
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, first.read.number(), first.write.number(),
                           second.read.number(), second.write.number()}) {
      text += is_open(file) ? '1' : '0';
    }
    write_all(answer, text.data(), text.size());
    return text;
  });
  CHECK(outcome.printed == "111001");
}
