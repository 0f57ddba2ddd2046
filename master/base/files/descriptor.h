// Open files that close themselves.
#ifndef STRIDE_MASTER_BASE_FILES_DESCRIPTOR_H
#define STRIDE_MASTER_BASE_FILES_DESCRIPTOR_H

#include <cerrno>
#include <utility>

#include <unistd.h>

namespace stride::core {

/// A file descriptor, closed with the object. Where it is closed, errno stays what it is.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  /// Closes its own file first.
  Descriptor& operator=(Descriptor&& other) noexcept {
    if (this == &other) return *this;
    close();
    number_ = other.release();
    return *this;
  }

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  /// The file is no longer closed with this object.
  int release() { return std::exchange(number_, -1); }
  void close() {
    const int reason = errno;
    if (is_open()) ::close(release());
    errno = reason;
  }

 private:
  int number_;
};

}  // namespace stride::core

#endif
