#include "master/base/child_process/sibling.h"

#include <string>
#include <thread>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/shared_memory.h"

using namespace stride::isolation;

TEST_CASE("a sibling has the same parent and the same memory, and a number of its own") {
  struct Seen {
    pid_t parent, itself;
    int value;
  };
  const Shared<Seen> seen;
  const ChildOutcome outcome = run_in_child([&] {
    const pid_t self = ::getpid();
    int value = 7;
    const pid_t child = ::fork();
    if (child == 0) {
      if (fork_sibling() == 0) {
        *seen = {::getppid(), ::getpid(), value};
        ::_exit(3);
      }
      value = 8;
      ::_exit(value);
    }
    int codes = 0;
    for (int status = 0; ::waitpid(-1, &status, 0) > 0;) codes += WEXITSTATUS(status);
    const bool is_sibling = seen->parent == self && seen->itself != child;
    return std::to_string(codes) + (is_sibling ? " sibling" : " other");
  });
  CHECK(outcome.text == "11 sibling");
  CHECK(seen->value == 7);
}

TEST_CASE("threads work in a sibling as they do in a fork") {
  const Shared<int> sum;
  const ChildOutcome outcome = run_in_child([&] {
    if (::fork() == 0) {
      if (fork_sibling() == 0) {
        std::thread([&] { *sum += 20; }).join();
        *sum += 1;
      }
      ::_exit(0);
    }
    while (::wait(nullptr) > 0) {
    }
    return std::to_string(*sum);
  });
  CHECK(outcome.text == "21");
}

TEST_CASE("threads are counted, and children are noticed until they are waited for") {
  const ChildOutcome outcome = run_in_child([] {
    std::string text = std::to_string(thread_count());
    std::thread([&] { text += std::to_string(thread_count()); }).join();
    // the thread is gone a moment after it was joined
    while (thread_count() > 1) ::usleep(100);
    text += has_children() ? "c" : "-";
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    text += has_children() ? "c" : "-";
    siginfo_t ended{};
    ::waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);
    text += has_children() ? "c" : "-";
    ::waitpid(child, nullptr, 0);
    return text + (has_children() ? "c" : "-");
  });
  CHECK(outcome.text == "12-cc-");
}
