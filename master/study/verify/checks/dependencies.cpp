#include <algorithm>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

using core::Causality;
using core::Unknown;
using core::ValueBlock;
using core::ValueReference;
using core::ValueType;
using core::Variable;

/// An output with the inputs of which it is declared to be a function.
struct Declared {
  const Variable* output;
  const std::vector<ValueReference>* knowns;

  bool may_depend_on(const Variable& input) const {
    return std::find(knowns->begin(), knowns->end(), input.reference) != knowns->end();
  }
};

std::vector<Declared> declared(const core::UnitDescription& unit,
                               const std::vector<Unknown>& unknowns) {
  std::vector<Declared> list;
  for (const Unknown& unknown : unknowns) {
    const Variable& variable = unit.variables[*unit.find(unknown.reference)];
    const bool is_checked = unknown.dependencies && variable.causality == Causality::Output &&
                            variable.is_unclocked_value();
    if (is_checked) list.push_back({&variable, &*unknown.dependencies});
  }
  return list;
}

class Prober {
 public:
  explicit Prober(const Trial& trial) : trial_(trial) {}

  /// The unit is where inputs may be set and outputs read at once: Initialization or Event Mode.
  void probe(TestInstance& instance, const std::vector<Declared>& outputs,
             const std::string& element) {
    const auto& variables = trial_.tested.description().variables;
    for (const Variable& input : variables) {
      const bool is_probed = input.causality == Causality::Input && input.is_unclocked_value();
      if (is_probed) probe(instance, input, outputs, element);
    }
  }
  std::size_t pairs() const { return pairs_; }

 private:
  void probe(TestInstance& instance, const Variable& input, const std::vector<Declared>& outputs,
             const std::string& element) {
    const ValueBlock before = instance.get(input);
    const ValueBlock other = other_value(input, before);
    if (other == before) return;
    std::vector<ValueBlock> values;
    for (const Declared& declared : outputs) values.push_back(instance.get(*declared.output));
    instance.set(input, other);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (outputs[i].may_depend_on(input)) continue;
      ++pairs_;
      const ValueBlock value = instance.get(*outputs[i].output);
      if (value == values[i]) continue;
      throw Failure(fmt::format(
          "at {} s '{}' goes from {} to {} when '{}' goes from {} to {}, though its <{}> does not "
          "list that among its dependencies",
          core::to_text(instance.now()), outputs[i].output->name, core::element_text(values[i], 0),
          core::element_text(value, 0), input.name, core::element_text(before, 0),
          core::element_text(other, 0), element));
    }
    instance.set(input, before);
  }

  const Trial& trial_;
  std::size_t pairs_ = 0;
};

}  // namespace

Finding check_dependencies(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  const std::vector<Declared> initial = declared(unit, unit.initial_unknowns);
  const std::vector<Declared> later = declared(unit, unit.outputs);
  if (initial.empty() && later.empty()) return skipped("it declares no dependencies of outputs");

  TestInstance instance = trial.make_instance();
  Prober prober(trial);
  instance.set_start_values();
  instance.enter_initialization();
  prober.probe(instance, initial, "InitialUnknown");
  instance.exit_initialization();
  const std::size_t at_start = prober.pairs();
  if (!unit.has_event_mode) {
    return passed(
        fmt::format("{} pairs of output and input at the start; it has no Event Mode in "
                    "which there could be others",
                    at_start));
  }
  constexpr double kInstants[] = {0, 0.1, 0.3, 0.6, 1};
  for (const double instant : kInstants) {
    instance.run_to(trial.point_at(instant), false);
    if (instance.recording().has_ended) break;
    instance.unit().enter_event_mode();
    prober.probe(instance, later, "Output");
    instance.finish_events();
  }
  return passed(fmt::format("{} pairs of output and input at the start, {} at events", at_start,
                            prober.pairs() - at_start));
}

}  // namespace stride::verify
