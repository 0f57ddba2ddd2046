#include "master/engine/run/exchange/system_outputs.h"

#include <algorithm>

#include "master/engine/run/exchange/item_check.h"

namespace stride::core {

SystemOutputs::SystemOutputs(const System& system, std::span<const VariableId> observed)
    : system_(system) {
  for (const VariableId id : observed) {
    if (!system.is_output(id)) {
      sources_.push_back(id);
      continue;
    }
    const SystemOutput& output = system.outputs()[id.variable];
    if (output.constant) {
      constants_.emplace(id, *output.constant);
      continue;
    }
    sources_.push_back(output.from);
    outputs_.push_back({id, &output, ValueBlock(output.variable.type, output.variable.size)});
  }
}

void SystemOutputs::connect(Exchange& exchange) {
  first_values_ = &exchange.first_values();
  for (Output& output : outputs_) output.source = exchange.signal(output.output->from);
}

void SystemOutputs::update_all(Time time) {
  for (Output& output : outputs_) {
    const std::size_t first = output.source.first + output.output->from_first;
    const Conversion& conversion = output.output->conversion;
    copy_elements(output.block, 0, *output.source.block, first, output.block.size(), conversion);
    check_converted(system_, output.output->from, output.id, conversion,
                    {&output.block, 0, output.block.size()}, time, first_values_);
  }
}

Signal SystemOutputs::signal(VariableId id, Exchange& exchange) const {
  if (!system_.is_output(id)) return exchange.signal(id);
  if (const auto constant = constants_.find(id); constant != constants_.end()) {
    return {id, &constant->second, 0};
  }
  const auto found = std::ranges::lower_bound(outputs_, id, {}, &Output::id);
  return {id, &found->block, 0};
}

}  // namespace stride::core
