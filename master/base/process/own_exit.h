// Whose exit() calls the functions that are registered for it.
#ifndef STRIDE_MASTER_BASE_PROCESS_OWN_EXIT_H
#define STRIDE_MASTER_BASE_PROCESS_OWN_EXIT_H

#include <cstdlib>

namespace stride::core {

/// Tells the exit() of this program from another one that a function registered by other code
/// calls, be it with the same code: that one calls the rest of the functions from further down the
/// stack, or on another thread.
class OwnExit {
 public:
  /// To be called right before exit(), or the end of main().
  static void begin() { ::on_exit(note_frame, nullptr); }
  /// In a function registered with on_exit(), whose __builtin_frame_address(0) this is.
  static bool is_caller_of(const void* frame) { return frame == frame_; }

 private:
  /// No lambda, whose pointer calls its body one frame further down in an unoptimized build.
  static void note_frame(int, void*) { frame_ = __builtin_frame_address(0); }

  static inline const void* frame_ = nullptr;
};

}  // namespace stride::core

#endif
