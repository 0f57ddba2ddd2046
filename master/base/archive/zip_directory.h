// The directory at the end of a zip archive.
#ifndef STRIDE_MASTER_BASE_ARCHIVE_ZIP_DIRECTORY_H
#define STRIDE_MASTER_BASE_ARCHIVE_ZIP_DIRECTORY_H

#include <cstdint>
#include <optional>

#include "master/base/files/descriptor.h"

namespace stride::archive {

/// The number of entries that the end of the central directory announces (APPNOTE.TXT 4.3.14 to
/// 4.3.16); nothing where there is none. The archive may hold others. The file must be a regular
/// one; its position does not change.
std::optional<std::uint64_t> announced_entries(const core::Descriptor& file);

}  // namespace stride::archive

#endif
