// Whose symbols a unit's library is bound to.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_SYMBOL_SCOPE_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_SYMBOL_SCOPE_H

#include <set>
#include <string>

#include "master/loader/fmu/library/needed_libraries.h"

namespace stride::importer {

/// How the loader is to bind the symbols of a library. It looks them up in the program and in all
/// libraries that the program is linked with, before it looks in the library itself: its own
/// crc32() would be that of zlib.
struct SymbolScope {
  /// For dlopen(): RTLD_DEEPBIND, by which the library and those that it brings along come first,
  /// or 0, where nothing in the process has a symbol of theirs.
  int flags = 0;
  /// Why their own symbols are replaced all the same; else empty.
  std::string warning;
};

/// RTLD_DEEPBIND is not possible where something in the process replaces functions that the library
/// takes from elsewhere, as sanitizers replace malloc(): it would get the original ones.
SymbolScope find_symbol_scope(const UnitLibraries& libraries);

/// Those of its symbols that exist once per process and are in it already, of another library: it
/// would get that one's, whatever is in it. Without those of the standard library.
std::set<std::string> taken_unique_symbols(const UnitLibraries& libraries);

}  // namespace stride::importer

#endif
