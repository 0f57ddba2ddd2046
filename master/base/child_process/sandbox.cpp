#include "master/base/child_process/sandbox.h"

#include <algorithm>
#include <cstdint>
#include <system_error>

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"
#include "master/base/child_process/landlock.h"
#include "master/base/child_process/system_calls.h"

namespace stride::isolation {
namespace {

constexpr rlim_t kOpenFiles = 4096;

constexpr std::uint32_t kFileCapabilities = 1U << CAP_CHOWN | 1U << CAP_DAC_OVERRIDE |
                                            1U << CAP_DAC_READ_SEARCH | 1U << CAP_FOWNER |
                                            1U << CAP_FSETID;

void forbid_new_privileges() {
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) fail("prctl");
}

/// Keeps of its privileges those for files. Has no effect on a process without any.
void drop_capabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct sets[_LINUX_CAPABILITY_U32S_3];
  if (::syscall(SYS_capget, &header, sets) != 0) fail("capget");
  std::uint32_t kept = kFileCapabilities;
  for (__user_cap_data_struct& set : sets) {
    set.effective &= kept;
    set.permitted &= kept;
    set.inheritable &= kept;
    kept = 0;
  }
  if (::syscall(SYS_capset, &header, sets) != 0) fail("capset");
}

void lower_limit(__rlimit_resource resource, rlim_t most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) fail("getrlimit");
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  limit.rlim_max = std::min(limit.rlim_max, most);
  if (::setrlimit(resource, &limit) != 0) fail("setrlimit");
}

void lower_limits() {
  lower_limit(RLIMIT_CORE, 0);
  lower_limit(RLIMIT_NOFILE, kOpenFiles);
}

std::vector<Descriptor> open_all(std::span<const WritableFolder> folders) {
  std::vector<Descriptor> opened;
  for (const WritableFolder& folder : folders) {
    opened.emplace_back(::open(folder.path.c_str(), O_PATH | O_CLOEXEC));
    if (!opened.back().is_open()) fail(("cannot open '" + folder.path.string() + "'").c_str());
  }
  return opened;
}

std::string read_only_files(std::span<const WritableFolder> writable) {
  std::string names;
  for (const WritableFolder& folder : writable) names += (names.empty() ? "" : ", ") + folder.name;
  return names.empty() ? "read-only files" : "read-only files, but for " + names;
}

/// Puts a protection on, or notes why it cannot be had.
template <class Work>
bool put_on(Protections& protections, const std::string& what, Work&& work) {
  try {
    work();
  } catch (const std::system_error& error) {
    protections.missing.push_back(what + " (" + error.what() + ")");
    return false;
  }
  protections.in_force.push_back(what);
  return true;
}

void guard_files(Protections& protections, std::span<const WritableFolder> writable) {
  const std::vector<Descriptor> opened = open_all(writable);
  int version = 0;
  const bool is_guarded = put_on(protections, read_only_files(writable), [&] {
    version = landlock_version();
    restrict_files(opened, version);
  });
  if (!is_guarded) return;
  const std::string mechanism = ": Landlock " + std::to_string(version);
  protections.in_force.back() += mechanism;
  protections.in_force.push_back("no terminals and other devices" + mechanism);
  if (version < kLandlockTruncates) {
    put_on(protections, "no truncation by name: seccomp", forbid_truncation);
  }
  constexpr const char* kSignals = "no signals to others";
  if (version >= kLandlockSignals) {
    protections.in_force.push_back(kSignals);
  } else {
    protections.missing.push_back(std::string(kSignals) + " (Landlock " + std::to_string(version) +
                                  " does not restrict signals)");
  }
}

}  // namespace

Protections enter_sandbox(std::span<const WritableFolder> writable, bool has_memory_limit) {
  Protections protections;
  put_on(protections, "no new privileges", forbid_new_privileges);
  put_on(protections, "no capabilities, but those for files", drop_capabilities);
  put_on(protections, "no core dump, at most " + std::to_string(kOpenFiles) + " open files",
         lower_limits);
  guard_files(protections, writable);
  put_on(protections, "no network: seccomp", forbid_network);
  put_on(protections, "no calls that name other processes: seccomp", forbid_reaching_processes);
  put_on(protections, "no namespaces, mounts and other changes of the system: seccomp",
         forbid_administration);
  put_on(protections,
         "no change of owners, times and modes of files (chmod() does nothing): seccomp",
         forbid_changing_attributes);
  put_on(protections, "no requests to files and devices (ioctl): seccomp", forbid_requests);
  put_on(protections, "no locks on files (flock() does nothing): seccomp", ignore_locks);
  if (has_memory_limit) {
    put_on(protections, "no files sent through sockets, for the memory limit: seccomp",
           forbid_hiding_files);
  }
  put_on(protections, "no system calls newer than Linux 6.4: seccomp", forbid_newer_calls);
  return protections;
}

}  // namespace stride::isolation
