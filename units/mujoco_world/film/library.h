// A shared library that is loaded at run time.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_LIBRARY_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_LIBRARY_H

#include <initializer_list>
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace mujoco_world::film {

/// Stays loaded until the process ends: graphics libraries may crash when they are unloaded.
class Library {
 public:
  /// The first one that can be loaded; throws std::runtime_error with the reason of the first.
  Library(std::initializer_list<const char*> names) {
    std::string reason;
    for (const char* name : names) {
      handle_ = ::dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
      if (handle_ != nullptr) return;
      if (reason.empty()) reason = ::dlerror();
    }
    throw std::runtime_error(reason);
  }

  /// Points `function` at the symbol; throws std::runtime_error if there is none.
  template <class Function>
  void find(const char* symbol, Function*& function) const {
    function = reinterpret_cast<Function*>(::dlsym(handle_, symbol));
    if (function == nullptr) throw std::runtime_error(::dlerror());
  }

 private:
  void* handle_ = nullptr;
};

}  // namespace mujoco_world::film

#endif
