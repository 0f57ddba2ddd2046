#include "master/base/child_process/descriptor.h"

#include <array>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace stride::isolation {

void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

Pipe::Pipe() {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) fail("pipe2");
  read = Descriptor(ends[0]);
  write = Descriptor(ends[1]);
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
}

void write_all(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

bool read_some(Descriptor& file, std::string& text) {
  if (!file.is_open()) return false;
  std::array<char, 65536> buffer;
  ssize_t size = 0;
  do {
    size = ::read(file.number(), buffer.data(), buffer.size());
  } while (size < 0 && errno == EINTR);
  if (size < 0 && errno == EAGAIN) return false;
  if (size <= 0) {
    file.close();
    return false;
  }
  text.append(buffer.data(), static_cast<std::size_t>(size));
  return true;
}

void drain(Descriptor& file, std::string& text) {
  while (read_some(file, text)) {
  }
}

}  // namespace stride::isolation
