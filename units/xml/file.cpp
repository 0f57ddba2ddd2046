#include "units/xml/file.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace xml {
namespace {

using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail(const std::string& path, const std::string& expected,
                       const std::string& reason) {
  throw std::runtime_error(path + ": cannot be read: expected " + expected + " (" + reason + ")");
}

std::string last_error() { return std::generic_category().message(errno); }

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "it is a folder";
  return S_ISFIFO(mode) ? "it is a FIFO" : "it is not a regular file";
}

Stream open(const std::string& path, const std::string& expected) {
  require_file(path, expected);
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) fail(path, expected, last_error());
  Stream stream(::fdopen(descriptor, "rb"), &std::fclose);
  if (stream) return stream;
  ::close(descriptor);
  fail(path, expected, "there is not enough memory");
}

}  // namespace

std::string read_file(const std::string& path, const std::string& expected) {
  constexpr std::size_t kMost = std::size_t{256} << 20;
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  const Stream stream = open(path, expected);
  std::string content;
  std::size_t count = 0;
  do {
    if (content.size() > kMost) fail(path, expected, "it has more than 256 MiB");
    const std::size_t begin = content.size();
    content.resize(begin + kPiece);
    count = std::fread(content.data() + begin, 1, kPiece, stream.get());
    content.resize(begin + count);
  } while (count > 0);
  if (std::ferror(stream.get()) != 0) fail(path, expected, last_error());
  return content;
}

void require_file(const std::string& path, const std::string& expected) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) fail(path, expected, last_error());
  if (!S_ISREG(status.st_mode)) fail(path, expected, kind_of(status.st_mode));
}

}  // namespace xml
