#include <memory>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/text/counted.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

struct Closer {
  void operator()(void* library) const { ::dlclose(library); }
};
using Handle = std::unique_ptr<void, Closer>;

/// The functions that the unit's declarations call for, without "fmi3".
std::vector<std::string> declared_functions(const core::UnitDescription& unit) {
  const bool is_fmi2 = unit.fmi_version.starts_with("2");
  std::vector<std::string> names{"Reset"};
  const auto add = [&](bool is_declared, std::vector<std::string> of_fmi3,
                       std::vector<std::string> of_fmi2) {
    if (!is_declared) return;
    const auto& more = is_fmi2 ? of_fmi2 : of_fmi3;
    names.insert(names.end(), more.begin(), more.end());
  };
  add(unit.can_save_state, {"GetFMUState", "SetFMUState", "FreeFMUState"},
      {"GetFMUstate", "SetFMUstate", "FreeFMUstate"});
  add(unit.can_serialize_state,
      {"SerializedFMUStateSize", "SerializeFMUState", "DeserializeFMUState"},
      {"SerializedFMUstateSize", "SerializeFMUstate", "DeSerializeFMUstate"});
  add(unit.max_output_derivative_order > 0, {"GetOutputDerivatives"}, {"GetRealOutputDerivatives"});
  bool has_fractions = false;
  bool has_decimals = false;
  for (const core::Variable& variable : unit.variables) {
    if (!variable.is_time_based_clock() || variable.clock->interval) continue;
    (variable.clock->supports_fraction ? has_fractions : has_decimals) = true;
  }
  add(has_fractions, {"GetIntervalFraction"}, {});
  add(has_decimals, {"GetIntervalDecimal"}, {});
  return names;
}

std::string version_of(const Trial& trial, void* library) {
  const std::string name = trial.tested.symbol("GetVersion");
  using GetVersion = const char*();
  auto* const get = reinterpret_cast<GetVersion*>(::dlsym(library, name.c_str()));
  if (get == nullptr) throw Failure(fmt::format("the library does not export {}", name));
  trial.note.write(name.c_str());
  const char* const version = get();
  trial.note.clear();
  return version != nullptr ? version : "";
}

/// A whole run of an instance with its own copy of the description, so that the library is unloaded
/// at the end.
void load_and_unload(const Trial& trial, const std::filesystem::path& folder) {
  trial.in_child([&] {
    {
      trial.note.write("the loading of its library");
      const auto fmu = importer::Fmu::load(folder);
      const auto unit = fmu->instantiate("unit");
      trial.note.write("the unloading of its library");
    }
    trial.note.clear();
    return std::string();
  });
}

}  // namespace

Finding check_load(const Trial& trial) {
  const core::UnitDescription& description = trial.tested.description();
  load_and_unload(trial, trial.tested.fmu().folder());
  trial.note.write("the loading of its library");
  const auto library = trial.tested.fmu().load_library();
  const Handle handle(::dlopen(library->path().c_str(), RTLD_NOW | RTLD_LOCAL));
  trial.note.clear();
  std::vector<std::string> missing;
  const std::vector<std::string> names = declared_functions(description);
  for (const std::string& name : names) {
    const std::string function = trial.tested.symbol(name);
    if (::dlsym(handle.get(), function.c_str()) == nullptr) missing.push_back(function);
  }
  if (!missing.empty()) {
    return failed(
        fmt::format("the library does not export {}, which the model description "
                    "declares",
                    fmt::join(missing, ", ")));
  }
  const std::string version = version_of(trial, handle.get());
  if (version.substr(0, 2) != description.fmi_version.substr(0, 2)) {
    return failed(fmt::format("{} returns '{}', but the model description is of fmiVersion '{}'",
                              trial.tested.function("GetVersion"), version,
                              description.fmi_version));
  }
  return passed(fmt::format("FMI {}, {}, {}", version,
                            core::counted(description.variables.size(), "variable"),
                            library->path().filename().string()),
                description.warnings);
}

}  // namespace stride::verify
