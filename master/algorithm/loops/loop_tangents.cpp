#include "master/algorithm/loops/loop_tangents.h"

#include <algorithm>
#include <set>

namespace stride::core {
bool LoopTangents::exist(const System& system, const EvaluationBlock& loop) {
  const auto is_real_one = [&](VariableId id) { return is_real(system.variable(id).type); };
  return std::ranges::all_of(loop.inputs, is_real_one) &&
         std::ranges::all_of(loop.steps, [&](const EvaluationStep& step) {
           return system.components()[step.component]
                      .description->provides_directional_derivatives &&
                  std::ranges::all_of(step.outputs, is_real_one);
         });
}

LoopTangents::LoopTangents(const System& system, std::span<const std::unique_ptr<Unit>> units,
                           const EvaluationBlock& loop)
    : system_(system), units_(units), loop_(loop) {
  place_inputs();
  for (const EvaluationStep& step : loop.steps) add_stage(step);
  add_wires();
}

/// They are sorted, so those of a component stand in a row.
void LoopTangents::place_inputs() {
  for (const VariableId id : loop_.inputs) {
    input_places_[id] = inputs_.size();
    inputs_.resize(inputs_.size() + system_.variable(id).size);
  }
}

void LoopTangents::add_stage(const EvaluationStep& step) {
  auto& derivatives = units_[step.component]->require_capability<DirectionalDerivatives>();
  Stage stage{step.component, &derivatives, {}, {}, outputs_.size(), 0, inputs_.size(), 0};
  for (const VariableId id : step.outputs) {
    stage.unknowns.push_back(system_.variable(id).reference);
    output_places_[id] = outputs_.size();
    outputs_.resize(outputs_.size() + system_.variable(id).size);
  }
  stage.outputs = outputs_.size() - stage.first_output;
  for (const auto& [id, place] : input_places_) {
    if (id.component != step.component) continue;
    stage.knowns.push_back(system_.variable(id).reference);
    stage.first_input = std::min(stage.first_input, place);
    stage.inputs += system_.variable(id).size;
  }
  stages_.push_back(std::move(stage));
}

/// Those at which the loop is cut are not carried on within a sweep.
void LoopTangents::add_wires() {
  std::set<VariableId> cut;
  for (const Tear& tear : loop_.tears) cut.insert(tear.inputs.begin(), tear.inputs.end());
  for (std::size_t i = 0; i < loop_.steps.size(); ++i) {
    for (const Connection& connection : system_.connections()) {
      const auto to = input_places_.find(connection.to);
      const bool begins_here = std::ranges::binary_search(loop_.steps[i].outputs, connection.from);
      if (!begins_here || to == input_places_.end() || cut.contains(connection.to)) continue;
      wires_.push_back({i, output_places_.at(connection.from), to->second,
                        system_.variable(connection.to).size, connection.conversion.linear.factor});
    }
  }
}

void LoopTangents::derive(std::size_t tear, std::size_t element, std::span<double> column) {
  std::ranges::fill(inputs_, 0.0);
  for (const VariableId id : loop_.tears[tear].inputs) {
    inputs_[input_places_.at(id) + element] = 1;
  }
  auto wire = wires_.begin();
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    const Stage& stage = stages_[i];
    stage.derivatives->get_directional_derivative(
        stage.unknowns, stage.knowns, std::span(inputs_).subspan(stage.first_input, stage.inputs),
        std::span(outputs_).subspan(stage.first_output, stage.outputs));
    for (; wire != wires_.end() && wire->stage == i; ++wire) {
      for (std::size_t k = 0; k < wire->size; ++k) {
        inputs_[wire->to + k] = wire->factor * outputs_[wire->from + k];
      }
    }
  }
  std::size_t row = 0;
  for (const Tear& back : loop_.tears) {
    const std::size_t from = output_places_.at(back.source);
    for (std::size_t k = 0; k < system_.variable(back.source).size; ++k) {
      column[row++] = back.conversion.linear.factor * outputs_[from + k];
    }
  }
}

}  // namespace stride::core
