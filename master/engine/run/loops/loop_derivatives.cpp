#include "master/engine/run/loops/loop_derivatives.h"

#include <algorithm>
#include <set>

namespace stride::core {
bool LoopDerivatives::exist(const System& system, const EvaluationBlock& loop) {
  const auto is_real_one = [&](VariableId id) { return is_real(system.variable(id).type); };
  return std::ranges::all_of(loop.inputs, is_real_one) &&
         std::ranges::all_of(loop.groups, [&](const OutputGroup& group) {
           return system.components()[group.component]
                      .description->provides_directional_derivatives &&
                  std::ranges::all_of(group.outputs, is_real_one);
         });
}

LoopDerivatives::LoopDerivatives(const System& system, std::span<const std::unique_ptr<Unit>> units,
                                 const EvaluationBlock& loop)
    : system_(system), units_(units), loop_(loop) {
  lay_out_inputs();
  for (const OutputGroup& group : loop.groups) add_derivatives(group);
  add_carried();
}

/// The inputs are sorted, so those of one component are adjacent.
void LoopDerivatives::lay_out_inputs() {
  for (const VariableId id : loop_.inputs) {
    input_offsets_[id] = inputs_.size();
    inputs_.resize(inputs_.size() + system_.variable(id).size);
  }
}

void LoopDerivatives::add_derivatives(const OutputGroup& group) {
  auto& unit = units_[group.component]->require_capability<DirectionalDerivatives>();
  UnitDerivatives derivatives{group.component, &unit, {}, {}, outputs_.size(), 0,
                              inputs_.size(),  0};
  for (const VariableId id : group.outputs) {
    derivatives.unknowns.push_back(system_.variable(id).reference);
    output_offsets_[id] = outputs_.size();
    outputs_.resize(outputs_.size() + system_.variable(id).size);
  }
  derivatives.outputs = outputs_.size() - derivatives.first_output;
  for (const auto& [id, offset] : input_offsets_) {
    if (id.component != group.component) continue;
    derivatives.knowns.push_back(system_.variable(id).reference);
    derivatives.first_input = std::min(derivatives.first_input, offset);
    derivatives.inputs += system_.variable(id).size;
  }
  derivatives_.push_back(std::move(derivatives));
}

/// Tearing variables keep their values within a sweep.
void LoopDerivatives::add_carried() {
  std::set<ElementRange> torn;
  for (const TearingVariable& variable : loop_.tearing_variables)
    torn.insert(variable.inputs.begin(), variable.inputs.end());
  for (std::size_t i = 0; i < loop_.groups.size(); ++i) {
    for (const Connection& connection : system_.connections()) {
      const auto to = input_offsets_.find(connection.to);
      const bool begins_here = std::ranges::binary_search(loop_.groups[i].outputs, connection.from);
      if (!begins_here || to == input_offsets_.end() || torn.contains(connection.target()))
        continue;
      carried_.push_back({i, output_offsets_.at(connection.from) + connection.from_first,
                          to->second + connection.to_first, connection.size,
                          connection.conversion.linear.factor});
    }
  }
}

void LoopDerivatives::derive(std::size_t variable, std::size_t element, std::span<double> column) {
  std::ranges::fill(inputs_, 0.0);
  for (const ElementRange& input : loop_.tearing_variables[variable].inputs) {
    inputs_[input_offsets_.at(input.id) + input.first + element] = 1;
  }
  auto carried = carried_.begin();
  for (std::size_t i = 0; i < derivatives_.size(); ++i) {
    const UnitDerivatives& derivatives = derivatives_[i];
    derivatives.unit->get_directional_derivative(
        derivatives.unknowns, derivatives.knowns,
        std::span(inputs_).subspan(derivatives.first_input, derivatives.inputs),
        std::span(outputs_).subspan(derivatives.first_output, derivatives.outputs));
    for (; carried != carried_.end() && carried->group == i; ++carried) {
      for (std::size_t k = 0; k < carried->size; ++k) {
        inputs_[carried->to + k] = carried->factor * outputs_[carried->from + k];
      }
    }
  }
  std::size_t row = 0;
  for (const TearingVariable& back : loop_.tearing_variables) {
    const std::size_t from = output_offsets_.at(back.source.id) + back.source.first;
    for (std::size_t k = 0; k < back.source.size; ++k) {
      column[row++] = back.conversion.linear.factor * outputs_[from + k];
    }
  }
}

}  // namespace stride::core
