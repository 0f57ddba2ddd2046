#include "master/engine/run/loops/ordered_exchange.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace stride::core {
OrderedExchange::OrderedExchange(RunContext& context, const UnitTimer& timer, bool all_new)
    : system_(context.system),
      units_(context.units),
      exchange_(context.exchange),
      timer_(timer),
      all_new_(all_new),
      due_(units_.size()) {}

void OrderedExchange::add(Batch& batch, VariableId id) {
  const Variable& variable = system_.variable(id);
  batch.references.push_back(variable.reference);
  batch.members.push_back({exchange_.slice(id), batch.size});
  batch.size += variable.size;
}

void OrderedExchange::complete(Batch& batch) {
  if (batch.values.size() != batch.size) batch.values = ValueBlock(batch.values.type(), batch.size);
}

OrderedExchange::OutputRead OrderedExchange::plan_read(const OutputGroup& group) {
  OutputRead read;
  read.component_ = group.component;
  std::map<ValueType, std::vector<VariableId>> types;
  for (const VariableId id : group.outputs) types[system_.variable(id).type].push_back(id);
  for (const auto& [type, ids] : types) {
    Batch& batch = read.batches_.emplace_back(make_batch(type, false));
    for (const VariableId id : ids) add(batch, id);
    complete(batch);
  }
  open_.erase(open_.lower_bound({group.component, ValueType{}}),
              open_.lower_bound({group.component + 1, ValueType{}}));
  return read;
}

OrderedExchange::Link OrderedExchange::plan_link(const ElementRange& target) {
  const Connection& connection = system_.connection_to(target);
  const Variable& input = system_.variable(connection.to);
  Batch*& batch = open_[{connection.to.component, input.type}];
  if (batch == nullptr) batch = &batches_.emplace_back(make_batch(input.type, all_new_));
  const bool is_there =
      !system_.is_whole(target) && std::ranges::count(batch->references, input.reference) > 0;
  if (!is_there) add(*batch, connection.to);
  Link link;
  link.connection_ = &connection;
  link.from_ = exchange_.slice(connection.source());
  link.to_ = exchange_.slice(target);
  link.batch_ = batch;
  return link;
}

void OrderedExchange::begin() {
  for (std::vector<Batch*>& batches : due_) batches.clear();
  for (Batch& batch : batches_) batch.is_due = false;
}

void OrderedExchange::evaluate(OutputRead& read) {
  write_inputs(read.component_);
  for (Batch& batch : read.batches_) {
    timer_.timed(read.component_,
                 [&] { units_[read.component_]->get(batch.references, batch.values); });
    for (const Batch::Member& member : batch.members) {
      copy_elements(member.value, {&batch.values, member.first, member.value.size});
    }
  }
}

void OrderedExchange::write_inputs(std::size_t component) {
  for (Batch* batch : due_[component]) {
    complete(*batch);
    for (const Batch::Member& member : batch->members) {
      copy_elements({&batch->values, member.first, member.value.size}, member.value);
    }
    timer_.timed(component, [&] { units_[component]->set(batch->references, batch->values); });
    batch->is_due = batch->is_new = false;
  }
  due_[component].clear();
}

bool OrderedExchange::route(Link& link) {
  if (exchange_.is_forced(link.target().id)) return false;
  const bool changes = copy_elements(link.to_, link.from_, link.connection_->conversion);
  if (changes || link.batch_->is_new) make_due(link);
  return changes;
}

void OrderedExchange::make_due(Link& link) {
  if (std::exchange(link.batch_->is_due, true)) return;
  due_[link.target().id.component].push_back(link.batch_);
}

void OrderedExchange::read_input(Link& link) {
  const ElementRange target = link.target();
  const Variable& input = system_.variable(target.id);
  ValueBlock value(input.type, input.size);
  units_[target.id.component]->get({&input.reference, 1}, value);
  copy_elements(link.to_, {&value, target.first, target.size});
}

bool OrderedExchange::has_nan(const OutputRead& read) const {
  return std::any_of(read.batches_.begin(), read.batches_.end(),
                     [](const Batch& batch) { return core::has_nan(batch.values); });
}

}  // namespace stride::core
