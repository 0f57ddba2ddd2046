#include "master/util/archive/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/util/error.h"

namespace stride::archive {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockSuffix = ".lock";

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  core::fail_run({}, fmt::format("cannot {} '{}': {}", what, path.string(), std::strerror(errno)),
                 "set TMPDIR to a folder that you may write to and that has room");
}

/// An open file with flock's lock on it, or -1 if `flags` has LOCK_NB and another process holds it.
int lock_file(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file < 0) fail(path, "open the lock file");
  while (::flock(file, LOCK_EX | flags) != 0) {
    if (errno == EINTR) continue;
    const bool busy = errno == EWOULDBLOCK;
    ::close(file);
    if (!busy) fail(path, "lock");
    return -1;
  }
  return file;
}

/// Held while folders are made and swept, so that none is swept whose lock is not taken yet.
class ParentLock {
 public:
  explicit ParentLock(const fs::path& parent) : file_(lock_file(parent / kLockSuffix, 0)) {}
  ~ParentLock() { ::close(file_); }
  ParentLock(const ParentLock&) = delete;
  ParentLock& operator=(const ParentLock&) = delete;

 private:
  int file_;
};

/// In a temporary folder that others write to, no other user may have put this one there.
void make_private(const fs::path& parent) {
  if (::mkdir(parent.c_str(), 0700) != 0 && errno != EEXIST) fail(parent, "make the folder");
  struct stat status {};
  if (::lstat(parent.c_str(), &status) != 0) fail(parent, "examine");
  const bool is_mine =
      S_ISDIR(status.st_mode) && status.st_uid == ::getuid() && (status.st_mode & 0022) == 0;
  if (is_mine) return;
  core::fail_run({}, fmt::format("'{}' is not a folder that belongs to you alone", parent.string()),
                 "remove it, or set TMPDIR to another folder");
}

void sweep(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
    const fs::path& lock = entry.path();
    if (lock.extension() != kLockSuffix) continue;
    const int file = lock_file(lock, LOCK_NB);
    if (file < 0) continue;
    fs::path folder = lock;
    fs::remove_all(folder.replace_extension(), ignored);
    fs::remove(lock, ignored);
    ::close(file);
  }
}

}  // namespace

fs::path TemporaryFolder::parent() {
  const char* chosen = std::getenv("TMPDIR");
  const fs::path base = chosen != nullptr && *chosen != '\0' ? chosen : "/tmp";
  return fs::absolute(base) / fmt::format("stride-{}", ::getuid());
}

TemporaryFolder::TemporaryFolder() : owner_(::getpid()) {
  const fs::path parent_folder = parent();
  make_private(parent_folder);
  const ParentLock parent_lock(parent_folder);
  sweep(parent_folder);
  std::string name = (parent_folder / "unpacked-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) fail(parent_folder, "make a folder in");
  path_ = name;
  lock_ = lock_file(name + kLockSuffix, 0);
}

void TemporaryFolder::sweep_abandoned() noexcept {
  try {
    const fs::path parent_folder = parent();
    if (!fs::exists(parent_folder)) return;
    make_private(parent_folder);
    const ParentLock parent_lock(parent_folder);
    sweep(parent_folder);
  } catch (const std::exception&) {  // the next run will try it again
  }
}

TemporaryFolder::~TemporaryFolder() {
  if (owner_ == ::getpid()) {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    fs::remove(path_.string() + kLockSuffix, ignored);
  }
  ::close(lock_);
}

}  // namespace stride::archive
