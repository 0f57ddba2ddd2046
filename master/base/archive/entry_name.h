// The names of what an archive holds.
#ifndef STRIDE_MASTER_BASE_ARCHIVE_ENTRY_NAME_H
#define STRIDE_MASTER_BASE_ARCHIVE_ENTRY_NAME_H

#include <string>

namespace stride::archive {

/// The name of an entry in UTF-8. A zip archive marks names that are; the others are in the code
/// page of the machine that packed it: in UTF-8 if they can be, else in CP437, as the format has
/// it, or in Windows-1252, which has letters where CP437 has lines of frames. A name with '\\' and
/// without '/' is one of Windows, with folders.
std::string entry_name(std::string bytes);

}  // namespace stride::archive

#endif
