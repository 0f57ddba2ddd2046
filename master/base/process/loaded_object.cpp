#include "master/base/process/loaded_object.h"

#include <dlfcn.h>
#include <link.h>

namespace stride::core {

const link_map* loaded_object_at(const void* address) noexcept {
  dl_find_object found{};
  const bool is_found = ::_dl_find_object(const_cast<void*>(address), &found) == 0;
  return is_found ? found.dlfo_link_map : nullptr;
}

std::set<const link_map*> loaded_objects() {
  std::set<const link_map*> objects;
  const auto add = [](dl_phdr_info* object, std::size_t, void* to) {
    for (int i = 0; i < object->dlpi_phnum; ++i) {
      const auto& part = object->dlpi_phdr[i];
      if (part.p_type != PT_LOAD) continue;
      const auto* const address = reinterpret_cast<const void*>(object->dlpi_addr + part.p_vaddr);
      static_cast<std::set<const link_map*>*>(to)->insert(loaded_object_at(address));
      break;
    }
    return 0;
  };
  ::dl_iterate_phdr(add, &objects);
  objects.erase(nullptr);
  return objects;
}

}  // namespace stride::core
