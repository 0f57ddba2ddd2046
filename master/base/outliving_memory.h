#ifndef STRIDE_MASTER_BASE_OUTLIVING_MEMORY_H
#define STRIDE_MASTER_BASE_OUTLIVING_MEMORY_H

#include <cstddef>

namespace stride::core {

/// The memory of Outliving objects, which forked processes have in common.
class OutlivingMemory {
 public:
  /// Zeros. Throws std::bad_alloc.
  static void* add(std::size_t size);
  /// Whether there is some, and this process has not left it.
  static bool is_shared() noexcept;
  /// From here on this process sees zeros of its own there: what it does cannot reach the others.
  /// For processes whose code is not trusted. Ends the process if that fails.
  static void leave() noexcept;
};

}  // namespace stride::core

#endif
