#include "master/base/child_process/children.h"

#include <algorithm>
#include <csignal>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/process_memory.h"
#include "master/base/child_process/shared_memory.h"

using namespace stride::isolation;

namespace {

using Processes = std::vector<pid_t>;

/// Sleeps until it is killed.
pid_t start_sleeper() {
  const pid_t child = ::fork();
  if (child == 0) {
    for (;;) ::pause();
  }
  return child;
}

bool has(const Processes& processes, pid_t process) {
  return std::ranges::find(processes, process) != processes.end();
}

}  // namespace

TEST_CASE("the children of all threads of a process, and theirs, are listed") {
  const Shared<std::atomic<pid_t>> grandchild;
  pid_t child = 0;
  std::thread([&] {
    child = ::fork();
    if (child != 0) return;
    *grandchild = start_sleeper();
    for (;;) ::pause();
  }).join();
  while (*grandchild == 0) std::this_thread::yield();
  CHECK(has(children_of(::getpid()).value(), child));
  CHECK_FALSE(has(children_of(::getpid()).value(), *grandchild));
  CHECK(has(descendants_of(::getpid()), *grandchild));
  CHECK(kill_children_of(child));
  while (kill_children_of(child)) {
  }
  CHECK(children_of(child).value() == Processes{*grandchild});  // which has ended
  while (kill_children_of(::getpid())) {
  }
  ::waitpid(child, nullptr, 0);
  CHECK_FALSE(has(children_of(::getpid()).value(), child));
}

TEST_CASE("a process whose first thread has ended lives on in another one") {
  const pid_t child = ::fork();
  if (child == 0) {
    std::thread([] {
      for (;;) ::pause();
    }).detach();
    ::syscall(SYS_exit, 0);
  }
  while (living_thread(child) == child) std::this_thread::yield();
  REQUIRE(living_thread(child));
  CHECK(unshared_bound(child) == 0);
  CHECK(unshared_bound(*living_thread(child)) > 0);
  CHECK(kill_children_of(::getpid()));
  while (living_thread(child)) std::this_thread::yield();
  ::waitpid(child, nullptr, 0);
}

TEST_CASE("a process that does not exist has no list of children") {
  CHECK_FALSE(children_of(-1));
  CHECK(descendants_of(-1).empty());
  CHECK_FALSE(kill_children_of(-1));
}
