// Pipes, and what is read from and written to open files.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_DESCRIPTOR_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_DESCRIPTOR_H

#include <cstddef>
#include <string>

#include "master/base/files/descriptor.h"

namespace stride::isolation {

/// Throws std::system_error of errno: "what: No such file or directory".
[[noreturn]] void fail(const char* what);

using core::Descriptor;

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
