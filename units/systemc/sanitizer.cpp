#include "units/systemc/sanitizer.h"

#ifdef __SANITIZE_ADDRESS__

#include <cstddef>

#include <pthread.h>
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>

namespace stride::systemc {
namespace {

struct Stack {
  void* bottom = nullptr;
  std::size_t size = 0;

  Stack() {
    pthread_attr_t attributes;
    pthread_getattr_np(pthread_self(), &attributes);
    pthread_attr_getstack(&attributes, &bottom, &size);
    pthread_attr_destroy(&attributes);
  }
};

}  // namespace

void restore_stack_bounds() {
  static thread_local const Stack stack;
  __sanitizer_start_switch_fiber(nullptr, stack.bottom, stack.size);
  __sanitizer_finish_switch_fiber(nullptr, nullptr, nullptr);
  __asan_handle_no_return();
}

}  // namespace stride::systemc

#else

namespace stride::systemc {

void restore_stack_bounds() {}

}  // namespace stride::systemc

#endif
