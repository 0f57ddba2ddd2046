#include "master/engine/run/loops/ordered_evaluation.h"

#include <algorithm>

namespace stride::core {
namespace {

class AllUnits : public OrderedEvaluation::Participants {
 public:
  bool takes_part(std::size_t) const override { return true; }
  void on_discontinuity(VariableId, bool) override {}
  bool include(std::size_t) override { return false; }
};

/// Of arrays that are connected in part: they are written as a whole, so what is not connected is
/// written, too.
void read_start_values(RunContext& context) {
  const UnitTimer timer(context.clock, context.statistics.units,
                        &UnitStatistics::initialization_time);
  for (const VariableId id : context.system.partly_connected_inputs()) {
    const Variable& input = context.system.variable(id);
    ValueBlock values(input.type, input.size);
    timer.timed(id.component, [&] {
      context.units[id.component]->get({&input.reference, 1}, values);
    });
    copy_elements(context.exchange.slice(id), {&values, 0, input.size});
  }
}

}  // namespace

OrderedEvaluation::OrderedEvaluation(RunContext& context, Phase phase, UnitTimer::Sum time)
    : system_(context.system),
      exchange_(context.exchange),
      phase_(phase),
      order_(evaluation_order(system_, phase)),
      ordered_exchange_(context, UnitTimer(context.clock, context.statistics.units, time),
                        phase == Phase::Initialization) {
  Targets targets;
  for (const Connection& connection : system_.connections()) {
    if (carries_value(system_, connection, phase)) {
      targets[connection.from].push_back(connection.target());
    }
  }
  blocks_.reserve(order_.size());
  for (const EvaluationBlock& planned : order_) plan(planned, targets, context);
  if (phase == Phase::Events) find_direct_inputs();
}

void OrderedEvaluation::plan(const EvaluationBlock& planned, const Targets& targets,
                             RunContext& context) {
  Block& block = blocks_.emplace_back();
  block.plan = &planned;
  std::set<VariableId> inner(planned.inputs.begin(), planned.inputs.end());
  std::set<ElementRange> torn;
  if (planned.is_loop()) block.loop.emplace(context, planned, ordered_exchange_);
  for (const TearingVariable& variable : planned.tearing_variables)
    torn.insert(variable.inputs.begin(), variable.inputs.end());
  std::vector<ElementRange> onward;
  for (const OutputGroup& group : planned.groups) {
    GroupEvaluation& evaluation =
        block.groups.emplace_back(GroupEvaluation{ordered_exchange_.plan_read(group), {}});
    for (const VariableId output : group.outputs) {
      for (const ElementRange& input : targets.at(output)) {
        if (planned.is_loop() && inner.count(input.id) == 0) {
          onward.push_back(input);
        } else if (torn.count(input) == 0) {
          evaluation.links.push_back(ordered_exchange_.plan_link(input));
        }
      }
    }
  }
  for (const ElementRange& input : onward)
    block.onward.push_back(ordered_exchange_.plan_link(input));
}

void OrderedEvaluation::find_direct_inputs() {
  const Dependencies dependencies(system_, phase_);
  std::set<VariableId> sources;
  for (const Connection& connection : system_.connections()) sources.insert(connection.from);
  for (std::size_t i = 0; i < system_.components().size(); ++i) {
    const auto& variables = system_.components()[i].description->variables;
    const std::vector<std::size_t>& all = dependencies.all_inputs(i);
    std::set<std::size_t> direct;
    for (std::size_t k = 0; k < variables.size() && direct.size() < all.size(); ++k) {
      const Variable& output = variables[k];
      const bool is_local = output.causality == Causality::Local && sources.contains({i, k});
      if ((output.causality != Causality::Output && !is_local) || !output.is_unclocked_value()) {
        continue;
      }
      const Dependencies::Inputs inputs = dependencies.inputs_of({i, k});
      const auto& depends_on = inputs.declared ? inputs.variables : all;
      direct.insert(depends_on.begin(), depends_on.end());
    }
    has_direct_inputs_ |= !direct.empty();
    for (const std::size_t k : direct) {
      if (variables[k].variability == Variability::Continuous) followed_.insert({i, k});
    }
  }
}

void OrderedEvaluation::run(Time time, Participants& participants) {
  time_ = time;
  participants_ = &participants;
  ordered_exchange_.begin();
  for (Block& block : blocks_) {
    if (block.loop) {
      evaluate_loop(block);
    } else if (takes_part(block)) {
      evaluate(block.groups.front());
      check_nan(block);
    }
  }
  for (std::size_t i = 0; i < system_.components().size(); ++i) {
    if (participants.takes_part(i)) ordered_exchange_.write_inputs(i);
  }
}

void OrderedEvaluation::evaluate(GroupEvaluation& group) {
  if (!participants_->takes_part(group.read.component())) return;
  ordered_exchange_.evaluate(group.read);
  for (OrderedExchange::Link& link : group.links) route(link);
}

void OrderedEvaluation::route(OrderedExchange::Link& link) {
  if (ordered_exchange_.route(link)) report(link.target().id);
}

void OrderedEvaluation::report(VariableId input) {
  const bool may_be_discontinuous =
      phase_ == Phase::Events && system_.variable(input).variability == Variability::Continuous &&
      system_.components()[input.component].description->has_event_mode;
  if (!is_trying_ && may_be_discontinuous)
    participants_->on_discontinuity(input, followed_.count(input) != 0);
}

void OrderedEvaluation::sweep(Block& block) {
  for (GroupEvaluation& group : block.groups) evaluate(group);
}

bool OrderedEvaluation::takes_part(const Block& block) const {
  return std::any_of(block.groups.begin(), block.groups.end(), [&](const GroupEvaluation& group) {
    return participants_->takes_part(group.read.component());
  });
}

void OrderedEvaluation::evaluate_loop(Block& block) {
  if (!takes_part(block)) return;
  if (phase_ == Phase::Initialization) block.loop->guess();
  sweep(block);
  if (!block.loop->has_converged()) solve(block);
  check_nan(block);
  for (OrderedExchange::Link& link : block.onward) route(link);
}

void OrderedEvaluation::solve(Block& block) {
  bool has_new_participant = false;
  for (GroupEvaluation& group : block.groups)
    has_new_participant |= participants_->include(group.read.component());
  std::vector<ValueBlock> before;
  for (const VariableId input : block.plan->inputs) before.push_back(exchange_.value(input));
  is_trying_ = true;
  if (has_new_participant) sweep(block);
  if (!block.loop->has_converged()) block.loop->solve([&] { sweep(block); }, time_);
  is_trying_ = false;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const VariableId input = block.plan->inputs[i];
    if (!(before[i] == exchange_.value(input))) report(input);
  }
}

void OrderedEvaluation::check_nan(const Block& block) const {
  const bool has_nan = std::any_of(
      block.groups.begin(), block.groups.end(),
      [&](const GroupEvaluation& group) { return ordered_exchange_.has_nan(group.read); });
  if (has_nan) exchange_.check_nan(time_);
}

void set_initial_values(RunContext& context, Time start) {
  AllUnits all;
  read_start_values(context);
  OrderedEvaluation(context, Phase::Initialization, &UnitStatistics::initialization_time)
      .run(start, all);
}

}  // namespace stride::core
