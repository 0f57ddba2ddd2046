#include "master/isolation/process/shared_note.h"

#include <algorithm>
#include <cstring>

namespace stride::isolation {

void SharedNote::write(const char* what, std::int64_t picoseconds) {
  memory_->picoseconds = picoseconds;
  const std::size_t size = std::min(std::strlen(what), sizeof memory_->what - 1);
  std::memcpy(memory_->what, what, size);
  memory_->what[size] = '\0';
}

std::string SharedNote::what() const {
  return {memory_->what, ::strnlen(memory_->what, sizeof memory_->what)};
}

}  // namespace stride::isolation
