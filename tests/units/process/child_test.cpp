// Programs are started, and leave nothing behind.
#include "units/process/child.h"

#include <csignal>
#include <fstream>
#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/scratch_folder.h"
#include "tests/units/process/program.h"

using namespace std::chrono_literals;
using process::Child;
using stride::tests::ScratchFolder;
using stride::tests::shell;

namespace {

constexpr auto kLong = 60s;

/// Waits for what is written, up to a line feed or the end.
std::string line_of(int descriptor) {
  std::string text;
  while (text.empty() || text.back() != '\n') {
    char c = 0;
    const ssize_t size = ::read(descriptor, &c, 1);
    if (size == 1) {
      text += c;
    } else if (size == 0) {
      return text;
    } else {
      std::this_thread::sleep_for(1ms);
    }
  }
  return text;
}

/// Whether a process of this number is gone, or only its entry is left.
bool has_ended(int id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/stat");
  std::string text;
  std::getline(status, text);
  return !status || text[text.rfind(')') + 2] == 'Z';
}

bool ends(int id) {
  for (int i = 0; i < 10'000 && !has_ended(id); ++i) std::this_thread::sleep_for(1ms);
  return has_ended(id);
}

bool has_children() {
  siginfo_t info{};
  return ::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0;
}

}  // namespace

TEST_CASE("lines go to the program and come from it") {
  Child child(shell("read -r line; echo \"<$line>\"; echo wrong >&2; exit 3"));
  REQUIRE(::write(child.input().number(), "hello\n", 6) == 6);
  CHECK(line_of(child.output().number()) == "<hello>\n");
  CHECK(line_of(child.error().number()) == "wrong\n");
  REQUIRE(child.wait(kLong));
  CHECK(child.ending() == "ended with the exit code 3");
  CHECK_FALSE(child.has_succeeded());
}

TEST_CASE("the program has the variables that it is given, and those of this process") {
  ::setenv("STRIDE_TEST_A", "old", 1);
  ::setenv("STRIDE_TEST_AB", "kept", 1);
  Child child(shell("echo \"$STRIDE_TEST_A $STRIDE_TEST_AB $STRIDE_TEST_B\""),
              {"STRIDE_TEST_A=new", "STRIDE_TEST_B=b=c"});
  ::unsetenv("STRIDE_TEST_A");
  ::unsetenv("STRIDE_TEST_AB");
  CHECK(line_of(child.output().number()) == "new kept b=c\n");
}

TEST_CASE("the error has the signal that ended the program") {
  Child child(shell("kill -SEGV $$"));
  REQUIRE(child.wait(kLong));
  CHECK(child.ending() == "was killed by signal 11 (SIGSEGV)");
}

TEST_CASE("a program that cannot be started is an error with the reason") {
  const ScratchFolder folder;
  const std::string plain = (folder / "plain").string();
  std::ofstream(plain) << "no program";
  const std::string other = (folder / "other").string();
  std::ofstream(other) << "#!/no/such/interpreter\n";
  CHECK_THROWS_WITH(Child({plain}), Catch::Contains("cannot start '" + plain + "'") &&
                                        Catch::Contains("a script begins with #!"));
  CHECK_THROWS_WITH(Child({other}), Catch::Contains("it does not exist, or the interpreter"));
  CHECK_THROWS_WITH(Child({"/no/such/program"}), Catch::Contains("it does not exist"));
  CHECK_THROWS_WITH(Child({folder.operator/("").string()}),
                    Catch::Contains("make it an executable file"));
  CHECK_THROWS_WITH(Child({"no-such-program"}), Catch::Contains("it is in no folder of PATH (") &&
                                                    Catch::Contains("install it"));
  CHECK_FALSE(has_children());
}

TEST_CASE("a file that has lost its permission in an archive gets it back") {
  const ScratchFolder folder;
  const std::string script = (folder / "script").string();
  std::ofstream(script) << "#!/bin/sh\nexit 0\n";
  Child child({script});
  REQUIRE(child.wait(kLong));
  CHECK(child.has_succeeded());
}

TEST_CASE("with the object go the program, what it has started, and its entry") {
  int grandchild = 0;
  {
    Child child(shell("trap '' TERM INT; sleep 1000 & echo $!; wait"));
    grandchild = std::stoi(line_of(child.output().number()));
    CHECK_FALSE(child.wait(10ms));
    CHECK_FALSE(has_ended(grandchild));
  }
  CHECK(ends(grandchild));
  CHECK_FALSE(has_children());
}

TEST_CASE("what a program leaves behind when it ends goes, too") {
  Child child(shell("sleep 1000 & echo $!"));
  const int grandchild = std::stoi(line_of(child.output().number()));
  REQUIRE(child.wait(kLong));
  CHECK(ends(grandchild));
}

TEST_CASE("it is not in the group that a terminal interrupts") {
  Child child(shell("ps -o pgid= -p $$ || cut -d' ' -f5 /proc/$$/stat"));
  CHECK(std::stoi(line_of(child.output().number())) != ::getpgrp());
}

TEST_CASE("the program does not outlive the process that has started it, however that ends") {
  int ends_of_pipe[2];
  REQUIRE(::pipe(ends_of_pipe) == 0);
  const pid_t starter = ::fork();
  if (starter == 0) {
    Child child(shell("while :; do sleep 1000; done"));
    const int out = ::dup(ends_of_pipe[1]);
    Child second(shell("echo $$; exec sleep 1000"));
    const std::string id = line_of(second.output().number());
    [[maybe_unused]] const auto told = ::write(out, id.data(), id.size());
    ::kill(::getpid(), SIGKILL);
  }
  ::close(ends_of_pipe[1]);
  const int id = std::stoi(line_of(ends_of_pipe[0]));
  int status = 0;
  REQUIRE(::waitpid(starter, &status, 0) == starter);
  CHECK(WIFSIGNALED(status));
  CHECK(ends(id));
  ::close(ends_of_pipe[0]);
}

TEST_CASE("no descriptor is left open, and none is inherited") {
  const auto open_descriptors = [] {
    std::size_t count = 0;
    for (int i = 0; i < 256; ++i) count += ::fcntl(i, F_GETFD) >= 0 ? 1 : 0;
    return count;
  };
  const std::size_t before = open_descriptors();
  const int inheritable = ::dup(STDERR_FILENO);
  {
    Child child(shell("ls /proc/self/fd | sort -n | tail -n 1"));
    CHECK(std::stoi(line_of(child.output().number())) <= 3);  // and that of ls itself
  }
  ::close(inheritable);
  for (int i = 0; i < 5; ++i) CHECK_THROWS(Child({"/no/such/program"}));
  CHECK(open_descriptors() == before);
}
