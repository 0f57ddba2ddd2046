#include "master/base/archive/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/error.h"

namespace stride::archive {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockSuffix = ".lock";
constexpr const char* kPrefix = "unpacked-";

fs::path lock_of(const fs::path& folder) { return folder.string() + kLockSuffix; }

bool is_chosen() {
  const char* const chosen = std::getenv("TMPDIR");
  return chosen != nullptr && *chosen != '\0';
}

/// A mistake in TMPDIR is one of the input; a full disk is not.
[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  const int error = errno;
  const std::string message = fmt::format("{}cannot {} '{}': {}", is_chosen() ? "TMPDIR: " : "",
                                          what, path.string(), std::strerror(error));
  const char* const hint = "set TMPDIR to a folder that you may write to and that has room";
  if (core::is_shortage(error)) throw core::EnvironmentError({}, message, hint);
  core::fail_input({}, message, hint);
}

/// Whether the path still names this open file.
bool is_at(int file, const fs::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// The file, locked with flock; not open if another process has the lock, or the file is gone.
/// Nothing waits for a lock: whoever can read the file can take it, and keep it.
core::Descriptor try_lock(const fs::path& path) {
  core::Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
  if (!file.is_open()) return file;
  int result = 0;
  while ((result = ::flock(file.number(), LOCK_EX | LOCK_NB)) != 0 && errno == EINTR) {
  }
  if (result != 0 || !is_at(file.number(), path)) file.close();
  return file;
}

/// Lets the owner change what is in this folder and in those below; without that, a folder that a
/// unit has closed to itself could not be removed.
void open_to_owner(const fs::path& folder) {
  std::error_code ignored;
  fs::permissions(folder, fs::perms::owner_all, fs::perm_options::add, ignored);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (fs::is_directory(entry.symlink_status(ignored))) open_to_owner(entry.path());
  }
}

/// Returns whether it is gone. Without open files left to the process, it stays.
bool remove_folder(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (!error) return true;
  open_to_owner(folder);
  fs::remove_all(folder, error);
  return !error;
}

/// A folder whose lock is free is removed as long as there is the lock's file.
void remove_with_lock(const fs::path& folder) {
  std::error_code ignored;
  if (remove_folder(folder)) fs::remove(lock_of(folder), ignored);
}

/// In a temporary folder that others write to, no other user may have put this one there.
void make_private(const fs::path& parent) {
  if (::mkdir(parent.c_str(), 0700) != 0 && errno != EEXIST) fail(parent, "make the folder");
  struct stat status {};
  if (::lstat(parent.c_str(), &status) != 0) fail(parent, "examine");
  const bool is_mine =
      S_ISDIR(status.st_mode) && status.st_uid == ::getuid() && (status.st_mode & 0022) == 0;
  if (is_mine) return;
  core::fail_input({},
                   fmt::format("'{}' is not a folder that belongs to you alone", parent.string()),
                   "remove it, or set TMPDIR to another folder");
}

/// There is a lock's file before there is its folder, and after it.
bool has_lost_lock(const fs::path& folder) {
  std::error_code ignored;
  return folder.filename().string().starts_with(kPrefix) &&
         !fs::exists(fs::symlink_status(lock_of(folder), ignored));
}

void sweep(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored)) {
    fs::path path = entry.path();
    if (path.extension() != kLockSuffix) {
      if (has_lost_lock(path)) remove_folder(path);
      continue;
    }
    const core::Descriptor file = try_lock(path);
    if (file.is_open()) remove_with_lock(path.replace_extension());
  }
}

/// The lock file of a name that no folder has, made and locked; the name.
std::pair<core::Descriptor, fs::path> reserve_name(const fs::path& parent) {
  constexpr int kTries = 100;  // a sweep may remove the file before it is locked
  for (int i = 0; i < kTries; ++i) {
    std::string lock = lock_of(parent / fmt::format("{}XXXXXX", kPrefix));
    const int made =
        ::mkostemps(lock.data(), static_cast<int>(std::strlen(kLockSuffix)), O_CLOEXEC);
    if (made < 0) fail(parent, "make a file in");
    ::close(made);
    core::Descriptor file = try_lock(lock);
    if (file.is_open()) return {std::move(file), fs::path(lock).replace_extension()};
  }
  fail(parent, "lock a file in");
}

}  // namespace

fs::path TemporaryFolder::parent() {
  const fs::path base = is_chosen() ? std::getenv("TMPDIR") : "/tmp";
  return fs::absolute(base) / fmt::format("stride-{}", ::getuid());
}

TemporaryFolder::TemporaryFolder() : owner_(::getpid()) {
  const fs::path parent_folder = parent();
  make_private(parent_folder);
  sweep(parent_folder);
  std::tie(lock_, path_) = reserve_name(parent_folder);
  if (::mkdir(path_.c_str(), 0700) != 0) fail(path_, "make the folder");
}

void TemporaryFolder::sweep_abandoned() noexcept {
  try {
    const fs::path parent_folder = parent();
    if (std::error_code ignored; !fs::exists(parent_folder, ignored)) return;
    make_private(parent_folder);
    sweep(parent_folder);
  } catch (const std::exception&) {  // the next run will try it again
  }
}

TemporaryFolder::~TemporaryFolder() {
  if (owner_ == ::getpid()) remove();
}

void TemporaryFolder::remove_all(pid_t owner) noexcept {
  core::Listed<TemporaryFolder>::for_each([owner](const TemporaryFolder& folder) {
    if (folder.owner_ == owner) folder.remove();
  });
}

void TemporaryFolder::remove() const noexcept { remove_with_lock(path_); }

}  // namespace stride::archive
