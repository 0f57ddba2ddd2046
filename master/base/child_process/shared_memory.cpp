#include "master/base/child_process/shared_memory.h"

#include <cerrno>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace stride::isolation {
namespace {

void* map_shared(int file, std::size_t size) {
  const int flags = MAP_SHARED | (file < 0 ? MAP_ANONYMOUS : 0);
  void* const data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, flags, file, 0);
  if (data == MAP_FAILED) fail("mmap");
  return data;
}

/// [byte]
std::size_t available_memory() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name;) {
    std::size_t kibibytes = 0;
    if (name == "MemAvailable:" && file >> kibibytes) return kibibytes * 1024;
  }
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES) / 4 * ::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void fail_with(int error) {
  errno = error;
  fail("no shared memory");
}

/// What is grown by.
constexpr std::size_t kPiece = std::size_t{1} << 16;

}  // namespace

SharedMemory::SharedMemory(std::size_t size) : size_(size), data_(map_shared(-1, size)) {}

SharedMemory::~SharedMemory() { ::munmap(data_, size_); }

void SharedMemory::hide_from_children() { ::madvise(data_, size_, MADV_DONTFORK); }

GrowingMemory::GrowingMemory(const char* name, std::size_t size)
    : file_(::memfd_create(name, MFD_CLOEXEC | MFD_ALLOW_SEALING)) {
  if (!file_.is_open()) fail("memfd_create");
  ::fcntl(file_.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL);
  grow(size);
}

GrowingMemory::~GrowingMemory() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

void GrowingMemory::grow(std::size_t size) {
  if (size <= size_) return;
  // the kernel would go on until it has killed everybody else
  if (size - size_ > available_memory()) fail_with(ENOMEM);
  const std::size_t more = (size + kPiece - 1) / kPiece * kPiece;
  // not ftruncate: memory that is lacking is an error here, and not a SIGBUS later
  int error = 0;
  do {
    error = ::posix_fallocate(file_.number(), 0, static_cast<off_t>(more));
  } while (error == EINTR);
  if (error != 0) fail_with(error);
  map(more);
}

bool GrowingMemory::follow(std::size_t size) {
  if (size <= size_) return true;
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) fail("fstat");
  const auto there = static_cast<std::size_t>(status.st_size);
  // a file with holes may seem to be of any size
  const auto allocated = static_cast<std::size_t>(status.st_blocks) * 512;
  if (there < size || allocated < there) return false;
  map(there);
  return true;
}

void GrowingMemory::map(std::size_t size) {
  std::byte* const before = data_;
  data_ = static_cast<std::byte*>(map_shared(file_.number(), size));
  if (before != nullptr) ::munmap(before, size_);
  size_ = size;
  if (is_hidden_) hide_from_children();
}

void GrowingMemory::hide_from_children() {
  is_hidden_ = true;
  ::madvise(data_, size_, MADV_DONTFORK);
}

}  // namespace stride::isolation
