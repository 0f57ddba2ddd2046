#include "master/base/child_process/system_calls.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <linux/close_range.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>

namespace stride::isolation {
namespace {

/// What libseccomp returns: 0 or an errno, negated.
void require(int result) {
  if (result < 0) throw std::system_error(-result, std::generic_category(), "seccomp");
}

scmp_arg_cmp argument(unsigned index, scmp_compare how, scmp_datum_t value,
                      scmp_datum_t second = 0) {
  return {index, how, value, second};
}

/// IOPRIO_WHO_USER of <linux/ioprio.h>, which of some kernels is no C++.
constexpr scmp_datum_t kPriorityOfUser = 3;

/// The part of a register that holds an int.
constexpr scmp_datum_t kInt = 0xffffffffU;

/// Lets through what no rule denies.
class Filter {
 public:
  Filter() : context_(::seccomp_init(SCMP_ACT_ALLOW)) {
    if (context_ == nullptr) throw std::system_error(ENOMEM, std::generic_category(), "seccomp");
    add_architectures();
  }
  ~Filter() { ::seccomp_release(context_); }
  Filter(const Filter&) = delete;
  Filter& operator=(const Filter&) = delete;

  /// The call with such arguments; it answers with this error.
  void deny(int call, std::initializer_list<scmp_arg_cmp> arguments = {}, int error = EACCES) {
    require(::seccomp_rule_add_array(context_, SCMP_ACT_ERRNO(static_cast<std::uint16_t>(error)),
                                     call, static_cast<unsigned>(arguments.size()),
                                     arguments.begin()));
  }

  /// The call does nothing, and answers that it is done.
  void ignore(int call, std::initializer_list<scmp_arg_cmp> arguments = {}) {
    deny(call, arguments, 0);
  }

  /// All of these calls, with any arguments.
  void deny_all(std::initializer_list<int> calls) {
    for (const int call : calls) deny(call);
  }

  void load() {
    // it is no filter between secrets, so memory accesses need not be slowed down for it
    ::seccomp_attr_set(context_, SCMP_FLTATR_CTL_SSB, 1);
    require(::seccomp_load(context_));
  }

 private:
  /// Programs of a machine's other interfaces pass through the same filter.
  void add_architectures() {
    require(::seccomp_attr_set(context_, SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_ERRNO(EACCES)));
    if (::seccomp_arch_native() == SCMP_ARCH_X86_64) {
      require(::seccomp_arch_add(context_, SCMP_ARCH_X86));
      require(::seccomp_arch_add(context_, SCMP_ARCH_X32));
    } else if (::seccomp_arch_native() == SCMP_ARCH_AARCH64) {
      require(::seccomp_arch_add(context_, SCMP_ARCH_ARM));
    }
  }

  scmp_filter_ctx context_;
};

/// What is made cannot run with the rights of its owner or group.
void deny_special_modes(Filter& filter) {
  constexpr scmp_datum_t kNameless = O_TMPFILE & ~O_DIRECTORY;
  for (const scmp_datum_t right : {scmp_datum_t{S_ISUID}, scmp_datum_t{S_ISGID}}) {
    const auto has = [&](unsigned index) {
      return argument(index, SCMP_CMP_MASKED_EQ, right, right);
    };
    for (const scmp_datum_t making : {scmp_datum_t{O_CREAT}, kNameless}) {
      filter.deny(SCMP_SYS(open), {argument(1, SCMP_CMP_MASKED_EQ, making, making), has(2)});
      filter.deny(SCMP_SYS(openat), {argument(2, SCMP_CMP_MASKED_EQ, making, making), has(3)});
    }
    for (const int call : {SCMP_SYS(creat), SCMP_SYS(mkdir), SCMP_SYS(mknod)}) {
      filter.deny(call, {has(1)});
    }
    for (const int call : {SCMP_SYS(mkdirat), SCMP_SYS(mknodat)}) filter.deny(call, {has(2)});
  }
  filter.deny(SCMP_SYS(openat2));  // whose mode cannot be seen
}

/// For what libseccomp cannot express.
void load(std::span<sock_filter> program) {
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  if (::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) != 0) {
    throw std::system_error(errno, std::generic_category(), "seccomp");
  }
}

/// The number of ioctl() in each of the machine's interfaces.
struct Interface {
  std::uint32_t architecture;
  std::uint32_t request_call;
};

#if defined(__x86_64__)
constexpr std::uint32_t kX32 = 0x40000000;
constexpr Interface kInterfaces[] = {{SCMP_ARCH_X86_64, 16},
                                     {SCMP_ARCH_X86_64, kX32 | 16},
                                     {SCMP_ARCH_X86_64, kX32 | 514},
                                     {SCMP_ARCH_X86, 54}};
#elif defined(__aarch64__)
constexpr Interface kInterfaces[] = {{SCMP_ARCH_AARCH64, 29}, {SCMP_ARCH_ARM, 54}};
#else
const Interface kInterfaces[] = {{::seccomp_arch_native(), __NR_ioctl}};
#endif

/// Flags of a descriptor, how much can be read, whether it is a terminal.
constexpr std::uint32_t kHarmlessRequests[] = {FIOCLEX,  FIONCLEX, FIONBIO,
                                               FIOASYNC, FIONREAD, TCGETS};
/// The middle byte of all requests to /dev/dri.
constexpr std::uint32_t kKind = 0xff00, kRendering = std::uint32_t{'d'} << 8;

void forbid_requests_through(const Interface& interface) {
  std::vector<sock_filter> program;
  const auto look_at = [&](std::size_t offset) {
    program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  };
  const auto answer = [&](std::uint32_t action) {
    program.push_back(BPF_STMT(BPF_RET | BPF_K, action));
  };
  const auto allow_unless = [&](std::uint32_t value) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 1, 0));
    answer(SECCOMP_RET_ALLOW);
  };
  const auto allow_if = [&](std::uint32_t value) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1));
    answer(SECCOMP_RET_ALLOW);
  };
  look_at(offsetof(seccomp_data, arch));
  allow_unless(interface.architecture);
  look_at(offsetof(seccomp_data, nr));
  allow_unless(interface.request_call);
  look_at(offsetof(seccomp_data, args) + sizeof(seccomp_data::args[0]));  // its lower half
  for (const std::uint32_t request : kHarmlessRequests) allow_if(request);
  program.push_back(BPF_STMT(BPF_ALU | BPF_AND | BPF_K, kKind));
  allow_if(kRendering);
  answer(SECCOMP_RET_ERRNO | ENOTTY);
  load(program);
}

}  // namespace

void forbid_network() {
  Filter filter;
  filter.deny(SCMP_SYS(socket), {argument(0, SCMP_CMP_NE, AF_UNIX)});
  constexpr int kSocket = 1;  // of a 32-bit program, whose arguments cannot be seen
  filter.deny(SCMP_SYS(socketcall), {argument(0, SCMP_CMP_EQ, kSocket)});
  filter.deny(SCMP_SYS(io_uring_setup));  // makes sockets, too
  filter.load();
}

void forbid_reaching_processes() {
  Filter filter;
  const auto not_own = [](unsigned index) { return argument(index, SCMP_CMP_NE, 0); };
  for (const int call : {SCMP_SYS(prlimit64), SCMP_SYS(sched_setaffinity), SCMP_SYS(sched_setattr),
                         SCMP_SYS(sched_setparam), SCMP_SYS(sched_setscheduler),
                         SCMP_SYS(move_pages), SCMP_SYS(migrate_pages)}) {
    filter.deny(call, {not_own(0)});
  }
  filter.deny(SCMP_SYS(setpriority), {not_own(1)});
  filter.deny(SCMP_SYS(setpriority), {argument(0, SCMP_CMP_MASKED_EQ, kInt, PRIO_USER)});
  filter.deny(SCMP_SYS(ioprio_set), {not_own(1)});
  filter.deny(SCMP_SYS(ioprio_set), {argument(0, SCMP_CMP_MASKED_EQ, kInt, kPriorityOfUser)});
  // others that open the file wait for the process that has a lease on it
  for (const int call : {SCMP_SYS(fcntl), SCMP_SYS(fcntl64)}) {
    filter.deny(call, {argument(1, SCMP_CMP_MASKED_EQ, kInt, F_SETLEASE)});
  }
  // hides the process from its supervisor, or lets it live on without one
  filter.deny(SCMP_SYS(prctl), {argument(0, SCMP_CMP_MASKED_EQ, kInt, PR_SET_DUMPABLE)});
  filter.deny(SCMP_SYS(prctl), {argument(0, SCMP_CMP_MASKED_EQ, kInt, PR_SET_PDEATHSIG),
                                argument(1, SCMP_CMP_NE, SIGKILL)});
  filter.deny_all({SCMP_SYS(process_vm_readv), SCMP_SYS(process_vm_writev),
                   SCMP_SYS(process_madvise), SCMP_SYS(process_mrelease), SCMP_SYS(pidfd_getfd),
                   SCMP_SYS(kcmp), SCMP_SYS(perf_event_open), SCMP_SYS(open_by_handle_at)});
  filter.deny_all({SCMP_SYS(shmget), SCMP_SYS(shmat), SCMP_SYS(shmctl), SCMP_SYS(semget),
                   SCMP_SYS(semop), SCMP_SYS(semtimedop), SCMP_SYS(semtimedop_time64),
                   SCMP_SYS(semctl), SCMP_SYS(msgget), SCMP_SYS(msgsnd), SCMP_SYS(msgrcv),
                   SCMP_SYS(msgctl), SCMP_SYS(ipc)});
  filter.deny_all({SCMP_SYS(mq_open), SCMP_SYS(mq_unlink)});
  filter.deny_all({SCMP_SYS(keyctl), SCMP_SYS(add_key), SCMP_SYS(request_key)});
  filter.load();
}

void forbid_administration() {
  Filter filter;
  constexpr std::array<scmp_datum_t, 7> kNamespaces{CLONE_NEWNS,  CLONE_NEWCGROUP, CLONE_NEWUTS,
                                                    CLONE_NEWIPC, CLONE_NEWUSER,   CLONE_NEWPID,
                                                    CLONE_NEWNET};
  for (const scmp_datum_t kind : kNamespaces) {
    filter.deny(SCMP_SYS(clone), {argument(0, SCMP_CMP_MASKED_EQ, kind, kind)});
  }
  filter.deny(SCMP_SYS(clone3), {}, ENOSYS);
  filter.deny_all({SCMP_SYS(unshare), SCMP_SYS(setns)});
  filter.deny_all({SCMP_SYS(mount), SCMP_SYS(umount), SCMP_SYS(umount2), SCMP_SYS(pivot_root),
                   SCMP_SYS(chroot), SCMP_SYS(open_tree), SCMP_SYS(move_mount), SCMP_SYS(fsopen),
                   SCMP_SYS(fsconfig), SCMP_SYS(fsmount), SCMP_SYS(fspick),
                   SCMP_SYS(mount_setattr)});
  filter.deny_all({SCMP_SYS(bpf), SCMP_SYS(init_module), SCMP_SYS(finit_module),
                   SCMP_SYS(delete_module), SCMP_SYS(kexec_load), SCMP_SYS(kexec_file_load),
                   SCMP_SYS(reboot)});
  filter.deny_all({SCMP_SYS(memfd_secret), SCMP_SYS(userfaultfd), SCMP_SYS(fanotify_init),
                   SCMP_SYS(modify_ldt), SCMP_SYS(vm86), SCMP_SYS(vm86old), SCMP_SYS(iopl),
                   SCMP_SYS(ioperm)});
  filter.deny_all({SCMP_SYS(syslog), SCMP_SYS(acct), SCMP_SYS(quotactl), SCMP_SYS(quotactl_fd),
                   SCMP_SYS(swapon), SCMP_SYS(swapoff), SCMP_SYS(sethostname),
                   SCMP_SYS(setdomainname), SCMP_SYS(settimeofday), SCMP_SYS(stime),
                   SCMP_SYS(clock_settime), SCMP_SYS(clock_settime64)});
  filter.load();
}

void forbid_changing_attributes() {
  Filter filter;
  filter.deny_all({SCMP_SYS(chown), SCMP_SYS(chown32), SCMP_SYS(fchown), SCMP_SYS(fchown32),
                   SCMP_SYS(lchown), SCMP_SYS(lchown32), SCMP_SYS(fchownat), SCMP_SYS(utime),
                   SCMP_SYS(utimes), SCMP_SYS(futimesat), SCMP_SYS(utimensat),
                   SCMP_SYS(utimensat_time64), SCMP_SYS(setxattr), SCMP_SYS(lsetxattr),
                   SCMP_SYS(fsetxattr), SCMP_SYS(removexattr), SCMP_SYS(lremovexattr),
                   SCMP_SYS(fremovexattr)});
  // what copies or unpacks files takes a failure for that of its work, and rarely needs the effect
  for (const int call : {SCMP_SYS(chmod), SCMP_SYS(fchmod), SCMP_SYS(fchmodat)}) {
    filter.ignore(call);
  }
  deny_special_modes(filter);
  filter.load();
}

void forbid_requests() {
  for (const Interface& interface : kInterfaces) forbid_requests_through(interface);
}

void ignore_locks() {
  Filter filter;
  filter.ignore(SCMP_SYS(flock));
  constexpr scmp_datum_t kOfSmallMachines[] = {13, 14};  // F_SETLK64, F_SETLKW64
  for (const int call : {SCMP_SYS(fcntl), SCMP_SYS(fcntl64)}) {
    const auto ignore = [&](scmp_datum_t command) {
      filter.ignore(call, {argument(1, SCMP_CMP_MASKED_EQ, kInt, command)});
    };
    for (const int command : {F_SETLK, F_SETLKW, F_OFD_SETLK, F_OFD_SETLKW}) {
      ignore(static_cast<scmp_datum_t>(command));
    }
    for (const scmp_datum_t command : kOfSmallMachines) ignore(command);
  }
  filter.load();
}

void forbid_hiding_files() {
  Filter filter;
  // a thread with open files of its own, where the supervisor does not look
  filter.deny(SCMP_SYS(clone),
              {argument(0, SCMP_CMP_MASKED_EQ, CLONE_THREAD | CLONE_FILES, CLONE_THREAD)});
  filter.deny(SCMP_SYS(close_range),
              {argument(2, SCMP_CMP_MASKED_EQ, CLOSE_RANGE_UNSHARE, CLOSE_RANGE_UNSHARE)});
  filter.deny_all({SCMP_SYS(sendmsg), SCMP_SYS(sendmmsg)});
  constexpr int kSendMessage = 16, kSendMessages = 20;  // of a 32-bit program
  filter.deny(SCMP_SYS(socketcall), {argument(0, SCMP_CMP_EQ, kSendMessage)});
  filter.deny(SCMP_SYS(socketcall), {argument(0, SCMP_CMP_EQ, kSendMessages)});
  filter.load();
}

void forbid_newer_calls() {
  // libseccomp knows calls by their names only; these have the same numbers on all machines, and
  // those of x32 are greater
  constexpr std::uint32_t kFirstOfLinux65 = 451;
  sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, kFirstOfLinux65, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  load(program);
}

void forbid_truncation() {
  Filter filter;
  filter.deny(SCMP_SYS(truncate));
  filter.deny(SCMP_SYS(truncate64));
  filter.deny(SCMP_SYS(openat2));  // its flags cannot be seen
  constexpr scmp_datum_t kSeen = O_TRUNC | O_ACCMODE;
  constexpr scmp_datum_t kDenied = O_TRUNC | O_RDONLY;
  filter.deny(SCMP_SYS(open), {argument(1, SCMP_CMP_MASKED_EQ, kSeen, kDenied)});
  filter.deny(SCMP_SYS(openat), {argument(2, SCMP_CMP_MASKED_EQ, kSeen, kDenied)});
  filter.load();
}

}  // namespace stride::isolation
