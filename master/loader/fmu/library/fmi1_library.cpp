#include "master/loader/fmu/library/fmi1_library.h"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/loader/fmu/library/scalar_types.h"

namespace stride::importer {
namespace {

/// What Fmi1Unit may call for any unit. What depends on the description's variables, or is asked
/// only where a unit knows more, is not here.
constexpr std::string_view kFmi1Needed[] = {"InstantiateSlave", "InitializeSlave", "TerminateSlave",
                                            "FreeSlaveInstance", "DoStep"};

}  // namespace

Fmi1Library::Fmi1Library(const std::filesystem::path& path, const std::string& model_identifier,
                         core::Context user, const std::filesystem::path& shown_as)
    : SharedLibrary(path, std::move(user), shown_as) {
  // a library that is called otherwise than the model description has it is taken, too
  const std::string own_name = path.stem().string();
  prefix_ = (has(own_name + "_fmiDoStep") ? own_name : model_identifier) + "_fmi";
  std::vector<std::string> missing;
#define STRIDE_FIND(name)                                           \
  find(functions_.name, prefix_ + #name);                           \
  if (functions_.name == nullptr && contains(kFmi1Needed, #name)) { \
    missing.push_back(prefix_ + #name);                             \
  }
  FMI1_FUNCTIONS(STRIDE_FIND)
#undef STRIDE_FIND
  if (!missing.empty()) {
    SharedLibrary::fail_missing(missing, "which an FMI 1.0 Co-Simulation unit must");
  }
  const std::string types = functions_.GetTypesPlatform != nullptr
                                ? answer_of("question for the types", functions_.GetTypesPlatform)
                                : FMI1_TYPES_PLATFORM;
  if (types == FMI1_TYPES_PLATFORM) return;
  core::fail_input(
      SharedLibrary::user(),
      fmt::format("the library '{}' was compiled for the platform types '{}'; expected "
                  "'" FMI1_TYPES_PLATFORM "'",
                  SharedLibrary::shown_as(), types),
      "compile it with the fmiPlatformTypes.h of the standard");
}

void Fmi1Library::require_functions(const core::UnitDescription& unit) const {
  require_values(unit, prefix_, &scalar_type_word);
}

}  // namespace stride::importer
