// The file that code or a variable of this process has come from.
#ifndef STRIDE_MASTER_BASE_PROCESS_LOADED_OBJECT_H
#define STRIDE_MASTER_BASE_PROCESS_LOADED_OBJECT_H

#include <set>

struct link_map;

namespace stride::core {

/// The program or the library that the address is in, as the dynamic linker knows it: one of them,
/// one pointer. Null if it is in none. It looks no symbol up, unlike dladdr(), which for that reads
/// the table of all symbols.
const link_map* loaded_object_at(const void* address) noexcept;

/// The program and all its libraries, as they are loaded now.
std::set<const link_map*> loaded_objects();

}  // namespace stride::core

#endif
