#include "master/base/child_process/system_calls.h"

#include <cstdint>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <string>
#include <thread>
#include <vector>

#include <linux/close_range.h>
#include <linux/fs.h>
#include <linux/io_uring.h>
#include <mqueue.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/msg.h>
#include <sys/resource.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/uio.h>
#include <sys/xattr.h>
#include <utime.h>

#include "master/base/child_process/sandbox.h"
#include "tests/master/base/child_process/sandbox_support.h"

using namespace stride::isolation;
using namespace stride::tests;

namespace {

constexpr unsigned long kSetExt4Version = _IOW('f', 4, long);

void filtered(void (*forbid)()) {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  forbid();
}

std::string say_filtered(void (*forbid)(), const std::function<std::string()>& work) {
  return in_child([&] {
    filtered(forbid);
    return work();
  });
}

bool lacks_seccomp() {
  return is_missing("seccomp", [] {
    const ChildOutcome outcome = run_in_child([] {
      filtered(forbid_network);
      return std::string("fine");
    });
    if (outcome.text != "fine")
      throw std::system_error(ENOSYS, std::generic_category(), outcome.text);
  });
}

}  // namespace

TEST_CASE("of the sockets only those within the machine are left") {
  if (lacks_seccomp()) return;
  for (const int domain : {AF_INET, AF_INET6, AF_PACKET, AF_NETLINK, AF_VSOCK, AF_ALG}) {
    for (const int type : {SOCK_STREAM, SOCK_DGRAM, SOCK_RAW}) {
      INFO("domain " << domain << ", type " << type);
      CHECK(say_filtered(forbid_network, [&] { return answer(::socket(domain, type, 0)); }) ==
            "EACCES");
    }
  }
  CHECK(say_filtered(forbid_network, [] { return answer(::socket(AF_UNIX, SOCK_STREAM, 0)); }) ==
        "done");
  CHECK(say_filtered(forbid_network, [] {
          int ends[2];
          const std::string made = answer(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends));
          return made + answer(::send(ends[0], "x", 1, 0));
        }) == "donedone");
}

TEST_CASE("no socket comes by way of io_uring") {
  if (lacks_seccomp()) return;
  CHECK(say_filtered(forbid_network, [] {
          io_uring_params parameters{};
          return answer(::syscall(SYS_io_uring_setup, 1, &parameters));
        }) == "EACCES");
}

TEST_CASE("files and terminals take no requests but harmless ones") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto path = write_file(scratch / "file", "text");
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const Terminal terminal;
  const auto request = [](const Descriptor& to, unsigned long number) {
    return [&to, number] {
      long data[64] = {};
      return answer(::ioctl(to.number(), number, data));
    };
  };
  for (const unsigned long number : {TIOCGWINSZ, TIOCSWINSZ, TCGETS, TIOCOUTQ, TIOCINQ}) {
    INFO("request " << number);
    const bool is_harmless = number == TCGETS || number == TIOCINQ;
    CHECK(in_child(request(terminal.user, number)) == "done");
    CHECK(say_filtered(forbid_requests, request(terminal.user, number)) ==
          (is_harmless ? "done" : "ENOTTY"));
  }
  for (const unsigned long number : {FS_IOC_SETFLAGS, FS_IOC_SETVERSION, kSetExt4Version}) {
    INFO("request " << number);
    CHECK(say_filtered(forbid_requests, request(file, number)) == "ENOTTY");
  }
  for (const unsigned long number : {FIONREAD, FIOCLEX, FIONCLEX}) {
    CHECK(say_filtered(forbid_requests, request(file, number)) == "done");
  }
  CHECK(say_filtered(forbid_requests, [&] {  // only the lower half counts
          long data[64] = {};
          return answer(::syscall(SYS_ioctl, terminal.user.number(), 1UL << 32 | TIOCSWINSZ, data));
        }) == "ENOTTY");
}

namespace {

struct Attempt {
  const char* what;
  std::function<long()> call;
};

/// Each is done without the filter, or fails for another reason than a filter's.
void check_denied(void (*forbid)(), const std::vector<Attempt>& attempts) {
  for (const Attempt& attempt : attempts) {
    INFO(attempt.what);
    const auto work = [&] { return answer(attempt.call()); };
    CHECK(in_child(work) != "EACCES");
    CHECK(say_filtered(forbid, work) == "EACCES");
  }
}

}  // namespace

TEST_CASE("no other process is reached by its number, a key or a name") {
  if (lacks_seccomp()) return;
  const pid_t other = ::getpid();
  const rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
  const sched_param parameters{};
  cpu_set_t all;
  ::sched_getaffinity(0, sizeof all, &all);
  char byte = 0;
  const iovec place{&byte, 1};
  constexpr int kIdle = 3 << 13;  // a class of priorities for files
  check_denied(
      forbid_reaching_processes,
      {{"limits", [&] { return ::syscall(SYS_prlimit64, other, RLIMIT_CORE, &limit, nullptr); }},
       {"priority", [&] { return ::setpriority(PRIO_PROCESS, other, 0); }},
       {"priority of the group", [&] { return ::setpriority(PRIO_PGRP, other, 0); }},
       {"priority of the user", [] { return ::setpriority(PRIO_USER, 0, 19); }},
       {"priority for files", [&] { return ::syscall(SYS_ioprio_set, 1, other, kIdle); }},
       {"the user's for files", [] { return ::syscall(SYS_ioprio_set, 3, 0, kIdle); }},
       {"processors", [&] { return ::sched_setaffinity(other, sizeof all, &all); }},
       {"scheduler", [&] { return ::sched_setscheduler(other, SCHED_OTHER, &parameters); }},
       {"its parameters", [&] { return ::sched_setparam(other, &parameters); }},
       {"its attributes", [&] { return ::syscall(SYS_sched_setattr, other, nullptr, 0); }},
       {"read memory", [&] { return ::process_vm_readv(other, &place, 1, &place, 1, 0); }},
       {"write memory", [&] { return ::process_vm_writev(other, &place, 1, &place, 1, 0); }},
       {"compare", [&] { return ::syscall(SYS_kcmp, other, other, 0, 0, 0); }},
       {"move pages",
        [&] { return ::syscall(SYS_move_pages, other, 0L, nullptr, nullptr, nullptr, 0); }},
       {"migrate pages", [&] { return ::syscall(SYS_migrate_pages, other, 0L, nullptr, nullptr); }},
       {"its files", [] { return ::syscall(SYS_pidfd_getfd, -1, 0, 0); }},
       {"advice", [] { return ::syscall(SYS_process_madvise, -1, nullptr, 0L, 0, 0); }},
       {"counters", [] { return ::syscall(SYS_perf_event_open, nullptr, 0, -1, -1, ~0UL); }},
       {"hiding", [] { return ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0); }},
       {"outliving", [] { return ::prctl(PR_SET_PDEATHSIG, 0, 0, 0, 0); }},
       {"System V memory", [] { return ::shmget(0x5712de, 1, 0); }},
       {"System V memory by number",
        [] { return reinterpret_cast<long>(::shmat(0x5712de, nullptr, 0)); }},
       {"System V semaphores", [] { return ::semget(0x5712de, 1, 0); }},
       {"System V queues", [] { return ::msgget(0x5712de, 0); }},
       {"POSIX queues", [] { return ::mq_open("/stride-test", O_RDONLY); }},
       {"keys", [] { return ::syscall(SYS_keyctl, 0, -3, 0); }},
       {"a lease", [&] { return ::fcntl(STDIN_FILENO, F_SETLEASE, F_RDLCK); }},
       {"a file by its handle", [] { return ::syscall(SYS_open_by_handle_at, -1, nullptr, 0); }}});
}

TEST_CASE("the system, and what a process sees of it, stay as they are") {
  if (lacks_seccomp()) return;
  const auto clone_with = [](unsigned long flags) {
    return [=] {
      const long child = ::syscall(SYS_clone, flags | SIGCHLD, nullptr, nullptr, nullptr, nullptr);
      if (child == 0) ::_exit(0);
      return child;
    };
  };
  check_denied(
      forbid_administration,
      {{"a namespace of users", [] { return ::unshare(CLONE_NEWUSER); }},
       {"of mounts", [] { return ::unshare(CLONE_NEWNS); }},
       {"a process with one of users", clone_with(CLONE_NEWUSER)},
       {"of mounts", clone_with(CLONE_NEWUSER | CLONE_NEWNS)},
       {"of processes", clone_with(CLONE_NEWUSER | CLONE_NEWPID)},
       {"of the network", clone_with(CLONE_NEWUSER | CLONE_NEWNET)},
       {"of another process", [] { return ::setns(-1, 0); }},
       {"a mount", [] { return ::mount("none", "", "tmpfs", 0, nullptr); }},
       {"the end of one", [] { return ::umount2("", 0); }},
       {"another root", [] { return ::chroot(""); }},
       {"another root of all", [] { return ::syscall(SYS_pivot_root, "", ""); }},
       {"a copy of mounts", [] { return ::syscall(SYS_open_tree, -1, "", 0); }},
       {"a mount elsewhere", [] { return ::syscall(SYS_move_mount, -1, "", -1, "", 0); }},
       {"a file system", [] { return ::syscall(SYS_fsopen, "", 0); }},
       {"its settings", [] { return ::syscall(SYS_fsconfig, -1, 0, nullptr, nullptr, 0); }},
       {"a mount of it", [] { return ::syscall(SYS_fsmount, -1, 0, 0); }},
       {"one that is there", [] { return ::syscall(SYS_fspick, -1, "", 0); }},
       {"attributes of a mount",
        [] { return ::syscall(SYS_mount_setattr, -1, "", 0, nullptr, 0L); }},
       {"a program in the kernel", [] { return ::syscall(SYS_bpf, -1, nullptr, 0); }},
       {"a module", [] { return ::syscall(SYS_init_module, nullptr, 0L, ""); }},
       {"a module from a file", [] { return ::syscall(SYS_finit_module, -1, "", 0); }},
       {"the end of a module", [] { return ::syscall(SYS_delete_module, "", 0); }},
       {"another kernel", [] { return ::syscall(SYS_kexec_load, 0L, ~0L, nullptr, ~0L); }},
       {"a reboot", [] { return ::syscall(SYS_reboot, 0, 0, 0, nullptr); }},
       {"secret memory", [] { return ::syscall(SYS_memfd_secret, ~0U); }},
       {"faults of pages", [] { return ::syscall(SYS_userfaultfd, ~0U); }},
       {"a watch over file systems", [] { return ::syscall(SYS_fanotify_init, ~0U, 0); }},
       {"the kernel's log", [] { return ::syscall(SYS_syslog, -1, nullptr, 0); }},
       {"accounting", [] { return ::acct(""); }},
       {"quotas", [] { return ::syscall(SYS_quotactl, -1, "", 0, nullptr); }},
       {"swap space", [] { return ::syscall(SYS_swapon, "", 0); }},
       {"its end", [] { return ::syscall(SYS_swapoff, ""); }},
       {"the host's name", [] { return ::syscall(SYS_sethostname, nullptr, -1L); }},
       {"the domain's name", [] { return ::syscall(SYS_setdomainname, nullptr, -1L); }},
       {"the clock", [] { return ::syscall(SYS_clock_settime, -1, nullptr); }}});
#ifdef __x86_64__
  check_denied(forbid_administration,
               {{"segments", [] { return ::syscall(SYS_modify_ldt, 0, nullptr, 0L); }},
                {"I/O ports", [] { return ::syscall(SYS_iopl, 99); }},
                {"one of them", [] { return ::syscall(SYS_ioperm, 0L, 0L, 99); }}});
#endif
}

TEST_CASE("threads and programs start without clone3(), whose flags cannot be seen") {
  if (lacks_seccomp()) return;
  CHECK(say_filtered(forbid_administration,
                     [] { return answer(::syscall(SYS_clone3, nullptr, 0L)); }) == "ENOSYS");
  CHECK(say_filtered(forbid_administration, [] {
          int number = 0;
          std::thread([&] { number = 42; }).join();
          return std::to_string(number) + " " + std::to_string(std::system("exit 3") >> 8);
        }) == "42 3");
}

TEST_CASE("a unit's own limits, priority and processors can be changed") {
  if (lacks_seccomp()) return;
  const auto say_of = [](const auto& work) {
    return say_filtered(forbid_reaching_processes, work);
  };
  CHECK(say_of([] {
          rlimit limit{};
          ::getrlimit(RLIMIT_CORE, &limit);
          return answer(::setrlimit(RLIMIT_CORE, &limit));
        }) == "done");
  CHECK(say_of([] { return answer(::setpriority(PRIO_PROCESS, 0, 19)); }) == "done");
  CHECK(say_of([] { return answer(::prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0)); }) == "done");
  CHECK(say_of([] {
          cpu_set_t all;
          ::sched_getaffinity(0, sizeof all, &all);
          return answer(::sched_setaffinity(0, sizeof all, &all));
        }) == "done");
}

TEST_CASE("modes, owners, times and attributes of files stay as they are") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto path = write_file(scratch / "file", "text");
  const char* const file = path.c_str();
  const int open = ::open(file, O_RDONLY | O_CLOEXEC);
  const uid_t user = ::getuid();
  const gid_t group = ::getgid();
  check_denied(forbid_changing_attributes,
               {{"chown", [&] { return ::chown(file, user, group); }},
                {"fchown", [&] { return ::fchown(open, user, group); }},
                {"lchown", [&] { return ::lchown(file, user, group); }},
                {"fchownat", [&] { return ::fchownat(AT_FDCWD, file, user, group, 0); }},
                {"utime", [&] { return ::utime(file, nullptr); }},
                {"utimes", [&] { return ::utimes(file, nullptr); }},
                {"futimens", [&] { return ::futimens(open, nullptr); }},
                {"utimensat", [&] { return ::utimensat(AT_FDCWD, file, nullptr, 0); }},
                {"setxattr", [&] { return ::setxattr(file, "user.x", "y", 1, 0); }},
                {"lsetxattr", [&] { return ::lsetxattr(file, "user.x", "y", 1, 0); }},
                {"fsetxattr", [&] { return ::fsetxattr(open, "user.x", "y", 1, 0); }},
                {"removexattr", [&] { return ::removexattr(file, "user.x"); }},
                {"fremovexattr", [&] { return ::fremovexattr(open, "user.x"); }}});
  ::close(open);
}

TEST_CASE("a lock of a file is not had, and answers that it is") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto path = write_file(scratch / "file", "text");
  const Descriptor own(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  const Descriptor others(::open(path.c_str(), O_RDWR | O_CLOEXEC));
  REQUIRE(::flock(own.number(), LOCK_EX) == 0);
  struct flock range {};
  range.l_type = F_WRLCK;
  REQUIRE(::fcntl(own.number(), F_OFD_SETLK, &range) == 0);
  const auto lock = [&] {
    std::string answers = answer(::flock(others.number(), LOCK_EX | LOCK_NB));
    for (const int command : {F_SETLK, F_OFD_SETLK}) {
      answers += " " + answer(::fcntl(others.number(), command, &range));
    }
    return answers;
  };
  CHECK(in_child(lock) == "EAGAIN EAGAIN EAGAIN");
  CHECK(say_filtered(ignore_locks, lock) == "done done done");
  CHECK(say_filtered(ignore_locks, [&] {
          return answer(::fcntl(others.number(), F_SETLKW, &range)) +
                 answer(::fcntl(others.number(), F_OFD_SETLKW, &range)) +
                 answer(::fcntl(others.number(), F_GETFL));
        }) == "donedonedone");
}

TEST_CASE("no thread has open files of its own") {
  if (lacks_seccomp()) return;
  constexpr unsigned long kThread = CLONE_VM | CLONE_FS | CLONE_SIGHAND | CLONE_THREAD;
  const auto start = [](unsigned long flags) {
    return [=] {
      alignas(16) static char stack[1 << 16];
      const auto wait = [](void*) { return ::pause(); };
      return answer(::clone(wait, stack + sizeof stack, static_cast<int>(flags), nullptr));
    };
  };
  CHECK(in_child(start(kThread)) == "done");
  CHECK(say_filtered(forbid_hiding_files, start(kThread)) == "EACCES");
  CHECK(say_filtered(forbid_hiding_files, start(kThread | CLONE_FILES)) == "done");
  check_denied(forbid_hiding_files,
               {{"a list of its own",
                 [] { return ::syscall(SYS_close_range, 1000, 1001, CLOSE_RANGE_UNSHARE); }}});
}

TEST_CASE("a change of a file's mode is not made, and answers that it is") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto path = write_file(scratch / "file", "text");
  const char* const file = path.c_str();
  ::chmod(file, 0640);
  const mode_t mode = GENERATE(0, 0600, 0700, 0644, 01777, 04755);
  const int open = ::open(file, O_RDONLY | O_CLOEXEC);
  CHECK(say_filtered(forbid_changing_attributes, [&] {
          return answer(::chmod(file, mode)) + answer(::fchmod(open, mode)) +
                 answer(::fchmodat(AT_FDCWD, file, mode, 0));
        }) == "donedonedone");
  struct stat status {};
  ::fstat(open, &status);
  CHECK((status.st_mode & 07777) == 0640);
  ::close(open);
}

TEST_CASE("files are copied by what sets the mode of the copy, too") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto path = write_file(scratch / "file", "text");
  ::chmod(path.c_str(), 0644);
  const auto copy = scratch / "copy";
  CHECK(say_filtered(forbid_changing_attributes, [&] {
          std::filesystem::copy_file(path, copy);
          return content(copy);
        }) == "text");
}

TEST_CASE("nothing is made that runs with the rights of its owner or group") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const std::string folder = (scratch / "").string();
  const std::string program = folder + "/program";
  const int at = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  constexpr int kNew = O_CREAT | O_RDWR;
  const mode_t mode = GENERATE(04755, 02755);
  check_denied(forbid_changing_attributes,
               {{"openat", [&] { return ::open((program + "1").c_str(), kNew, mode); }},
                {"open", [&] { return ::syscall(SYS_open, (program + "2").c_str(), kNew, mode); }},
                {"nameless", [&] { return ::open(folder.c_str(), O_TMPFILE | O_RDWR, mode); }},
                {"creat", [&] { return ::syscall(SYS_creat, (program + "3").c_str(), mode); }},
                {"mknod", [&] { return ::mknodat(at, "4", S_IFREG | mode, 0); }},
                {"mkdir", [&] { return ::mkdir((program + "5").c_str(), mode); }},
                {"mkdirat", [&] { return ::mkdirat(at, "6", mode); }}});
  CHECK(say_filtered(forbid_changing_attributes, [&] {
          return answer(::open((program + "7").c_str(), kNew, 0666));
        }) == "done");
  ::close(at);
}

TEST_CASE("no file is sent through a socket, and bytes are") {
  if (lacks_seccomp()) return;
  int ends[2];
  REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
  char byte = 0;
  iovec content{&byte, 1};
  mmsghdr message{};
  message.msg_hdr.msg_iov = &content;
  message.msg_hdr.msg_iovlen = 1;
  check_denied(forbid_hiding_files,
               {{"sendmsg", [&] { return ::sendmsg(ends[0], &message.msg_hdr, 0); }},
                {"sendmmsg", [&] { return ::sendmmsg(ends[0], &message, 1, 0); }}});
  CHECK(say_filtered(forbid_hiding_files, [&] { return answer(::send(ends[0], "x", 1, 0)); }) ==
        "done");
  for (const int end : ends) ::close(end);
}

TEST_CASE("calls that are newer than the filters do not exist") {
  if (lacks_seccomp()) return;
  constexpr long kFchmodat2 = 452;
  const ScratchFolder scratch;
  const auto file = write_file(scratch / "file", "text");
  const auto work = [&] { return answer(::syscall(kFchmodat2, AT_FDCWD, file.c_str(), 0600, 0)); };
  CHECK(say_filtered(forbid_newer_calls, work) == "ENOSYS");
  CHECK(say_filtered(forbid_newer_calls, [&] { return content(file); }) == "text");
}

#ifdef __x86_64__
namespace {

/// As a 32-bit program makes a call: the answer, or an errno, negated.
long call32(long number, long first = 0, long second = 0, long third = 0, long fourth = 0,
            long fifth = 0) {
  long result = number;
  asm volatile("int $0x80"
               : "+a"(result)
               : "b"(first), "c"(second), "d"(third), "S"(fourth), "D"(fifth)
               : "memory", "r8", "r9", "r10", "r11");
  return result;
}

constexpr long kGetpid32 = 20, kSocket32 = 359;

bool lacks_32_bit_calls() {
  return is_missing("32-bit system call", [] {
    if (in_child([] { return std::to_string(call32(kGetpid32)); }) != std::to_string(-ENOSYS)) {
      return;
    }
    throw std::system_error(ENOSYS, std::generic_category(), "int $0x80");
  });
}

/// Memory with addresses of 32 bits.
class LowMemory {
 public:
  LowMemory()
      : bytes_(static_cast<char*>(::mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_32BIT, -1, 0))) {
    REQUIRE(bytes_ != MAP_FAILED);
  }
  ~LowMemory() { ::munmap(bytes_, kSize); }
  LowMemory(const LowMemory&) = delete;
  LowMemory& operator=(const LowMemory&) = delete;

  /// Its address.
  long put(const void* content, std::size_t size) {
    char* const place = bytes_ + used_;
    std::memcpy(place, content, size);
    used_ += (size + 7) / 8 * 8;
    return reinterpret_cast<long>(place);
  }
  long put(const std::string& text) { return put(text.c_str(), text.size() + 1); }

 private:
  static constexpr std::size_t kSize = 4096;

  char* bytes_;
  std::size_t used_ = 0;
};

std::string name_of(long answer) { return answer >= 0 ? "done" : ::strerrorname_np(-answer); }

/// In a sandbox that lets nothing be written.
std::string in_sandbox(const std::function<long()>& call) {
  return in_child([&] {
    enter_sandbox({}, true);
    return name_of(call());
  });
}

}  // namespace

TEST_CASE("a 32-bit call gets nothing that others do not") {
  if (lacks_seccomp() || lacks_32_bit_calls()) return;
  const auto socket32 = [](long domain) {
    return [=] { return name_of(call32(kSocket32, domain, SOCK_STREAM)); };
  };
  CHECK(in_child(socket32(AF_INET)) == "done");
  CHECK(say_filtered(forbid_network, socket32(AF_INET)) == "EACCES");
  CHECK(say_filtered(forbid_network, socket32(AF_UNIX)) == "done");
}

TEST_CASE("a 32-bit call changes no file, and reaches nothing, outside of the sandbox") {
  if (lacks_seccomp() || lacks_landlock() || lacks_32_bit_calls()) return;
  const ScratchFolder scratch;
  const auto path = write_file(scratch / "file", "text");
  const int open = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  LowMemory low;
  const long file = low.put(path.string()), other = low.put(path.string() + "2");
  const long attribute = low.put("user.x");
  const std::uint32_t words[] = {AF_INET, SOCK_STREAM, 0};
  const long socket = low.put(words, sizeof words);
  for (const auto& change_mode :
       {std::function<long()>([=] { return call32(15, file, 0); }),
        std::function<long()>([=] { return call32(94, open, 0); }),
        std::function<long()>([=] { return call32(306, AT_FDCWD, file, 0); })}) {
    CHECK(in_sandbox(change_mode) == "done");
    CHECK((std::filesystem::status(path).permissions() & std::filesystem::perms::owner_read) !=
          std::filesystem::perms::none);
  }
  const std::vector<Attempt> attempts{
      {"lchown", [=] { return call32(16, file, 1, 1); }},
      {"lchown32", [=] { return call32(198, file, 1, 1); }},
      {"chown32", [=] { return call32(212, file, 1, 1); }},
      {"fchownat", [=] { return call32(298, AT_FDCWD, file, 1, 1, 0); }},
      {"utime", [=] { return call32(30, file, 0); }},
      {"utimes", [=] { return call32(271, file, 0); }},
      {"futimesat", [=] { return call32(299, AT_FDCWD, file, 0); }},
      {"utimensat", [=] { return call32(320, AT_FDCWD, file, 0, 0); }},
      {"utimensat_time64", [=] { return call32(412, AT_FDCWD, file, 0, 0); }},
      {"setxattr", [=] { return call32(226, file, attribute, attribute, 1, 0); }},
      {"removexattr", [=] { return call32(235, file, attribute); }},
      {"socketcall(socket)", [=] { return call32(102, 1, socket); }},
      {"socketcall(sendmsg)", [=] { return call32(102, 16, socket); }},
      {"truncate", [=] { return call32(92, file, 0); }},
      {"truncate64", [=] { return call32(193, file, 0, 0); }},
      {"open", [=] { return call32(5, file, O_WRONLY); }},
      {"open to truncate", [=] { return call32(5, file, O_RDONLY | O_TRUNC); }},
      {"creat", [=] { return call32(8, other, 0600); }},
      {"rename", [=] { return call32(38, file, other); }},
      {"link", [=] { return call32(9, file, other); }},
      {"symlink", [=] { return call32(83, file, other); }},
      {"mkdir", [=] { return call32(39, other, 0700); }},
      {"mknod", [=] { return call32(14, other, S_IFIFO | 0600, 0); }},
      {"unlink", [=] { return call32(10, file); }},
      {"a namespace", [] { return call32(310, CLONE_NEWUSER); }},
      {"a mount", [=] { return call32(21, file, file, 0, 0, 0); }},
      {"lease", [=] { return call32(55, open, F_SETLEASE, F_RDLCK); }},
      {"lease by fcntl64", [=] { return call32(221, open, F_SETLEASE, F_RDLCK); }},
      {"System V memory", [] { return call32(117, 23, 0x5712de, 1, 0); }},
      {"limits of others", [] { return call32(340, ::getppid(), RLIMIT_CORE, 0, 0); }},
      {"priority", [] { return call32(97, PRIO_PROCESS, ::getppid(), 0); }},
      {"memory of others", [] { return call32(348, ::getppid(), 0, 0, 0, 0); }}};
  for (const Attempt& attempt : attempts) {
    INFO(attempt.what);
    const std::string answer = in_sandbox(attempt.call);
    CHECK((answer == "EACCES" || answer == "EPERM" || answer == "EXDEV"));
    CHECK(content(path) == "text");
    CHECK_FALSE(std::filesystem::exists(path.string() + "2"));
  }
  ::close(open);
}
#endif

TEST_CASE("files are not cut off by name") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto file = write_file(scratch / "file", "text");
  const auto say_of = [&](const auto& work) { return say_filtered(forbid_truncation, work); };
  CHECK(say_of([&] { return answer(::truncate(file.c_str(), 0)); }) == "EACCES");
  CHECK(say_of([&] { return open_file(file, O_RDONLY | O_TRUNC); }) == "EACCES");
  CHECK(say_of([&] { return answer(::syscall(SYS_open, file.c_str(), O_RDONLY | O_TRUNC)); }) ==
        "EACCES");
  CHECK(content(file) == "text");
  // who may write it may do that, too: Landlock sees to it
  CHECK(say_of([&] { return open_file(file, O_RDONLY); }) == "done");
  CHECK(say_of([&] { return open_file(file, O_WRONLY | O_TRUNC); }) == "done");
  CHECK(content(file).empty());
}
