#include "master/isolation/process/child.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "master/isolation/process/shared_memory.h"

using namespace stride::isolation;
using namespace std::chrono_literals;
using End = ChildOutcome::End;

namespace {

/// Whether this process has a child left, living or not.
bool has_child_left() { return ::waitpid(-1, nullptr, WNOHANG) != -1; }

void wait_for_ever() {
  for (;;) std::this_thread::sleep_for(1s);
}

}  // namespace

TEST_CASE("a child's answer comes back, however long it is") {
  for (const std::size_t size : {0U, 1U, 70'000U, 3'000'000U}) {
    const ChildOutcome outcome = run_in_child([&] { return std::string(size, 'x'); });
    CHECK(outcome.end == End::Answered);
    CHECK(outcome.text.size() == size);
  }
  CHECK_FALSE(has_child_left());
}

TEST_CASE("what a child changes changes nothing here") {
  int number = 1;
  const ChildOutcome outcome = run_in_child([&] { return std::to_string(++number); });
  CHECK(outcome.text == "2");
  CHECK(number == 1);
}

TEST_CASE("an exception's message comes back") {
  const ChildOutcome outcome =
      run_in_child([]() -> std::string { throw std::runtime_error("no"); });
  CHECK(outcome.end == End::Threw);
  CHECK(outcome.text == "no");
  CHECK(run_in_child([]() -> std::string { throw 42; }).end == End::Threw);
}

TEST_CASE("a crash is reported by its signal, an exit by its code") {
  for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
    const ChildOutcome outcome = run_in_child([&] {
      std::raise(signal);
      return std::string();
    });
    CHECK(outcome.end == End::Killed);
    CHECK(outcome.code == signal);
  }
  const ChildOutcome outcome = run_in_child([]() -> std::string { ::_exit(3); });
  CHECK(outcome.end == End::Exited);
  CHECK(outcome.code == 3);
  CHECK(run_in_child([]() -> std::string { ::_exit(0); }).end == End::Exited);
  CHECK(signal_name(SIGSEGV) == "SIGSEGV");
  CHECK_FALSE(has_child_left());
}

TEST_CASE("the exit functions of a child's work are called, and none of this process") {
  static const pid_t own = ::getpid();
  std::atexit([] {
    if (::getpid() != own) std::raise(SIGABRT);
  });
  CHECK(run_in_child([] { return std::string(); }).end == End::Answered);
  const ChildOutcome outcome = run_in_child([] {
    std::atexit([] { std::raise(SIGKILL); });
    return std::string();
  });
  CHECK(outcome.end == End::Killed);
  CHECK(outcome.code == SIGKILL);
}

TEST_CASE("a child that takes too long is ended, and with it its own children") {
  const Shared<std::atomic<pid_t>> grandchild;
  const ChildOutcome outcome = run_in_child(
      [&] {
        if (const pid_t own = ::fork(); own == 0)
          wait_for_ever();
        else
          *grandchild = own;
        wait_for_ever();
        return std::string();
      },
      {.limit = 200ms});
  CHECK(outcome.end == End::TimedOut);
  REQUIRE(*grandchild != 0);
  CHECK_FALSE(has_child_left());
  // whoever adopts the grandchild may take a while to bury it
  const auto lives = [&] {
    char state = 'X';
    const std::string path = "/proc/" + std::to_string(*grandchild) + "/stat";
    if (std::FILE* const file = std::fopen(path.c_str(), "r")) {
      if (std::fscanf(file, "%*d (%*[^)]) %c", &state) != 1) state = 'X';
      std::fclose(file);
    }
    return state != 'X' && state != 'Z';
  };
  for (int i = 0; i < 500 && lives(); ++i) std::this_thread::sleep_for(10ms);
  CHECK_FALSE(lives());
}

TEST_CASE("a child ends when the user wants it") {
  volatile std::sig_atomic_t interrupted = 1;
  const ChildOutcome outcome = run_in_child(
      [] {
        wait_for_ever();
        return std::string();
      },
      {.interrupted = &interrupted});
  CHECK(outcome.end == End::Interrupted);
  CHECK_FALSE(has_child_left());
}

TEST_CASE("an answer counts although something holds the child's pipes open") {
  const ChildOutcome outcome = run_in_child([] {
    if (::fork() == 0) wait_for_ever();
    return std::string("done");
  });
  CHECK(outcome.end == End::Answered);
  CHECK(outcome.text == "done");
}

TEST_CASE("the end of what a child prints is kept") {
  const ChildOutcome outcome = run_in_child([] {
    for (int i = 0; i < 100'000; ++i) std::fputs("a long story\n", stderr);
    std::fputs("the end", stderr);
    return std::string();
  });
  CHECK(outcome.end == End::Answered);
  CHECK(outcome.printed.size() <= 4096);
  CHECK(outcome.printed.substr(outcome.printed.size() - 7) == "the end");
}

TEST_CASE("a child may have children of its own") {
  const ChildOutcome outcome = run_in_child([] {
    const ChildOutcome inner = run_in_child([] {
      std::raise(SIGFPE);
      return std::string();
    });
    return signal_name(inner.code);
  });
  CHECK(outcome.text == "SIGFPE");
}

TEST_CASE("children work beside each other, and are waited for as long as one likes") {
  SharedMemory memory(sizeof(std::atomic<int>));
  auto* const ready = new (memory.data()) std::atomic<int>(0);
  const auto work = [&] {
    ++*ready;
    while (*ready < 3) std::this_thread::sleep_for(1ms);
    return std::string("both");
  };
  Child first(work);
  Child second(work);
  while (*ready < 2) std::this_thread::sleep_for(1ms);
  CHECK_FALSE(first.wait(0ms));
  CHECK_FALSE(second.wait(5ms));
  ++*ready;
  CHECK(second.wait(1h)->text == "both");
  CHECK(first.wait(1h)->text == "both");
  CHECK_FALSE(has_child_left());
}

TEST_CASE("a child that is not waited for is killed") {
  {
    const Child child([]() -> std::string {
      wait_for_ever();
      return {};
    });
  }
  CHECK_FALSE(has_child_left());
}
