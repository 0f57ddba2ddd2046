#include "master/engine/run/start_values.h"

#include <algorithm>
#include <span>

#include "master/engine/port/capabilities/configuration_mode.h"

namespace stride::core {
namespace {

/// FMI sets an array as a whole. Before the initialisation, the unit has its own start values.
void set(RunContext& context, const StartValue& start) {
  Unit& unit = *context.units[start.id.component];
  const Variable& variable = context.system.variable(start.id);
  if (start.kept.empty()) return unit.set({&variable.reference, 1}, start.value);
  ValueBlock own(variable.type, variable.size);
  unit.get({&variable.reference, 1}, own);
  unit.set({&variable.reference, 1}, start.over(own));
}

}  // namespace

void configure(RunContext& context) {
  const std::span<const StartValue> all = context.system.structural_values();
  for (auto first = all.begin(); first != all.end();) {
    auto& configuration =
        context.units[first->id.component]->require_capability<ConfigurationMode>();
    const auto last = std::find_if(first, all.end(), [&](const StartValue& value) {
      return value.id.component != first->id.component;
    });
    configuration.enter_configuration_mode();
    std::for_each(first, last, [&](const StartValue& value) { set(context, value); });
    configuration.exit_configuration_mode();
    first = last;
  }
}

void set_start_values(RunContext& context) {
  for (const StartValue& start : context.system.start_values()) set(context, start);
}

}  // namespace stride::core
