#include "master/base/child_process/open_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/child_process/descriptor.h"

namespace stride::isolation {
namespace {

std::string path_of(int file) {
  std::array<char, 4096> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = ::readlink(link.c_str(), path.data(), path.size());
  return {path.data(), size < 0 ? 0 : static_cast<std::size_t>(size)};
}

[[noreturn]] void fail_file(int file, const std::string& what) {
  throw std::runtime_error("the file '" + path_of(file) + "' " + what);
}

}  // namespace

OpenFiles::OpenFiles(std::vector<int> others) : others_(std::move(others)) {}

void OpenFiles::note() {
  files_.clear();
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(::opendir("/proc/self/fd"), &::closedir);
  if (!folder) fail("/proc/self/fd");
  while (const dirent* entry = ::readdir(folder.get())) {
    const char* const text = entry->d_name;
    int number = -1;
    std::from_chars(text, text + std::strlen(text), number);
    if (number < 0 || std::count(others_.begin(), others_.end(), number) != 0) continue;
    const off_t position = ::lseek(number, 0, SEEK_CUR);
    struct stat status {};
    if (position < 0 || ::fstat(number, &status) != 0 || !S_ISREG(status.st_mode)) continue;
    const bool is_written = (::fcntl(number, F_GETFL) & O_ACCMODE) != O_RDONLY;
    files_.push_back({number, position, status.st_size, is_written});
  }
}

void OpenFiles::set_back() const {
  for (const File& file : files_) {
    struct stat status {};
    if (::fstat(file.number, &status) != 0) fail("fstat");
    if (file.is_written && status.st_size < file.size) {
      fail_file(file.number, "has been cut off since, and its end is gone");
    }
    if (file.is_written && status.st_size > file.size && ::ftruncate(file.number, file.size) != 0) {
      fail_file(file.number, std::string("cannot be cut off: ") + std::strerror(errno));
    }
    if (::lseek(file.number, file.position, SEEK_SET) < 0) fail("lseek");
  }
}

}  // namespace stride::isolation
