// Room for the files of a process's end, when code of units has opened too many.
#ifndef STRIDE_MASTER_BASE_PROCESS_SPARE_FILES_H
#define STRIDE_MASTER_BASE_PROCESS_SPARE_FILES_H

#include <array>

#include "master/base/files/descriptor.h"
#include "master/base/text/listed.h"

namespace stride::core {

/// Holds open files without a content, so that as many can be opened when they are released, though
/// a unit has opened all that the process may. Where there are none, it holds fewer.
class SpareFiles {
 public:
  SpareFiles();
  SpareFiles(const SpareFiles&) = delete;
  SpareFiles& operator=(const SpareFiles&) = delete;

  /// Releases those of all objects. To be called when no unit is called any longer.
  static void release_all() noexcept;

 private:
  /// As many as the results and the removal of nested folders need at a time, and some more.
  static constexpr std::size_t kCount = 32;

  std::array<Descriptor, kCount> files_;
  Listed<SpareFiles> listed_{*this};
};

}  // namespace stride::core

#endif
