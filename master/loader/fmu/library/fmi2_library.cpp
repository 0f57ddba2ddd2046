#include "master/loader/fmu/library/fmi2_library.h"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/loader/fmu/library/scalar_types.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

/// What Fmi2Unit may call for any Co-Simulation unit. What depends on the description's capability
/// flags or variables, or is asked only where a unit knows more, is not here.
constexpr std::string_view kFmi2Needed[] = {
    "Instantiate",
    "FreeInstance",
    "SetupExperiment",
    "EnterInitializationMode",
    "ExitInitializationMode",
    "Terminate",
    "DoStep",
};

constexpr std::size_t kFmi2NeededFound = 0
#define STRIDE_COUNT(name) +(contains(kFmi2Needed, #name) ? 1 : 0)
    FMI2_FUNCTIONS(STRIDE_COUNT)
#undef STRIDE_COUNT
    ;
static_assert(kFmi2NeededFound == std::size(kFmi2Needed),
              "a name in kFmi2Needed is misspelt or there twice");

}  // namespace

std::span<const std::string_view> fmi2_needed_functions() { return kFmi2Needed; }

Fmi2Library::Fmi2Library(const fs::path& path, const std::string& model_identifier,
                         core::Context user, const fs::path& shown_as)
    : SharedLibrary(path, std::move(user), shown_as) {
  accept_prefix(model_identifier, "fmi2DoStep");
  std::vector<std::string> missing;
#define STRIDE_FIND(name)                                           \
  find(functions_.name, "fmi2" #name);                              \
  if (functions_.name == nullptr && contains(kFmi2Needed, #name)) { \
    missing.emplace_back("fmi2" #name);                             \
  }
  FMI2_FUNCTIONS(STRIDE_FIND)
#undef STRIDE_FIND
  if (!missing.empty()) {
    SharedLibrary::fail_missing(missing, "which an FMI 2.0 Co-Simulation unit must");
  }
  const std::string types = functions_.GetTypesPlatform != nullptr
                                ? answer_of("question for the types", functions_.GetTypesPlatform)
                                : FMI2_TYPES_PLATFORM;
  if (types == FMI2_TYPES_PLATFORM) return;
  core::fail_input(
      SharedLibrary::user(),
      fmt::format("the library '{}' was compiled for the platform types '{}'; expected "
                  "'" FMI2_TYPES_PLATFORM "'",
                  SharedLibrary::shown_as(), types),
      "compile it with the fmi2TypesPlatform.h of the standard");
}

void Fmi2Library::require_functions(const core::UnitDescription& unit) const {
  require_values(unit, "fmi2", &scalar_type_word);
}

}  // namespace stride::importer
