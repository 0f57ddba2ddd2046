#include "master/loader/fmu/library/shared_library.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <list>
#include <map>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "master/base/files/input_file.h"
#include "master/base/outliving.h"
#include "master/base/process/process_state.h"
#include "master/base/text/lower_case.h"
#include "master/loader/fmu/description/binaries.h"
#include "master/loader/fmu/library/companion.h"
#include "master/loader/fmu/library/library_file.h"
#include "master/loader/fmu/library/python_library.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// What is between two texts, or nothing.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t first = text.find(before);
  if (first == std::string_view::npos) return {};
  text.remove_prefix(first + before.size());
  return text.substr(0, text.find(after));
}

constexpr const char* kSymbolHint =
    "link the unit with the library that defines it (the linker option --no-undefined finds this "
    "when the unit is built)";
constexpr const char* kPythonHint =
    "the unit embeds Python and is not linked with its library, and the loader finds none: install "
    "it (Debian: libpython3-dev), or start stride with LD_PRELOAD=…/libpython3.x.so.1.0";

/// The symbol that the loader's message says is missing; empty if it is about something else.
std::string_view undefined_symbol(std::string_view reason) {
  const std::string_view symbol = between(reason, "undefined symbol: ", " ");
  return symbol.substr(0, symbol.find(','));
}

/// The package of Debian and its kin that has a shared library, by their rule for its name:
/// "libgfortran5" has "libgfortran.so.5".
std::string package_of(std::string_view library) {
  const std::size_t so = library.find(".so");
  std::string name = core::lower_case(std::string(library.substr(0, so)));
  std::replace(name.begin(), name.end(), '_', '-');
  const bool has_version = so != std::string_view::npos && library.size() > so + 4;
  if (!has_version || name.starts_with("libpython")) return name;
  const bool ends_in_digit = name.back() >= '0' && name.back() <= '9';
  return name + (ends_in_digit ? "-" : "") + std::string(library.substr(so + 4));
}

std::string hint_for(const std::string& reason) {
  const auto contains = [&](const char* words) { return reason.find(words) != std::string::npos; };
  if (contains("executable stack")) {
    return "this system allows none; if the unit does not need it, which is usual, clear the flag "
           "(patchelf --clear-execstack), or compile the unit with -z noexecstack";
  }
  if (contains("wrong ELF class")) return "it is not for as many bits as this program";
  return fmt::format("expected a shared library for {}", platform());
}

/// The library that the loader's message says is missing; empty if it is about something else, or
/// about `opened` itself.
std::string missing_library(const std::string& reason, const std::string& opened) {
  const std::size_t end = reason.find(": cannot open shared object file");
  if (end == std::string::npos) return "";
  const std::string missing = reason.substr(0, end);
  return missing == opened ? "" : missing;
}

/// It is there, and the loader takes it for no library, or not for the one that is needed.
[[noreturn]] void fail_with_companion(const SharedLibrary& library, const std::string& head,
                                      const std::string& missing, const fs::path& found) {
  const fs::path from_unit = found.lexically_relative(library.path().parent_path());
  const fs::path shown = fs::path(library.shown_as()).parent_path() / from_unit;
  const std::string damage = find_damage(found);
  core::fail_input(
      library.user(),
      fmt::format("{}it needs the shared library '{}', which is there, as '{}', {}", head, missing,
                  shown.lexically_normal().string(),
                  damage.empty() ? "and the loader does not take it" : "and damaged: " + damage),
      damage.empty()
          ? "let the unit's library name its folder (patchelf --set-rpath '$ORIGIN'), or name a "
            "folder that has it in LD_LIBRARY_PATH"
          : "get another copy of the unit, or export it again");
}

/// It is not where the loader looks, nor where units have the libraries that they bring along.
[[noreturn]] void fail_without_companion(const SharedLibrary& library, const std::string& head,
                                         const std::string& missing) {
  const std::vector<std::string> namesakes = find_namesakes(library.path(), missing);
  core::fail_input(
      library.user(),
      fmt::format("{}it needs the shared library '{}', which was not found{}", head, missing,
                  namesakes.empty() ? ""
                                    : fmt::format("; the FMU has a file of this name as {}",
                                                  core::quoted(namesakes))),
      namesakes.empty()
          ? fmt::format("install the package that provides it (on Debian and Ubuntu mostly '{}'), "
                        "put it beside the unit's library (pack --bundle), or name its folder in "
                        "LD_LIBRARY_PATH",
                        package_of(missing))
          : "put it beside the unit's library, if it is for this platform, or name its folder in "
            "LD_LIBRARY_PATH");
}

/// "FILE: version `GLIBCXX_3.4.32' not found (required by …)": the library is there, and too old.
[[noreturn]] void fail_for_version(const SharedLibrary& library, const std::string& head,
                                   const std::string& reason, const std::string& version) {
  const fs::path file = reason.substr(0, reason.find(": version `"));
  const std::string name = file.filename().string();
  const bool is_own = file.parent_path() == library.path().parent_path();
  const bool has_own = is_own || !find_namesakes(library.path(), name).empty();
  core::fail_input(
      library.user(),
      fmt::format("{}it needs '{}' of the library '{}', and {} does not have it", head, version,
                  name, is_own ? "the one in the FMU" : "this system's, '" + file.string() + "',"),
      is_own
          ? fmt::format("take '{}' out of the FMU, if this system's is newer, or put the one into "
                        "it that the unit was built with",
                        name)
          : fmt::format("the unit was built on a newer system than this one{}; build it here, or "
                        "run stride on such a system",
                        has_own ? fmt::format(", and the '{}' in its FMU is not used, since a "
                                              "process has one of them",
                                              name)
                                : ""));
}

/// The loader ends its message with what the system has said.
bool says_shortage(const std::string& reason) {
  return std::ranges::any_of(std::array{EMFILE, ENFILE, ENOMEM}, [&](int error) {
    return reason.ends_with(std::generic_category().message(error));
  });
}

/// Turns the loader's message (glibc's dlerror) into what is missing and how to get it.
[[noreturn]] void fail_to_load(const SharedLibrary& library, std::string reason) {
  const core::Context& context = library.user();
  const std::string path = library.path().string();
  const std::string head = fmt::format("the library '{}' cannot be loaded: ", library.shown_as());
  if (const std::string missing = missing_library(reason, path); !missing.empty()) {
    const fs::path found = find_companion(library.path(), missing);
    if (!found.empty()) fail_with_companion(library, head, missing, found);
    fail_without_companion(library, head, missing);
  }
  const std::string_view symbol = undefined_symbol(reason);
  if (!symbol.empty()) {
    core::fail_input(context,
                     fmt::format("{}it needs the symbol '{}', which no library that it is linked "
                                 "with has",
                                 head, symbol),
                     is_of_python(symbol) ? kPythonHint : kSymbolHint);
  }
  if (const auto version = between(reason, ": version `", "'"); !version.empty()) {
    fail_for_version(library, head, reason, std::string(version));
  }
  const std::string hint = hint_for(reason);
  const bool is_shortage = says_shortage(reason);
  if (reason.starts_with(path + ": ")) reason.erase(0, path.size() + 2);
  if (is_shortage) throw core::EnvironmentError(context, head + reason);
  core::fail_input(context, head + reason, hint);
}

std::atomic<const LibraryWork*> noted_work{nullptr};

/// Made when it is needed first, and so after the memory that outlives the process. Never
/// destroyed, since handlers of signals may look later.
LibraryWork& present_work() {
  static auto* const owner = new core::Outliving<LibraryWork>;
  static LibraryWork& work = **owner;
  noted_work = &work;
  return work;
}

/// One flag per library in the process: dlopen gives the same handle however often it is opened.
/// Kept as long as the process exists, as an unusable library is.
std::atomic<bool>& unusable_flag(void* handle) {
  static std::mutex mutex;
  static auto& flags = *new std::map<void*, std::atomic<bool>>;
  const std::lock_guard lock(mutex);
  return flags[handle];
}

}  // namespace

void SharedLibrary::Closer::operator()(void* handle) const { ::dlclose(handle); }

SharedLibrary::SharedLibrary(const fs::path& path, core::Context user, const fs::path& shown_as)
    : path_(fs::absolute(path)),
      shown_as_(shown_as.empty() ? path_.string() : shown_as.string()),
      user_(std::move(user)) {
  if (core::is_lfs_pointer(path_)) {
    core::fail_input(user_,
                     fmt::format("'{}' is {}, not the library", shown_as_, core::kLfsPointer),
                     core::kLfsHint);
  }
  if (const std::string damage = find_damage(path_); !damage.empty()) {
    core::fail_input(user_, fmt::format("the library '{}' cannot be loaded: {}", shown_as_, damage),
                     "get another copy of the unit, or export it again");
  }
  const UnitLibraries libraries = find_libraries();
  needed_.emplace(libraries);
  const SymbolScope scope = find_symbol_scope(libraries);
  if (!scope.warning.empty()) warnings_.push_back(scope.warning);
  binding_ = scope.flags;
  const core::ProcessState before;
  const std::string reason = load();
  changes_ = before.restore();
  if (!handle_) fail_to_load(*this, reason);
  is_unusable_ = &unusable_flag(handle_.get());
}

/// Of a private copy, from then on, where another library in the process has the name of one that
/// it brings along, or a symbol of which a process has one.
UnitLibraries SharedLibrary::find_libraries() {
  UnitLibraries libraries = read_libraries(path_);
  for (NeededLibrary& library : libraries.needed) {
    if (!library.is_displaced()) continue;
    if (is_python_library(library.name)) {
      warnings_.push_back(
          fmt::format("its library brings '{}' along, and '{}' takes its place: "
                      "there is one Python in a process",
                      library.name, library.file.string()));
      library.bundled.clear();
    } else {
      namesakes_.push_back(library.name);
    }
  }
  const std::set<std::string> taken = taken_unique_symbols(libraries);
  if (namesakes_.empty() && taken.empty()) return libraries;
  std::string failure;
  try {
    copy_.emplace(libraries, taken);
    path_ = copy_->library();
    return read_libraries(path_);
  } catch (const std::exception& error) {  // no room, no memory
    failure = error.what();
  }
  if (!namesakes_.empty()) {
    warnings_.push_back(
        fmt::format("its library brings {} along, and other libraries of such names are in this "
                    "process and take their places, since there can be no copy by another name: {}",
                    core::quoted(namesakes_), failure));
  }
  if (!taken.empty()) {
    warnings_.push_back(
        fmt::format("its library has {}, of which a process has one, and another library's takes "
                    "its place, since there can be no copy of its own: {}; compile it with "
                    "-fno-gnu-unique",
                    core::abridged(std::vector(taken.begin(), taken.end()), 3), failure));
  }
  namesakes_.clear();
  return libraries;
}

/// Returns the loader's message if the library cannot be loaded.
std::string SharedLibrary::load() {
  const Work work("loading", *this);
  std::string reason = open();
  if (!is_of_python(undefined_symbol(reason))) return reason;
  python_ = load_python();
  return python_.empty() ? reason : open();
}

/// Likewise. Libraries that it needs, and they in turn, are opened before it where they are missing
/// and in the FMU: the loader takes one of the name that is loaded already as if it had found it.
std::string SharedLibrary::open() {
  struct Wanted {
    fs::path path;
    std::string name;  ///< by which it is needed
  };
  std::list<LoaderName> names;
  for (std::vector<Wanted> wanted{{path_, path_}}; true;) {
    Handle handle(::dlopen(wanted.back().path.c_str(), RTLD_NOW | RTLD_LOCAL | binding_));
    if (!handle) {
      std::string reason = ::dlerror();
      const std::string missing = missing_library(reason, wanted.back().path);
      const fs::path found = missing.empty() ? fs::path() : find_companion(path_, missing);
      const bool is_tried = std::ranges::count(wanted, found, &Wanted::path) > 0 ||
                            std::ranges::count(companions_, found) > 0;
      if (found.empty() || is_tried || !find_damage(found).empty()) return reason;
      wanted.push_back({found, missing});
      continue;
    }
    const Wanted opened = wanted.back();
    wanted.pop_back();
    if (wanted.empty()) {
      handle_ = std::move(handle);
      return "";
    }
    companions_.push_back(opened.path);
    names.emplace_back(handle.get(), opened.name);
    companion_handles_.push_back(std::move(handle));
  }
}

SharedLibrary::~SharedLibrary() {
  if (!can_be_unloaded()) {
    static_cast<void>(handle_.release());
    return;
  }
  const Work work("unloading", *this);
  handle_.reset();
  companion_handles_.clear();
}

bool SharedLibrary::can_be_unloaded() const noexcept {
  if (is_unusable() || needed_->may_be_outlived()) return false;
  try {
    const std::string remnants = remnants_.find();
    if (remnants.empty()) return true;
    if (log_) {
      // an interpreter of Python lives as long as its process
      const Status severity = python_.empty() ? Status::Warning : Status::Ok;
      log_(user_.unit, severity, "stride",
           fmt::format("its library stays loaded until stride ends, because it leaves {} behind, "
                       "which may need its code; a unit has to end its threads, and restore the "
                       "handlers of signals, before its last instance is freed",
                       remnants));
      log_ = {};  // said once
    }
  } catch (const std::exception&) {  // then it is not known
  }
  return false;
}

void SharedLibrary::add_user(const std::string& component, const LogSink& log) const {
  if (log_) return;
  user_.unit = component;
  log_ = log;
}

void SharedLibrary::forget_user() const {
  user_ = {};
  log_ = {};
}

std::string SharedLibrary::answer_of(const char* what, const char* (*function)()) const {
  const Work work(what, *this);
  const char* const answer = function();
  return answer != nullptr ? answer : "";
}

SharedLibrary::Work::Work(const char* what, const SharedLibrary& library) noexcept
    : process_(::getpid()) {
  LibraryWork& work = present_work();
  work.library.set(library.shown_as());
  work.unit.set(library.user().unit);
  work.file.set(library.user().where.file);
  work.line = library.user().where.line;
  work.what.set(what);
}

SharedLibrary::Work::~Work() {
  if (::getpid() != process_) ::_exit(0);
  present_work().what.set("");
}

const LibraryWork& unfinished_library_work() noexcept {
  static constexpr LibraryWork kNone;
  const LibraryWork* const work = noted_work;
  return work == nullptr ? kNone : *work;
}

std::vector<core::Context> library_users() {
  std::vector<core::Context> users;
  core::Listed<SharedLibrary>::for_each([&](const SharedLibrary& library) {
    if (!library.user().unit.empty()) users.push_back(library.user());
  });
  std::ranges::reverse(users);
  return users;
}

std::string names_in_brackets(std::span<const core::Context> users) {
  std::vector<std::string> names;
  for (const core::Context& user : users) names.push_back(user.unit);
  return names.empty() ? "" : fmt::format(" ({})", core::quoted(names));
}

void SharedLibrary::require_values(const core::UnitDescription& unit, const std::string& prefix,
                                   const char* (*word_of)(core::ValueType)) const {
  std::set<std::string> needed;
  for (const core::Variable& variable : unit.variables) {
    const std::string word = word_of(variable.type);
    if (variable.causality == core::Causality::Output) needed.insert(prefix + "Get" + word);
    if (variable.causality == core::Causality::Input) needed.insert(prefix + "Set" + word);
  }
  std::erase_if(needed, [&](const std::string& symbol) { return has(symbol); });
  if (needed.empty()) return;
  fail_missing({needed.begin(), needed.end()}, "by which its outputs are read and its inputs set");
}

void SharedLibrary::fail_missing(const std::vector<std::string>& missing, const std::string& use,
                                 const std::string& hint) const {
  core::fail_input(
      user_,
      fmt::format("the library '{}' does not export {}, {}", shown_as_, fmt::join(missing, ", "),
                  use),
      hint.empty() ? "export it with C linkage, default visibility and exactly this name" : hint);
}

void SharedLibrary::accept_prefix(const std::string& model_identifier,
                                  const std::string& function) {
  const std::string prefix = model_identifier + "_";
  if (!has(function) && has(prefix + function)) prefix_ = prefix;
}

void* SharedLibrary::address(const std::string& symbol) const {
  void* const found = ::dlsym(handle_.get(), symbol.c_str());
  if (found != nullptr || prefix_.empty()) return found;
  return ::dlsym(handle_.get(), (prefix_ + symbol).c_str());
}

}  // namespace stride::importer
