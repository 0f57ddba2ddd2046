#include "tests/property/random_interventions.h"

#include <random>
#include <set>

#include "master/engine/run/loops/evaluation_order.h"

namespace stride::tests {

using namespace stride::core;
using namespace std::chrono_literals;

namespace {

std::set<VariableId> inputs_of_loops(const System& system) {
  std::set<VariableId> inputs;
  for (const EvaluationBlock& block : evaluation_order(system, Phase::Events)) {
    if (block.is_loop()) inputs.insert(block.inputs.begin(), block.inputs.end());
  }
  return inputs;
}

}  // namespace

std::vector<Intervention> random_interventions(const Assembly& assembly, unsigned seed) {
  const System system(assembly.declaration());
  const std::set<VariableId> loops = inputs_of_loops(system);
  std::mt19937 random(seed);
  const auto instant = [&](Duration from, Duration until) {
    const auto count = [](Duration duration) {
      return static_cast<std::int64_t>(duration.count());
    };
    return Time(Duration(std::uniform_int_distribution(count(from), count(until))(random)));
  };
  const auto value = [&] {
    ValueBlock block(ValueType::Float64, 1);
    block.numbers<double>()[0] = std::uniform_real_distribution(-1.0, 1.0)(random);
    return block;
  };
  std::vector<Intervention> interventions;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const auto& variables = system.components()[i].description->variables;
    for (std::size_t k = 0; k < variables.size(); ++k) {
      const VariableId id{i, k};
      const Variable& variable = variables[k];
      if (variable.type == ValueType::Clock && !system.connections_to(id).empty()) {
        if (random() % 2 == 0) continue;
        Intervention late{Intervention::Kind::Delay, id, instant(0ms, 20ms), instant(21ms, 29ms)};
        late.delay = Duration(instant(0ms, 9ms).time_since_epoch()) + 1ms;
        Intervention none{Intervention::Kind::Drop, id, instant(30ms, 40ms)};
        late.clock = none.clock = id;
        interventions.push_back(std::move(late));
        interventions.push_back(std::move(none));
        continue;
      }
      const bool is_real_input = variable.causality == Causality::Input &&
                                 variable.type == ValueType::Float64 && variable.size == 1 &&
                                 system.is_signal(id) && !system.is_sampled(id);
      if (!is_real_input || loops.contains(id) || random() % 2 == 0) continue;
      const Time first = instant(0ms, 20ms);
      const Time second = instant(30ms, 49ms);
      if (system.connections_to(id).empty()) {
        interventions.push_back({Intervention::Kind::Set, id, first, {}, value()});
        interventions.push_back({Intervention::Kind::Set, id, second, {}, value()});
      } else {
        interventions.push_back(
            {Intervention::Kind::Force, id, first, instant(21ms, 29ms), value()});
        interventions.push_back({Intervention::Kind::Hold, id, second, {}, {}});
      }
    }
  }
  return interventions;
}

}  // namespace stride::tests
