#include "master/loader/fmu/library/symbol_scope.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <set>
#include <string_view>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include "master/base/process/loaded_object.h"
#include "master/loader/fmu/library/python_library.h"

namespace stride::importer {
namespace {

struct Closer {
  void operator()(void* handle) const { ::dlclose(handle); }
};
using Handle = std::unique_ptr<void, Closer>;

/// A library that is in the process; empty for the program, with all that it is linked with.
Handle loaded(const char* name) { return Handle(::dlopen(name, RTLD_LAZY | RTLD_NOLOAD)); }

/// The name of its file, empty for the program.
std::string library_at(const void* address) {
  const link_map* const place = core::loaded_object_at(address);
  return place != nullptr ? std::filesystem::path(place->l_name).filename().string() : "";
}

/// Whether the program only jumps from here to the function: one that is not position-independent
/// has such addresses of functions that it takes from libraries.
bool is_jump_of_program(const void* address) {
  Dl_info info;
  void* symbol = nullptr;
  return ::dladdr1(address, &info, &symbol, RTLD_DL_SYMENT) != 0 && symbol != nullptr &&
         static_cast<const ElfW(Sym)*>(symbol)->st_shndx == SHN_UNDEF;
}

/// What this name stands for in the process; null if there is nothing of it.
const void* resolve(void* program, const char* name) {
  const void* const address = ::dlsym(program, name);
  if (address == nullptr || !is_jump_of_program(address)) return address;
  for (const link_map* at = core::loaded_object_at(address)->l_next; at != nullptr;
       at = at->l_next) {
    const Handle library = *at->l_name != '\0' ? loaded(at->l_name) : nullptr;
    const void* const found = library ? ::dlsym(library.get(), name) : nullptr;
    if (found != nullptr && core::loaded_object_at(found) == at) return found;
  }
  return address;
}

/// Names of the standard library's templates, with whatever they are made for: all have the same
/// code. After the prefixes of the C++ ABI for tables, static variables and members.
bool is_of_standard_templates(std::string_view name) {
  if (!name.starts_with("_Z")) return false;
  name.remove_prefix(2);
  for (const std::string_view prefix : {"TV", "TI", "TS", "TT", "GV", "GR", "Z"}) {
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  }
  name.remove_prefix(std::min(name.find_first_not_of("NKVrRO"), name.size()));
  constexpr std::array<std::string_view, 8> kSpaces{"St", "Sa", "Ss",         "Sb",
                                                    "Si", "So", "9__gnu_cxx", "10__cxxabiv1"};
  return std::ranges::any_of(kSpaces, [&](auto space) { return name.starts_with(space); });
}

/// What a linker adds to each library.
bool is_of_linker(std::string_view name) {
  constexpr std::array<std::string_view, 9> kNames{
      "_init", "_fini", "__bss_start", "_edata", "edata", "_end", "end", "_etext", "etext"};
  return std::ranges::count(kNames, name) > 0;
}

/// The operators new and delete for memory that is there: inline functions, all with the same code.
bool is_placement(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNames{"_ZnwmPv", "_ZnamPv", "_ZdlPvS_", "_ZdaPvS_"};
  return std::ranges::count(kNames, name) > 0;
}

/// Memory that one of them gives must go back to the same allocator, whoever has asked for it. With
/// the whole standard library of C++ in the unit nobody else asks by its operators.
bool is_of_allocator(std::string_view name, bool has_own_operators) {
  if (is_placement(name)) return false;
  constexpr std::array<std::string_view, 11> kNames{
      "malloc",  "calloc",         "realloc",           "free",
      "cfree",   "memalign",       "aligned_alloc",     "valloc",
      "pvalloc", "posix_memalign", "malloc_usable_size"};
  constexpr std::array<std::string_view, 4> kOperators{"_Znw", "_Zna", "_Zdl", "_Zda"};
  return std::ranges::count(kNames, name) > 0 ||
         (!has_own_operators &&
          std::ranges::any_of(kOperators, [&](auto begin) { return name.starts_with(begin); }));
}

/// Variables that a program may have copies of, all with one value: streams of C, tables of C++.
bool is_alike_in_copies(std::string_view name) {
  constexpr std::array<std::string_view, 4> kNames{"stdin", "stdout", "stderr",
                                                   "__libc_single_threaded"};
  constexpr std::array<std::string_view, 4> kTables{"_ZTV", "_ZTI", "_ZTS", "_ZTT"};
  return std::ranges::count(kNames, name) > 0 ||
         std::ranges::any_of(kTables, [&](auto begin) { return name.starts_with(begin); });
}

/// The first ones, and how many more there are.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 4;
  const std::size_t shown = std::min(names.size(), kMost);
  const auto end = std::next(names.begin(), static_cast<std::ptrdiff_t>(shown));
  std::string text = fmt::format("{}", fmt::join(names.begin(), end, ", "));
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

class Group {
 public:
  explicit Group(const UnitLibraries& libraries) {
    add(libraries.part, true);
    for (const NeededLibrary& other : libraries.needed) {
      if (other.is_loaded) {
        add_loaded(other);
      } else {
        add(other.part, false);
      }
    }
    for (const std::string& name : own_) outer_.erase(name);
    for (const std::string& name : bound_) outer_.erase(name);
  }

  /// Its own symbols that the loader would take from elsewhere, each with the library that has it.
  std::vector<std::string> contested() const {
    std::vector<std::string> found;
    for (const std::string& name : own_) {
      const void* const address = resolve(program_.get(), name.c_str());
      if (address == nullptr) continue;
      const std::string library = library_at(address);
      if (is_of_compiler(library) && !functions_.contains(name)) continue;
      found.push_back(fmt::format("'{}' ({})", name, library.empty() ? "the program" : library));
    }
    return found;
  }

  /// Empty if it defines none.
  std::string allocator_warning() const {
    if (allocator_.empty()) return "";
    return fmt::format(
        "the unit defines {} itself, and others of these names in this process are "
        "called: memory has to go back to the allocator that it is from",
        some_of({allocator_.begin(), allocator_.end()}));
  }

  /// What forbids that its own symbols come first: names that are replaced in this process for all
  /// code, or that it would replace for a part.
  std::vector<std::string> replaced() const {
    std::vector<std::string> found(allocator_.begin(), allocator_.end());
    for (const char* const name : {"__asan_init", "__tsan_init", "__msan_init", "__hwasan_init"}) {
      if (::dlsym(program_.get(), name) != nullptr) found.emplace_back(name);
    }
    for (const std::string& name : outer_) {
      if (is_replaced(name)) found.push_back(name);
    }
    return found;
  }

 private:
  void add(const DynamicPart& part, bool is_unit) {
    const bool has_own_operators = std::ranges::none_of(
        part.needed, [](const std::string& name) { return name.starts_with("libstdc++.so"); });
    for (const DynamicSymbol& symbol : part.symbols) {
      if (!symbol.is_defined) {
        outer_.insert(symbol.name);
      } else if (is_unit && part.binds_to_itself) {
        bound_.insert(symbol.name);
      } else if (is_of_allocator(symbol.name, has_own_operators)) {
        allocator_.insert(symbol.name);
      } else {
        add_own(symbol);
      }
    }
    for (const std::string& name : part.needed) {
      if (is_of_compiler(name)) add_neighbour(name);
    }
  }

  void add_own(const DynamicSymbol& symbol) {
    const std::string& name = symbol.name;
    if (is_of_standard_templates(name) || is_placement(name) || is_of_linker(name)) return;
    if (is_of_python(name)) {  // there is one Python in a process
      outer_.insert(name);
      return;
    }
    own_.insert(name);
    if (symbol.is_function) functions_.insert(name);
  }

  /// One that is there for others, too. It is the unit's own as well, unless all code in the
  /// process is bound to its symbols.
  void add_loaded(const NeededLibrary& library) {
    Handle handle = loaded(library.name.c_str());
    if (!handle) return;
    if (library.is_displaced() || is_for_all(handle.get(), library.part)) {
      neighbours_.push_back(std::move(handle));
    } else {
      add(library.part, false);
    }
  }

  /// Whether the program finds the library's symbols, of which others may have replaced a few.
  bool is_for_all(void* library, const DynamicPart& part) const {
    bool has_symbols = false;
    for (const DynamicSymbol& symbol : part.symbols) {
      const char* const name = symbol.name.c_str();
      const void* const own = symbol.is_defined ? ::dlsym(library, name) : nullptr;
      if (own == nullptr) continue;
      if (::dlsym(program_.get(), name) == own) return true;
      has_symbols = true;
    }
    return !has_symbols;
  }

  /// A library that is there for others, too.
  void add_neighbour(const std::string& name) {
    if (Handle handle = loaded(name.c_str())) neighbours_.push_back(std::move(handle));
  }

  bool is_replaced(const std::string& name) const {
    if (is_alike_in_copies(name) || is_of_standard_templates(name) || is_placement(name)) {
      return false;
    }
    const void* const address = resolve(program_.get(), name.c_str());
    if (address == nullptr) return false;
    for (const Handle& neighbour : neighbours_) {
      const void* const original = ::dlsym(neighbour.get(), name.c_str());
      if (original != nullptr) return original != address;
    }
    return false;
  }

  const Handle program_ = loaded(nullptr);
  std::set<std::string> own_, bound_, functions_, allocator_, outer_;
  std::vector<Handle> neighbours_;
};

std::set<std::string> unique_symbols(const DynamicPart& part) {
  std::set<std::string> names;
  for (const DynamicSymbol& symbol : part.symbols) {
    if (symbol.is_unique && !is_of_standard_templates(symbol.name)) names.insert(symbol.name);
  }
  return names;
}

}  // namespace

std::set<std::string> taken_unique_symbols(const UnitLibraries& libraries) {
  std::set<std::filesystem::path> own_files{libraries.file};
  std::set<std::string> own = unique_symbols(libraries.part);
  for (const NeededLibrary& library : libraries.needed) {
    if (library.bundled.empty()) continue;
    own_files.insert(library.bundled);
    own.merge(unique_symbols(library.part));
  }
  std::set<std::string> taken;
  if (own.empty()) return taken;
  for (const link_map* const object : core::loaded_objects()) {
    const std::filesystem::path file = *object->l_name == '\0' ? "/proc/self/exe" : object->l_name;
    if (own_files.contains(file) || is_of_compiler(file.filename().string())) continue;
    for (const DynamicSymbol& symbol : read_dynamic_part(file).symbols) {
      if (symbol.is_unique && own.contains(symbol.name)) taken.insert(symbol.name);
    }
  }
  return taken;
}

SymbolScope find_symbol_scope(const UnitLibraries& libraries) {
  const Group group(libraries);
  const std::vector<std::string> contested = group.contested();
  if (contested.empty()) return {0, group.allocator_warning()};
  const std::vector<std::string> replaced = group.replaced();
  if (replaced.empty()) return {RTLD_DEEPBIND, ""};
  return {0,
          fmt::format("the unit has symbols of its own that are replaced by others of the same "
                      "names in this process: {}; it cannot be bound to its own, since it would "
                      "lose what is replaced on purpose: {}; compile it with -fvisibility=hidden "
                      "or link it with -Bsymbolic",
                      some_of(contested), some_of(replaced))};
}

}  // namespace stride::importer
