#include "master/importer/fmi1/fmi1_library.h"

#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::importer {
namespace {

/// What is asked only where a unit knows more.
constexpr std::string_view kFmi1Optional[] = {"ResetSlave", "GetRealStatus", "GetTypesPlatform"};

}  // namespace

Fmi1Library::Fmi1Library(const std::filesystem::path& path, const std::string& model_identifier,
                         core::Context user, const std::filesystem::path& shown_as)
    : SharedLibrary(path, std::move(user), shown_as) {
  // a library that is called otherwise than the model description has it is taken, too
  const std::string own_name = path.stem().string();
  const std::string& prefix = has(own_name + "_fmiDoStep") ? own_name : model_identifier;
  std::vector<std::string> missing;
#define STRIDE_FIND(name)                                              \
  find(functions_.name, prefix + "_fmi" #name);                        \
  if (functions_.name == nullptr && !contains(kFmi1Optional, #name)) { \
    missing.push_back(prefix + "_fmi" #name);                          \
  }
  FMI1_FUNCTIONS(STRIDE_FIND)
#undef STRIDE_FIND
  if (!missing.empty()) {
    core::fail_input(
        SharedLibrary::user(),
        fmt::format("the library '{}' does not export {}, which an FMI 1.0 Co-Simulation unit must",
                    SharedLibrary::shown_as(), fmt::join(missing, ", ")),
        "export it with C linkage, default visibility and exactly this name");
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

}  // namespace stride::importer
