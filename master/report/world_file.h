// Whether the file of a world in 3D can be shown.
#ifndef STRIDE_MASTER_REPORT_WORLD_FILE_H
#define STRIDE_MASTER_REPORT_WORLD_FILE_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace stride::report {

/// A world may have so many bytes.
inline constexpr std::size_t kLargestWorld = std::size_t{64} << 20;

/// What is wrong with a binary glTF 2.0 file of `size` bytes that is to hold all its data, in
/// words: it is cut off or too large, refers to what it does not have or to other files, or its
/// nodes are no trees. Empty if nothing is. What cannot be read counts as missing.
std::string mistake_in_world(std::FILE* file, std::uintmax_t size);

}  // namespace stride::report

#endif
