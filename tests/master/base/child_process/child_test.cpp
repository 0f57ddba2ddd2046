#include "master/base/child_process/child.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/children.h"
#include "master/base/child_process/shared_memory.h"

using namespace stride::isolation;
using namespace std::chrono_literals;
using End = ChildOutcome::End;

namespace {

/// Whether this process has a child left, living or not.
bool has_child_left() { return ::waitpid(-1, nullptr, WNOHANG) != -1; }

void wait_for_ever() {
  for (;;) std::this_thread::sleep_for(1s);
}

/// Whoever adopts it may take a while to bury it: whether the process goes on running for five
/// seconds.
bool goes_on(pid_t process) {
  const auto lives = [&] { return living_thread(process).has_value(); };
  for (int i = 0; i < 500 && lives(); ++i) std::this_thread::sleep_for(10ms);
  return lives();
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
  CHECK_FALSE(goes_on(*grandchild));
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

namespace {

/// Leaves its session and its parent, as a service does.
void start_daemon(std::atomic<pid_t>& number) {
  if (::fork() == 0) {
    ::setsid();
    if (::fork() == 0) {
      number = ::getpid();
      wait_for_ever();
    }
    ::_exit(0);
  }
  while (number == 0) std::this_thread::sleep_for(1ms);
}

constexpr ChildOptions kKept{.limit = {}, .interrupted = nullptr, .grace = {}, .has_keeper = true};

}  // namespace

TEST_CASE("a child with a keeper ends as one without") {
  CHECK(run_in_child([] { return std::string("yes"); }, kKept).text == "yes");
  const ChildOutcome thrown =
      run_in_child([]() -> std::string { throw std::runtime_error("no"); }, kKept);
  CHECK(thrown.end == End::Threw);
  CHECK(thrown.text == "no");
  for (const int signal : {SIGSEGV, SIGABRT, SIGKILL, SIGTERM}) {
    const ChildOutcome outcome = run_in_child(
        [&] {
          std::raise(signal);
          return std::string();
        },
        kKept);
    CHECK(outcome.end == End::Killed);
    CHECK(outcome.code == signal);
  }
  const ChildOutcome outcome = run_in_child(
      []() -> std::string {
        std::puts("printed");
        std::fflush(stdout);
        ::_exit(3);
      },
      kKept);
  CHECK(outcome.end == End::Exited);
  CHECK(outcome.code == 3);
  CHECK(outcome.printed == "printed\n");
  CHECK_FALSE(has_child_left());
}

TEST_CASE("a child that ends its keeper is one without a known end") {
  const pid_t self = ::getpid();
  const ChildOutcome outcome = run_in_child(
      [&] {
        if (::getppid() == self) return std::string("no keeper");
        ::kill(::getppid(), SIGKILL);
        wait_for_ever();
        return std::string();
      },
      kKept);
  CHECK(outcome.end == End::Unkept);
  CHECK_FALSE(has_child_left());
}

TEST_CASE("no signal but SIGKILL does anything to a keeper") {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGSTOP, SIGXCPU, SIGSEGV, SIGCHLD}) {
    CAPTURE(signal);
    const ChildOutcome outcome = run_in_child(
        [&] {
          ::kill(::getppid(), signal);
          std::this_thread::sleep_for(20ms);
          return std::string("done");
        },
        kKept);
    CHECK(outcome.end == End::Answered);
    CHECK(outcome.text == "done");
  }
  CHECK_FALSE(has_child_left());
}

TEST_CASE("a child that limits its keeper is one without a known end") {
  rlimit before{};
  ::getrlimit(RLIMIT_CPU, &before);
  for (const auto resource : {RLIMIT_CPU, RLIMIT_NOFILE, RLIMIT_FSIZE}) {
    CAPTURE(resource);
    const ChildOutcome outcome = run_in_child(
        [&] {
          const rlimit none{0, 0};
          return std::to_string(::prlimit(::getppid(), resource, &none, nullptr));
        },
        kKept);
    CHECK(outcome.end == End::Unkept);
  }
  rlimit after{};
  ::getrlimit(RLIMIT_CPU, &after);
  CHECK(after.rlim_max == before.rlim_max);
}

TEST_CASE("no daemon outlives the keeper of the child that has started it") {
  const Shared<std::atomic<pid_t>> daemon;
  const auto run = [&](const std::function<void()>& end, ChildOptions options) {
    *daemon = 0;
    return run_in_child(
        [&] {
          start_daemon(*daemon);
          end();
          return std::string();
        },
        options);
  };
  CHECK(run([] {}, kKept).end == End::Answered);
  CHECK_FALSE(goes_on(*daemon));
  CHECK(run([] { std::raise(SIGKILL); }, kKept).end == End::Killed);
  CHECK_FALSE(goes_on(*daemon));
  ChildOptions limited = kKept;
  limited.limit = 300ms;
  CHECK(run(wait_for_ever, limited).end == End::TimedOut);
  CHECK_FALSE(goes_on(*daemon));
  CHECK(run([] {}, {}).end == End::Answered);
  CHECK(::kill(*daemon, 0) == 0);
  ::kill(*daemon, SIGKILL);
}

TEST_CASE("a daemon of a child that has killed its keeper is ended by who adopts it") {
  const Shared<std::atomic<pid_t>> daemon, other;
  const ChildOutcome outcome = run_in_child([&] {
    adopt_orphans();
    const Child beside([&]() -> std::string {
      *other = ::getpid();
      wait_for_ever();
      return {};
    });
    while (*other == 0) std::this_thread::sleep_for(1ms);
    const ChildOutcome kept = run_in_child(
        [&] {
          start_daemon(*daemon);
          ::kill(::getppid(), SIGKILL);
          wait_for_ever();
          return std::string();
        },
        kKept);
    if (kept.end != End::Unkept) return std::string("kept");
    if (!goes_on(*daemon)) return std::string("ended before");
    const Child* const own = &beside;
    Child::end_others({&own, 1});
    if (goes_on(*daemon)) return std::string("goes on");
    return std::string(goes_on(*other) ? "good" : "a child has ended, too");
  });
  CHECK(outcome.text == "good");
}

TEST_CASE("no daemon of a kept child outlives the process that has started both") {
  const Shared<std::atomic<pid_t>> daemon;
  const pid_t parent = ::fork();
  if (parent == 0) {
    run_in_child(
        [&] {
          start_daemon(*daemon);
          wait_for_ever();
          return std::string();
        },
        kKept);
    ::_exit(0);
  }
  while (*daemon == 0) std::this_thread::sleep_for(1ms);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  CHECK_FALSE(goes_on(*daemon));
}

TEST_CASE("a child with a keeper that asks to be debugged ends all the same") {
  const ChildOutcome outcome = run_in_child(
      [] {
        ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
        std::raise(SIGSEGV);
        return std::string();
      },
      kKept);
  CHECK(outcome.end == End::Killed);
  CHECK(outcome.code == SIGSEGV);
}
