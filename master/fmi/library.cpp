#include "master/fmi/library.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#if defined(__x86_64__)
#define STRIDE_ARCHITECTURE "x86_64"
#elif defined(__aarch64__)
#define STRIDE_ARCHITECTURE "aarch64"
#elif defined(__i386__)
#define STRIDE_ARCHITECTURE "x86"
#else
#error "FMI 3.0 platform tuple: add the name of this architecture (FMI 3.0, 2.5.1.1)"
#endif
#if !defined(__linux__)
#error "FMI 3.0 platform tuple: add the name of this operating system (FMI 3.0, 2.5.1.1)"
#endif

namespace stride::fmi {
namespace {

namespace fs = std::filesystem;

/// What Fmi3Unit may call for any Co-Simulation unit. What depends on a capability flag of the
/// description, and what belongs to another interface type, is not here.
constexpr std::string_view kNeeded[] = {
    "GetVersion",    "InstantiateCoSimulation",
    "FreeInstance",  "EnterInitializationMode",
    "DoStep",        "ExitInitializationMode",
    "Terminate",     "EnterEventMode",
    "EnterStepMode", "UpdateDiscreteStates",
    "GetFloat32",    "SetFloat32",
    "GetFloat64",    "SetFloat64",
    "GetInt8",       "SetInt8",
    "GetUInt8",      "SetUInt8",
    "GetInt16",      "SetInt16",
    "GetUInt16",     "SetUInt16",
    "GetInt32",      "SetInt32",
    "GetUInt32",     "SetUInt32",
    "GetInt64",      "SetInt64",
    "GetUInt64",     "SetUInt64",
    "GetBoolean",    "SetBoolean",
    "GetString",     "SetString",
    "GetBinary",     "SetBinary",
    "GetClock",      "SetClock",
};

constexpr bool is_needed(std::string_view name) {
  return std::find(std::begin(kNeeded), std::end(kNeeded), name) != std::end(kNeeded);
}

constexpr std::size_t kNeededFound = 0
#define STRIDE_COUNT(name) +(is_needed(#name) ? 1 : 0)
    FMI3_FUNCTIONS(STRIDE_COUNT)
#undef STRIDE_COUNT
    ;
static_assert(kNeededFound == std::size(kNeeded), "a name in kNeeded is misspelt or there twice");

std::vector<std::string> folder_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// What stands between two texts, or nothing.
std::string_view between(std::string_view text, std::string_view before, std::string_view after) {
  const std::size_t first = text.find(before);
  if (first == std::string_view::npos) return {};
  text.remove_prefix(first + before.size());
  return text.substr(0, text.find(after));
}

/// Turns the loader's message (glibc's dlerror) into what is missing and how to get it.
[[noreturn]] void fail_to_load(const fs::path& path, const std::string& reason,
                               const core::Location& where) {
  const core::Context context{.where = where};
  const std::string head = fmt::format("the library '{}' cannot be loaded: ", path.string());
  constexpr std::string_view kNotFound = ": cannot open shared object file";
  const std::string missing = reason.substr(0, reason.find(kNotFound));
  if (missing.size() != reason.size() && missing != path.string()) {
    core::fail_input(
        context,
        fmt::format("{}it needs the shared library '{}', which was not found", head, missing),
        "install the package that provides it, put it beside the unit's library "
        "(pack --bundle), or name its folder in LD_LIBRARY_PATH");
  }
  const std::string_view symbol = between(reason, "undefined symbol: ", " ");
  if (!symbol.empty()) {
    core::fail_input(context,
                     fmt::format("{}it needs the symbol '{}', which no library that it is linked "
                                 "with has",
                                 head, symbol.substr(0, symbol.find(','))),
                     "link the unit with the library that defines it (the linker option "
                     "--no-undefined finds this when the unit is built)");
  }
  core::fail_input(context, head + reason,
                   fmt::format("expected a shared library for {}", platform()));
}

/// One flag per library in the process: dlopen gives the same handle however often it is opened.
/// Lives as long as the process, since a condemned library does.
std::atomic<bool>& condemned_flag(void* handle) {
  static std::mutex mutex;
  static auto& flags = *new std::map<void*, std::atomic<bool>>;
  const std::lock_guard lock(mutex);
  return flags[handle];
}

}  // namespace

const char* platform() { return STRIDE_ARCHITECTURE "-linux"; }

fs::path find_library(const fs::path& fmu_folder, const std::string& model_identifier,
                      const core::Location& where) {
  const fs::path binaries = fmu_folder / "binaries";
  const fs::path folder = binaries / platform();
  if (!fs::is_directory(folder)) {
    const auto others = folder_names(binaries);
    core::fail_input(
        {.where = where, .unit = model_identifier},
        fmt::format("the FMU has no binaries for {}; it has {}", platform(),
                    others.empty() ? "none at all" : fmt::format("{}", fmt::join(others, ", "))),
        others.empty() ? "a source-code FMU must be compiled before it can be used"
                       : "export the unit for this platform");
  }
  const fs::path library = folder / (model_identifier + ".so");
  if (fs::is_regular_file(library)) return library;
  core::fail_input(
      {.where = where, .unit = model_identifier},
      fmt::format("the FMU's library 'binaries/{}/{}.so' is missing", platform(), model_identifier),
      "its name must be the modelIdentifier of the model description");
}

void Library::Closer::operator()(void* handle) const { ::dlclose(handle); }

Library::Library(const fs::path& path, const core::Location& where) : path_(fs::absolute(path)) {
  handle_.reset(::dlopen(path_.c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!handle_) fail_to_load(path_, ::dlerror(), where);
  is_condemned_ = &condemned_flag(handle_.get());
  const auto resolve = [&]<class F>(F*& function, const char* symbol) {
    function = reinterpret_cast<F*>(::dlsym(handle_.get(), symbol));
    return function != nullptr;
  };
  std::vector<std::string> missing;
#define STRIDE_RESOLVE(name)                                         \
  if (!resolve(functions_.name, "fmi3" #name) && is_needed(#name)) { \
    missing.emplace_back("fmi3" #name);                              \
  }
  FMI3_FUNCTIONS(STRIDE_RESOLVE)
#undef STRIDE_RESOLVE
#define STRIDE_RESOLVE(name) resolve(idle_functions_.name, "stride" #name);
  STRIDE_IDLE_FUNCTIONS(STRIDE_RESOLVE)
#undef STRIDE_RESOLVE
  resolve(self_description_, "strideModelDescription");
  resolve(idle_manifest_, "strideIdleManifest");
  if (missing.empty()) return;
  core::fail_input({.where = where},
                   fmt::format("the library '{}' does not export {}, which an FMI 3.0 "
                               "Co-Simulation unit must",
                               path_.string(), fmt::join(missing, ", ")),
                   "export it with C linkage, default visibility and exactly this name");
}

Library::~Library() {
  if (is_condemned()) static_cast<void>(handle_.release());
}

std::string Library::describe(const fs::path& resources, const core::Location& where) const {
  if (!describes_itself()) {
    core::fail_input(
        {.where = where},
        fmt::format("the library '{}' does not know its own model description", path_.string()),
        "only libraries made with stride's unit kit do; give an FMU that has a "
        "modelDescription.xml instead");
  }
  return ask(self_description_, resources, where);
}

std::string Library::idle_manifest(const fs::path& resources, const core::Location& where) const {
  return idle_manifest_ != nullptr ? ask(idle_manifest_, resources, where) : std::string();
}

std::string Library::ask(strideModelDescriptionTYPE* function, const fs::path& resources,
                         const core::Location& where) const {
  const std::string folder = resource_path(resources);
  const char* error = nullptr;
  const char* text = function(folder.empty() ? nullptr : folder.c_str(), &error);
  if (text != nullptr) return text;
  core::fail_input({.where = where},
                   fmt::format("the unit in '{}' cannot describe itself: {}", path_.string(),
                               error != nullptr ? error : "it gives no reason"));
}

void Library::require_idle_functions(const core::Location& where) const {
  std::vector<std::string> missing;
#define STRIDE_CHECK(name) \
  if (idle_functions_.name == nullptr) missing.emplace_back("stride" #name);
  STRIDE_IDLE_FUNCTIONS(STRIDE_CHECK)
#undef STRIDE_CHECK
  if (missing.empty()) return;
  core::fail_input(
      {.where = where},
      fmt::format("the library '{}' does not export {}, which a unit with a manifest of {} must",
                  path_.string(), fmt::join(missing, ", "), STRIDE_IDLE_NAME),
      "export it with C linkage and default visibility (<stride/idle.h>), or leave the manifest "
      "'" STRIDE_IDLE_MANIFEST "' out of the FMU");
}

std::string resource_path(const fs::path& resources) {
  if (resources.empty()) return "";
  const fs::path folder = fs::absolute(resources / "").lexically_normal();
  return fs::is_directory(folder) ? folder.string() : "";
}

}  // namespace stride::fmi
