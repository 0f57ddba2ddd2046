// Functions of units that are called when the process ends.
#include <cstdlib>

#include <dlfcn.h>

namespace stride::cli {
namespace {

using ExitFunction = void(int, void*);

/// Until the process ends: unlike atexit(), on_exit() does not belong to a library, which calls
/// what it has registered when it is unloaded.
void keep_library_of(ExitFunction* function) {
  Dl_info place{}, own{};
  if (::dladdr(reinterpret_cast<const void*>(function), &place) == 0 ||
      ::dladdr(reinterpret_cast<const void*>(&keep_library_of), &own) == 0 ||
      place.dli_fbase == own.dli_fbase) {
    return;
  }
  ::dlopen(place.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);  // as one more user of it
}

}  // namespace
}  // namespace stride::cli

// Exported, so that a unit which calls it reaches this.
extern "C" int on_exit(void (*function)(int, void*), void* argument) noexcept {
  using OnExit = int(stride::cli::ExitFunction*, void*);
  static auto* const original = reinterpret_cast<OnExit*>(::dlsym(RTLD_NEXT, "on_exit"));
  stride::cli::keep_library_of(function);
  return original == nullptr ? -1 : original(function, argument);
}
