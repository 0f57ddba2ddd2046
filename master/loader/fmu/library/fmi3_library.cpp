#include "master/loader/fmu/library/fmi3_library.h"

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/files/input_file.h"
#include "master/base/process/process_state.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// What Fmi3Unit may call for any Co-Simulation unit. What depends on the description's capability
/// flags or variables, and what belongs to another interface type, is not here.
constexpr std::string_view kFmi3Needed[] = {
    "GetVersion",
    "InstantiateCoSimulation",
    "FreeInstance",
    "EnterInitializationMode",
    "ExitInitializationMode",
    "DoStep",
    "Terminate",
};

/// FMI has no functions of its own for Enumerations.
const char* fmi3_type_word(core::ValueType type) {
  return core::name(type == core::ValueType::Enumeration ? core::ValueType::Int64 : type);
}

constexpr std::size_t kFmi3NeededFound = 0
#define STRIDE_COUNT(name) +(contains(kFmi3Needed, #name) ? 1 : 0)
    FMI3_FUNCTIONS(STRIDE_COUNT)
#undef STRIDE_COUNT
    ;
static_assert(kFmi3NeededFound == std::size(kFmi3Needed),
              "a name in kFmi3Needed is misspelt or there twice");

}  // namespace

std::span<const std::string_view> fmi3_needed_functions() { return kFmi3Needed; }

Fmi3Library::Fmi3Library(const fs::path& path, const std::string& model_identifier,
                         core::Context user, const fs::path& shown_as)
    : SharedLibrary(path, std::move(user), shown_as) {
  if (!model_identifier.empty()) accept_prefix(model_identifier, "fmi3DoStep");
  std::vector<std::string> missing;
#define STRIDE_FIND(name)                                           \
  find(functions_.name, "fmi3" #name);                              \
  if (functions_.name == nullptr && contains(kFmi3Needed, #name)) { \
    missing.emplace_back("fmi3" #name);                             \
  }
  FMI3_FUNCTIONS(STRIDE_FIND)
#undef STRIDE_FIND
#define STRIDE_FIND(name) find(idle_functions_.name, "stride" #name);
  STRIDE_IDLE_FUNCTIONS(STRIDE_FIND)
#undef STRIDE_FIND
#define STRIDE_FIND(name) find(describe_functions_.name, "stride" #name);
  STRIDE_DESCRIBE_FUNCTIONS(STRIDE_FIND)
#undef STRIDE_FIND
  find(self_description_, "strideModelDescription");
  find(idle_manifest_, "strideIdleManifest");
  if (missing.empty()) return;
  SharedLibrary::fail_missing(missing, "which an FMI 3.0 Co-Simulation unit must");
}

void Fmi3Library::require_functions(const core::UnitDescription& unit) const {
  require_values(unit, "fmi3", &fmi3_type_word);
  if (!unit.has_event_mode) return;
  std::vector<std::string> missing;
  for (const char* function :
       {"fmi3EnterEventMode", "fmi3EnterStepMode", "fmi3UpdateDiscreteStates"}) {
    if (!has(function)) missing.emplace_back(function);
  }
  if (missing.empty()) return;
  SharedLibrary::fail_missing(missing, "which a unit with Event Mode (hasEventMode) must");
}

std::string Fmi3Library::describe(const fs::path& resources, const core::Location& where) const {
  if (!describes_itself()) {
    core::fail_input(
        {.where = where}, fmt::format("the library '{}' contains no model description", shown_as()),
        "only libraries made with stride's unit kit contain one; give an FMU that has a "
        "modelDescription.xml instead");
  }
  return text_from(self_description_, resources, where);
}

std::string Fmi3Library::idle_manifest(const fs::path& resources,
                                       const core::Location& where) const {
  return idle_manifest_ != nullptr ? text_from(idle_manifest_, resources, where) : std::string();
}

std::string Fmi3Library::text_from(strideModelDescriptionTYPE* function, const fs::path& resources,
                                   const core::Location& where) const {
  struct Answer {
    std::optional<std::string> text;
    std::string error;
  };
  const std::string folder = resource_path(resources);
  const core::ProcessState before;
  const Answer answer = [&] {
    const Work work("self-description", *this);  // with the reading of its texts
    const char* error = nullptr;
    const char* const text = function(folder.empty() ? nullptr : folder.c_str(), &error);
    return Answer{text != nullptr ? std::optional<std::string>(text) : std::nullopt,
                  error != nullptr ? error : "it gives no reason"};
  }();
  before.restore();
  if (answer.text) return *answer.text;
  core::fail_input({.where = where},
                   fmt::format("the unit in '{}' cannot describe itself: {}",
                               path().filename().string(),  // it may be unpacked somewhere
                               answer.error));
}

void Fmi3Library::require_idle_functions(const core::Location& where) const {
  std::vector<std::string> missing;
#define STRIDE_CHECK(name) \
  if (idle_functions_.name == nullptr) missing.emplace_back("stride" #name);
  STRIDE_IDLE_FUNCTIONS(STRIDE_CHECK)
#undef STRIDE_CHECK
  if (missing.empty()) return;
  core::fail_input(
      {.where = where},
      fmt::format("the library '{}' does not export {}, which a unit with a manifest of {} must",
                  shown_as(), fmt::join(missing, ", "), STRIDE_IDLE_NAME),
      "export it with C linkage and default visibility (<stride/idle.h>), or leave the manifest "
      "'" STRIDE_IDLE_MANIFEST "' out of the FMU");
}

std::string resource_path(const fs::path& resources) {
  if (resources.empty()) return "";
  const fs::path folder = fs::absolute(resources / "").lexically_normal();
  return core::is_folder(folder) ? folder.string() : "";
}

}  // namespace stride::importer
