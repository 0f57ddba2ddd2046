// A unit's shared library, of whatever version of FMI.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_SHARED_LIBRARY_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_SHARED_LIBRARY_H

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "master/base/error.h"
#include "master/base/process/remnants.h"
#include "master/base/text/fixed_text.h"
#include "master/base/text/listed.h"
#include "master/engine/model/description.h"
#include "master/loader/fmu/library/needed_libraries.h"
#include "master/loader/fmu/library/private_copy.h"
#include "master/loader/fmu/library/status.h"
#include "master/loader/fmu/library/symbol_scope.h"

namespace stride::importer {

/// A loaded library; unloaded with the object, unless it is unusable, a library that it needs may
/// outlive it (LibraryUse), or something is left of it that goes on (core::Remnants), of which a
/// warning is printed. Then it stays until the process ends.
class SharedLibrary {
 public:
  /// Loads it with all its symbols resolved and kept to itself (RTLD_NOW, RTLD_LOCAL), and its own
  /// before those of the program (SymbolScope). Where a symbol of Python is missing, Python's
  /// library is loaded for it. A library that it needs, and that the loader does not find, is
  /// loaded from its own folder, or from the resources of its FMU, if it is there: see
  /// find_companion(). Throws core::Error of the kind Input that names the shared library or the
  /// symbol that is missing, and for a file that is cut off or damaged. `user` is the place that
  /// names the unit, and a component, if it is known; messages call the file `shown_as`, or by its
  /// path.
  explicit SharedLibrary(const std::filesystem::path& path, core::Context user = {},
                         const std::filesystem::path& shown_as = {});
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  /// From where it is loaded.
  const std::filesystem::path& path() const { return path_; }
  const std::string& shown_as() const { return shown_as_; }
  /// The place that names the unit, and the first component that uses it, if one is known.
  const core::Context& user() const { return user_; }
  /// To be called for each component that uses it, before its instance is made. The first one is
  /// named, and its log gets the warning.
  void add_user(const std::string& component, const LogSink& log) const;

  /// What its initialization has changed of the process (core::ProcessState). It is put back.
  const std::vector<std::string>& changes() const { return changes_; }
  /// The name of Python's library, if it was loaded for this one; else empty.
  const std::string& python() const { return python_; }

  /// Why symbols of its own are replaced by others, or that another library takes the place of one
  /// that it brings along: one warning for each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The names of libraries that it brings along, of which others are in the process: it has its
  /// own in a PrivateCopy.
  const std::vector<std::string>& namesakes() const { return namesakes_; }

  /// What comes before the names that its functions have by the standard; else empty.
  const std::string& prefix() const { return prefix_; }

  /// The paths of the libraries that were loaded for it from its own FMU.
  const std::vector<std::filesystem::path>& companions() const { return companions_; }

  /// To be called when an instance has returned the status Fatal: after it no function of any
  /// instance may be called (FMI 3.0, 2.2.4; FMI 2.0, 2.1.3). Holds for all objects of the same
  /// library, until the process ends.
  void mark_unusable() const { *is_unusable_ = true; }
  const std::atomic<bool>& is_unusable() const { return *is_unusable_; }

  /// Whether it may go; if not, its user's log gets the reason.
  bool can_be_unloaded() const noexcept;
  /// To be called when its last instance is gone, if it stays for others.
  void forget_user() const;

 protected:
  ~SharedLibrary();

  /// While it lives, this is the unfinished work. The code of the library may call fork() and
  /// return in both processes: then the new one ends with the object.
  class Work {
   public:
    Work(const char* what, const SharedLibrary& library) noexcept;
    ~Work();
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

   private:
    pid_t process_;
  };

  /// What a function of the library without arguments answers; empty for NULL.
  std::string answer_of(const char* what, const char* (*function)()) const;

  /// Finds functions that are named as in a static library, too, `model_identifier` and '_' before
  /// the name, if that holds for this one.
  void accept_prefix(const std::string& model_identifier, const std::string& function);

  /// Makes `function` that of this name, null if there is none.
  template <class Function>
  void find(Function*& function, const std::string& symbol) {
    function = reinterpret_cast<Function*>(address(symbol));
  }
  bool has(const std::string& symbol) const { return address(symbol) != nullptr; }

  /// Throws core::Error (Input) where a function is missing by which outputs are read or inputs
  /// set: those of a type are named by `prefix` + "Get" + its word. What is called for other
  /// variables is looked at when it is.
  void require_values(const core::UnitDescription& unit, const std::string& prefix,
                      const char* (*word_of)(core::ValueType)) const;
  /// Throws core::Error (Input), as all that miss functions do. `use`: ", which … must".
  [[noreturn]] void fail_missing(const std::vector<std::string>& missing, const std::string& use,
                                 const std::string& hint = "") const;

 private:
  struct Closer {
    void operator()(void* handle) const;
  };
  using Handle = std::unique_ptr<void, Closer>;
  UnitLibraries find_libraries();
  std::string load();
  std::string open();
  void* address(const std::string& symbol) const;

  std::filesystem::path path_;
  std::string shown_as_;
  mutable core::Context user_;
  mutable LogSink log_;  ///< of the user
  const core::Remnants remnants_;
  std::string prefix_;
  std::string python_;
  std::vector<std::string> changes_;
  std::vector<std::string> warnings_;
  std::vector<std::string> namesakes_;
  std::vector<std::filesystem::path> companions_;
  std::optional<PrivateCopy> copy_;
  std::vector<Handle> companion_handles_;
  Handle handle_;
  std::optional<LibraryUse> needed_;
  int binding_ = 0;  ///< SymbolScope::flags
  std::atomic<bool>* is_unusable_ = nullptr;
  const core::Listed<SharedLibrary> listed_{*this};
};

/// Code of a library that is being run outside of calls of its instances.
struct LibraryWork {
  static constexpr std::size_t kMostOutliving = 1;

  core::FixedText<32> what{};      ///< "loading", "unloading", …; empty if there is no such work
  core::FixedText<256> library{};  ///< as messages show it
  core::FixedText<128> unit{};     ///< whose library it is; empty if that is not known
  core::FixedText<256> file{};     ///< with `line`, the component's position in the scenario
  int line = 0;
};

/// The work that has not ended, if there is some. Can be called by a signal handler.
const LibraryWork& unfinished_library_work() noexcept;

/// Of the libraries that are loaded, the first one first: see SharedLibrary::user(). None may be
/// loaded or unloaded meanwhile. For errors that may be of any unit in this process.
std::vector<core::Context> library_users();

/// " ('a', 'b')", their components; empty if none is known.
std::string names_in_brackets(std::span<const core::Context> users);

/// A list of function names, for compile time.
template <std::size_t kSize>
constexpr bool contains(const std::string_view (&names)[kSize], std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

}  // namespace stride::importer

#endif
