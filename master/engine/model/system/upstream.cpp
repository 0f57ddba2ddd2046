#include "master/engine/model/system/upstream.h"

#include <algorithm>

namespace stride::core {
namespace {

void add_once(std::vector<std::size_t>& components, std::size_t component) {
  if (std::ranges::find(components, component) == components.end()) components.push_back(component);
}

}  // namespace

std::vector<std::size_t> components_upstream(const System& system, VariableId id) {
  std::vector<std::size_t> found;
  if (system.is_output(id)) {
    const SystemOutput& output = system.outputs()[id.variable];
    if (!output.constant) found.push_back(output.from.component);
  } else if (system.variable(id).causality != Causality::Input) {
    found.push_back(id.component);
  } else {
    for (const Connection& connection : system.connections_to(id)) {
      add_once(found, connection.from.component);
    }
  }
  for (std::size_t next = 0; next < found.size(); ++next) {
    for (const Connection& connection : system.connections()) {
      if (connection.to.component == found[next]) add_once(found, connection.from.component);
    }
  }
  return found;
}

}  // namespace stride::core
