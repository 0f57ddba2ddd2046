#include "master/process/shared_note.h"

#include <algorithm>
#include <cstring>

#include <sys/mman.h>

#include "master/process/descriptor.h"

namespace stride::process {

SharedNote::SharedNote() {
  void* const memory =
      ::mmap(nullptr, sizeof(Memory), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) fail("mmap");
  memory_ = static_cast<Memory*>(memory);
}

SharedNote::~SharedNote() { ::munmap(memory_, sizeof(Memory)); }

void SharedNote::write(const char* what, std::int64_t picoseconds) {
  memory_->picoseconds = picoseconds;
  const std::size_t size = std::min(std::strlen(what), sizeof memory_->what - 1);
  std::memcpy(memory_->what, what, size);
  memory_->what[size] = '\0';
}

std::string SharedNote::what() const {
  return {memory_->what, ::strnlen(memory_->what, sizeof memory_->what)};
}

}  // namespace stride::process
