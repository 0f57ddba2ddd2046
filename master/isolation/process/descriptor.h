// Open files that close themselves.
#ifndef STRIDE_MASTER_ISOLATION_PROCESS_DESCRIPTOR_H
#define STRIDE_MASTER_ISOLATION_PROCESS_DESCRIPTOR_H

#include <cstddef>
#include <string>
#include <utility>

namespace stride::isolation {

/// Throws std::system_error of errno: "what: No such file or directory".
[[noreturn]] void fail(const char* what);

/// A file descriptor, closed with the object.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  /// Closes its own file first.
  Descriptor& operator=(Descriptor&& other) noexcept;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close();

 private:
  int number_;
};

/// Closed at an exec; reading does not wait. Throws std::system_error if there can be none.
struct Pipe {
  Pipe();
  Descriptor read, write;
};

/// Writes everything, or as much as is read.
void write_all(int file, const char* data, std::size_t size);

/// Appends what there is to read now, 64 KiB at most; closes the file at its end. Returns whether
/// there was something.
bool read_some(Descriptor& file, std::string& text);
/// Likewise without a limit; not for a writer that may never end.
void drain(Descriptor& file, std::string& text);

}  // namespace stride::isolation

#endif
