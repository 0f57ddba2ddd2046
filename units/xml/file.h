// The files that units read.
#ifndef STRIDE_UNITS_XML_FILE_H
#define STRIDE_UNITS_XML_FILE_H

#include <string>

namespace xml {

/// The content of a regular file of 256 MiB at most; a FIFO is not waited for, and no device is
/// opened. `expected`: what it should contain. Throws std::runtime_error "PATH: cannot be read:
/// expected EXPECTED (REASON)".
std::string read_file(const std::string& path, const std::string& expected);

/// For libraries that read a file by its name: throws likewise where it is no regular file.
void require_file(const std::string& path, const std::string& expected);

}  // namespace xml

#endif
