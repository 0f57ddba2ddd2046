#include "master/system/scenario/idle_twins.h"

#include <map>
#include <string>

namespace stride::scenario {
namespace {

/// Each one again for the twin of its target, whose name `target` is a member of a declaration.
template <class Declaration>
void repeat_for_twins(std::vector<Declaration>& declarations, std::string Declaration::*target,
                      const std::map<std::string, std::string>& twins) {
  const std::size_t count = declarations.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto twin = twins.find(declarations[i].*target);
    if (twin == twins.end()) continue;
    Declaration repeated = declarations[i];
    repeated.*target = twin->second;
    declarations.push_back(std::move(repeated));
  }
}

}  // namespace

std::vector<IdleTwin> add_idle_twins(core::SystemDeclaration& system) {
  std::vector<IdleTwin> added;
  std::map<std::string, std::string> names;
  const std::size_t count = system.components.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!system.components[i].description->promises_idle) continue;
    core::ComponentDeclaration twin = system.components[i];
    twin.name += " (never suspended)";
    names.emplace(system.components[i].name, twin.name);
    added.push_back({i, system.components.size()});
    system.components.push_back(std::move(twin));
  }
  repeat_for_twins(system.connections, &core::ConnectionDeclaration::to_component, names);
  repeat_for_twins(system.start_values, &core::StartDeclaration::component, names);
  return added;
}

}  // namespace stride::scenario
