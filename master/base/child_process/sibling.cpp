#include "master/base/child_process/sibling.h"

#include <cerrno>
#include <csignal>

#include <linux/futex.h>
#include <linux/sched.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {
namespace {

/// What the C library has registered in the kernel for the calling thread, and what a copy of it
/// does not inherit.
struct ThreadRecord {
  int* id = nullptr;  ///< where the library keeps the thread's number
  robust_list_head* locks = nullptr;
  std::size_t locks_size = 0;

  ThreadRecord() {
    if (::prctl(PR_GET_TID_ADDRESS, &id, 0, 0, 0) != 0) id = nullptr;
    if (::syscall(SYS_get_robust_list, 0, &locks, &locks_size) != 0) locks = nullptr;
  }
  void repeat() const {
    if (locks != nullptr) ::syscall(SYS_set_robust_list, locks, locks_size);
  }
};

pid_t clone_sibling(int* id) {
  unsigned long flags = CLONE_PARENT | SIGCHLD;
  if (id != nullptr) flags |= CLONE_CHILD_SETTID | CLONE_CHILD_CLEARTID;
#if defined(__x86_64__)
  return static_cast<pid_t>(::syscall(SYS_clone, flags, nullptr, nullptr, id, nullptr));
#elif defined(__s390__) || defined(__sparc__)
#error "the arguments of clone() have another order here"
#else
  return static_cast<pid_t>(::syscall(SYS_clone, flags, nullptr, nullptr, nullptr, id));
#endif
}

}  // namespace

pid_t fork_sibling() {
  const ThreadRecord record;
  const pid_t sibling = clone_sibling(record.id);
  if (sibling < 0) fail("clone");
  if (sibling == 0) record.repeat();
  return sibling;
}

std::size_t thread_count() {
  struct stat tasks {};
  // a folder has two links and one for each folder in it
  if (::stat("/proc/self/task", &tasks) != 0) fail("/proc/self/task");
  return tasks.st_nlink > 2 ? tasks.st_nlink - 2 : 1;
}

bool has_children() {
  siginfo_t ignored{};
  return ::waitid(P_ALL, 0, &ignored, WEXITED | WNOHANG | WNOWAIT | __WALL) == 0;
}

}  // namespace stride::isolation
