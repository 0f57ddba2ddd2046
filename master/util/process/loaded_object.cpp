#include "master/util/process/loaded_object.h"

#include <dlfcn.h>

namespace stride::core {

const link_map* loaded_object_at(const void* address) noexcept {
  dl_find_object found{};
  const bool is_found = ::_dl_find_object(const_cast<void*>(address), &found) == 0;
  return is_found ? found.dlfo_link_map : nullptr;
}

}  // namespace stride::core
