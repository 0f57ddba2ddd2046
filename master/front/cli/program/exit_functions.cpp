// Functions of units that are called when the process ends.
#include <cstdlib>

#include <dlfcn.h>
#include <link.h>

#include "master/base/process/loaded_object.h"

namespace stride::cli {
namespace {

using ExitFunction = void(int, void*);

/// Until the process ends: unlike atexit(), on_exit() does not belong to a library, which calls
/// what it has registered when it is unloaded.
void keep_library_of(ExitFunction* function) {
  const link_map* const place = core::loaded_object_at(reinterpret_cast<const void*>(function));
  const auto* const self = reinterpret_cast<const void*>(&keep_library_of);
  if (place == nullptr || place == core::loaded_object_at(self)) return;
  ::dlopen(place->l_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);  // as one more user of it
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
