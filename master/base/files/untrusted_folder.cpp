#include "master/base/files/untrusted_folder.h"

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/error.h"

namespace stride::core {
namespace {

namespace fs = std::filesystem;

constexpr int kSearch = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

bool is_plain(const fs::path& part) { return !part.empty() && part != "." && part != ".."; }

/// Part by part, since openat2() is missing before Linux 5.6 and in some containers. A FIFO does
/// not block.
Descriptor open_below(const Descriptor& folder, const fs::path& file) {
  constexpr int kFolder = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  constexpr int kFile = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
  errno = EINVAL;
  Descriptor within;
  for (auto part = file.begin(), next = part; part != file.end(); part = next) {
    const int parent = part == file.begin() ? folder.number() : within.number();
    const bool is_last = ++next == file.end();
    if (!is_plain(*part)) return Descriptor();
    within = Descriptor(::openat(parent, part->c_str(), is_last ? kFile : kFolder));
    if (!within.is_open()) break;
  }
  return within;
}

/// Removes what is neither a folder nor a regular file.
class Cleaner {
 public:
  explicit Cleaner(fs::path path) : path_(std::move(path)) {}

  /// Closes the folder.
  void clean(int folder) {
    const std::unique_ptr<DIR, int (*)(DIR*)> entries(::fdopendir(folder), &::closedir);
    if (!entries) fail("search this folder");
    while (const dirent* entry = ::readdir(entries.get())) {
      const std::string_view name = entry->d_name;
      if (name != "." && name != "..") clean(folder, entry->d_name);
    }
  }

 private:
  void clean(int folder, const char* name) {
    path_ /= name;
    struct stat status {};
    if (::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) != 0) fail("examine this file");
    if (S_ISDIR(status.st_mode)) {
      clean(open(folder, name));
    } else if (!S_ISREG(status.st_mode)) {
      remove(folder, name);
    }
    path_ = path_.parent_path();
  }

  /// What the folder's owner has denied to itself is granted again.
  int open(int folder, const char* name) const {
    int found = ::openat(folder, name, kSearch);
    if (found < 0 && errno == EACCES) {
      ::fchmodat(folder, name, S_IRWXU, AT_SYMLINK_NOFOLLOW);
      found = ::openat(folder, name, kSearch);
    }
    if (found < 0) fail("search this folder");
    return found;
  }

  void remove(int folder, const char* name) const {
    if (::unlinkat(folder, name, 0) == 0) return;
    if (errno == EACCES && ::fchmod(folder, S_IRWXU) == 0 && ::unlinkat(folder, name, 0) == 0) {
      return;
    }
    fail("remove this link or special file");
  }

  [[noreturn]] void fail(const char* what) const {
    fail_input({.where = {path_.string(), 0}},
               fmt::format("cannot {}, which an earlier run has left: {}", what,
                           std::generic_category().message(errno)),
               "remove it, or choose another results folder");
  }

  fs::path path_;
};

}  // namespace

UntrustedFolder::UntrustedFolder(fs::path path)
    : path_(std::move(path)), folder_(::open(path_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {}

FileStream UntrustedFolder::open(const fs::path& file) const {
  FileStream none(nullptr, &std::fclose);
  errno = ENOENT;
  if (!folder_.is_open()) return none;
  Descriptor opened = open_below(folder_, file);
  if (!opened.is_open()) return none;
  struct stat status {};
  if (::fstat(opened.number(), &status) != 0) return none;
  errno = EINVAL;
  if (!S_ISREG(status.st_mode)) return none;
  FileStream stream(::fdopen(opened.number(), "rb"), &std::fclose);
  if (stream) opened.release();
  return stream;
}

std::optional<std::uintmax_t> UntrustedFolder::size(const fs::path& file) const {
  const FileStream stream = open(file);
  struct stat status {};
  if (!stream || ::fstat(::fileno(stream.get()), &status) != 0) return std::nullopt;
  return static_cast<std::uintmax_t>(status.st_size);
}

std::optional<std::string> UntrustedFolder::read(const fs::path& file, std::size_t most) const {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  const FileStream stream = open(file);
  if (!stream) return std::nullopt;
  std::string content;
  std::size_t count = 0;
  do {  // it may grow meanwhile
    if (content.size() > most) return std::nullopt;
    const std::size_t begin = content.size();
    content.resize(begin + kPiece);
    count = std::fread(content.data() + begin, 1, kPiece, stream.get());
    content.resize(begin + count);
  } while (count > 0);
  if (std::ferror(stream.get()) != 0) return std::nullopt;
  return content;
}

void UntrustedFolder::remove_special_files() const {
  if (!folder_.is_open()) return;
  const int folder = ::openat(folder_.number(), ".", kSearch);
  if (folder >= 0) return Cleaner(path_).clean(folder);
  fail_input({.where = {path_.string(), 0}},
             fmt::format("cannot search the folder: {}", std::generic_category().message(errno)));
}

}  // namespace stride::core
