#include "master/base/child_process/landlock.h"

#include <cstdint>
#include <filesystem>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {
namespace {

// newer than the header of Debian 12
constexpr std::uint64_t kTruncate = 1ULL << 14;
constexpr std::uint64_t kRequests = 1ULL << 15;  // LANDLOCK_ACCESS_FS_IOCTL_DEV
constexpr std::uint64_t kScopeSignal = 1ULL << 1;

/// A kernel that knows less of it takes it as long as the rest is zero.
struct RulesetAttributes {
  std::uint64_t handled_access_fs;
  std::uint64_t handled_access_net;
  std::uint64_t scoped;
};

constexpr std::uint64_t kChangesOfFolders =
    LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;

/// Neither a disk nor a person behind them; dri is for rendering.
constexpr const char* kDevices[] = {"/dev/null",   "/dev/zero",    "/dev/full",
                                    "/dev/random", "/dev/urandom", "/dev/dri"};

std::uint64_t changes_of_files(int version) {
  return LANDLOCK_ACCESS_FS_WRITE_FILE | (version >= kLandlockTruncates ? kTruncate : 0);
}

/// From one folder to another; before version 2 that is denied everywhere.
std::uint64_t renaming(int version) { return version >= 2 ? LANDLOCK_ACCESS_FS_REFER : 0; }

std::uint64_t all_changes(int version) {
  return kChangesOfFolders | changes_of_files(version) | renaming(version);
}

/// Reading is handled for the sake of devices.
std::uint64_t uses_of_devices(int version) {
  return LANDLOCK_ACCESS_FS_READ_FILE | (version >= kLandlockRequests ? kRequests : 0);
}

Descriptor make_ruleset(int version) {
  const RulesetAttributes attributes{all_changes(version) | uses_of_devices(version), 0,
                                     version >= kLandlockSignals ? kScopeSignal : 0};
  const long ruleset = ::syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0);
  if (ruleset < 0) fail("landlock_create_ruleset");
  return Descriptor(static_cast<int>(ruleset));
}

void allow(const Descriptor& ruleset, const Descriptor& path, std::uint64_t uses) {
  landlock_path_beneath_attr rule{};
  rule.allowed_access = uses;
  rule.parent_fd = path.number();
  if (::syscall(SYS_landlock_add_rule, ruleset.number(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0) !=
      0) {
    fail("landlock_add_rule");
  }
}

bool is_folder(const Descriptor& path) {
  struct stat status {};
  return ::fstat(path.number(), &status) == 0 && S_ISDIR(status.st_mode);
}

Descriptor open_path(const std::filesystem::path& path) {
  return Descriptor(::open(path.c_str(), O_PATH | O_CLOEXEC));
}

/// All files but those in /dev, and there shared memory.
void allow_reading(const Descriptor& ruleset) {
  const auto allow_in = [&](const std::filesystem::path& path) {
    const Descriptor opened = open_path(path);
    if (opened.is_open()) allow(ruleset, opened, LANDLOCK_ACCESS_FS_READ_FILE);
  };
  for (const auto& entry : std::filesystem::directory_iterator("/")) {
    if (entry.path() != "/dev") allow_in(entry.path());
  }
  allow_in("/dev/shm");
}

void allow_harmless_devices(const Descriptor& ruleset, int version) {
  for (const char* device : kDevices) {
    const Descriptor path = open_path(device);
    if (path.is_open()) allow(ruleset, path, changes_of_files(version) | uses_of_devices(version));
  }
}

void allow_writing(const Descriptor& ruleset, std::span<const Descriptor> writable, int version) {
  for (const Descriptor& path : writable) {
    const auto changes = is_folder(path) ? all_changes(version) : changes_of_files(version);
    allow(ruleset, path, changes | LANDLOCK_ACCESS_FS_READ_FILE);
  }
}

}  // namespace

int landlock_version() {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 0) fail("Landlock");
  return static_cast<int>(version);
}

void restrict_files(std::span<const Descriptor> writable, int version) {
  const Descriptor ruleset = make_ruleset(version);
  allow_reading(ruleset);
  allow_harmless_devices(ruleset, version);
  allow_writing(ruleset, writable, version);
  if (::syscall(SYS_landlock_restrict_self, ruleset.number(), 0) != 0) {
    fail("landlock_restrict_self");
  }
}

}  // namespace stride::isolation
