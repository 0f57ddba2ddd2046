#include "master/core/exchange.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace stride::core {
namespace {

bool exchanged(const System& system, VariableId id) {
  const Variable& variable = system.variable(id);
  return variable.type != ValueType::Clock && !variable.is_clocked();
}

/// One transfer for the variables of a component that have this type and are discrete, or not.
template <class Transfer>
Transfer make_transfer(const System& system, ValueType type, bool discrete,
                       const std::vector<VariableId>& ids) {
  Transfer transfer{ValueBlock(type, 0), discrete, ValueBlock(type, 0), true, {}, ids, {}};
  std::size_t size = 0;
  for (const VariableId id : ids) {
    transfer.references.push_back(system.variable(id).reference);
    transfer.firsts.push_back(size);
    size += system.variable(id).size;
  }
  transfer.block = transfer.delivered = ValueBlock(type, size);
  return transfer;
}

/// At most two transfers for each type that occurs: what is continuous, and what is discrete.
template <class Transfers>
void plan(Transfers& transfers, const System& system, const std::set<VariableId>& ids) {
  using Transfer = typename Transfers::value_type::value_type;
  std::map<std::tuple<std::size_t, ValueType, bool>, std::vector<VariableId>> groups;
  for (const VariableId id : ids) {
    const Variable& variable = system.variable(id);
    const bool discrete = variable.variability != Variability::Continuous;
    groups[{id.component, variable.type, discrete}].push_back(id);
  }
  transfers.resize(system.components().size());
  for (const auto& [key, members] : groups) {
    const auto& [component, type, discrete] = key;
    transfers[component].push_back(make_transfer<Transfer>(system, type, discrete, members));
  }
}

template <std::size_t kSize, class Copies>
void copy_numbers(const Copies& copies) {
  for (const auto& copy : copies) std::memcpy(copy.to, copy.from, kSize);
}

}  // namespace

Exchange::Exchange(const System& system, std::span<const VariableId> recorded) : system_(system) {
  std::set<VariableId> outputs;
  std::set<VariableId> inputs;
  for (const Connection& connection : system.connections()) {
    if (!exchanged(system, connection.from)) continue;
    outputs.insert(connection.from);
    inputs.insert(connection.to);
  }
  for (const VariableId id : recorded) {
    if (!inputs.contains(id)) outputs.insert(id);
  }
  plan(outputs_, system, outputs);
  plan(inputs_, system, inputs);
  for (const auto& transfers : inputs_) {
    has_discrete_inputs_.push_back(std::any_of(transfers.begin(), transfers.end(),
                                               [](const Transfer& t) { return t.discrete; }));
  }
  for (const Connection& connection : system.connections()) {
    if (exchanged(system, connection.from)) add_copies(connection);
  }
}

template <class SomeTransfers>
auto Exchange::locate(SomeTransfers& transfers, VariableId id) {
  struct Place {
    decltype(&transfers[0][0].block) block = nullptr;
    std::size_t first = 0;
  };
  for (auto& transfer : transfers[id.component]) {
    const auto found = std::lower_bound(transfer.ids.begin(), transfer.ids.end(), id);
    if (found == transfer.ids.end() || *found != id) continue;
    const auto place = static_cast<std::size_t>(found - transfer.ids.begin());
    return Place{&transfer.block, transfer.firsts[place]};
  }
  return Place{};
}

Signal Exchange::signal(VariableId id) const {
  const auto input = locate(inputs_, id);
  const auto place = input.block != nullptr ? input : locate(outputs_, id);
  return {id, place.block, place.first};
}

Exchange::Place Exchange::place(VariableId id) {
  const auto input = locate(inputs_, id);
  const auto place = input.block != nullptr ? input : locate(outputs_, id);
  return {place.block, place.first};
}

void Exchange::add_copies(const Connection& connection) {
  const auto from = locate(std::as_const(outputs_), connection.from);
  const auto to = locate(inputs_, connection.to);
  ValueBlock& target = *to.block;
  for (std::size_t i = 0; i < system_.variable(connection.from).size; ++i) {
    const std::size_t source_at = from.first + i;
    const std::size_t target_at = to.first + i;
    switch (target.type()) {
      case ValueType::String:
        strings_.push_back({&target.strings()[target_at], &from.block->strings()[source_at]});
        break;
      case ValueType::Binary:
        binaries_.push_back({&target.binaries()[target_at], &from.block->binaries()[source_at]});
        break;
      case ValueType::Float64:
        add_real(doubles_, connection, &target.numbers<double>()[target_at],
                 &from.block->numbers<double>()[source_at]);
        break;
      case ValueType::Float32:
        add_real(floats_, connection, &target.numbers<float>()[target_at],
                 &from.block->numbers<float>()[source_at]);
        break;
      default: {
        const std::size_t size = element_size(target.type());
        const std::size_t list = size == 1 ? 0 : size == 2 ? 1 : size == 4 ? 2 : 3;
        numbers_[list].push_back(
            {target.bytes() + target_at * size, from.block->bytes() + source_at * size});
      }
    }
  }
}

template <class Real>
void Exchange::add_real(RealLists<Real>& lists, const Connection& connection, Real* to,
                        const Real* from) {
  lists.checked.push_back({from, connection.from});
  if (connection.conversion.is_identity()) {
    numbers_[sizeof(Real) == 4 ? 2 : 3].push_back(
        {reinterpret_cast<std::byte*>(to), reinterpret_cast<const std::byte*>(from)});
  } else {
    lists.converted.push_back(
        {to, from, connection.conversion.factor, connection.conversion.offset});
  }
}

void Exchange::fetch(std::size_t component, Unit& unit) {
  for (Transfer& transfer : outputs_[component]) unit.get(transfer.references, transfer.block);
}

bool Exchange::any_discrete_change(std::size_t component) const {
  for (const Transfer& transfer : inputs_[component]) {
    if (transfer.discrete && !(transfer.block == transfer.delivered)) return true;
  }
  return false;
}

void Exchange::deliver(std::size_t component, Unit& unit) {
  for (Transfer& transfer : inputs_[component]) {
    if (transfer.discrete) {
      if (!transfer.is_new && transfer.block == transfer.delivered) continue;
      transfer.delivered = transfer.block;
      transfer.is_new = false;
    }
    unit.set(transfer.references, transfer.block);
  }
}

void Exchange::route() {
  copy_numbers<1>(numbers_[0]);
  copy_numbers<2>(numbers_[1]);
  copy_numbers<4>(numbers_[2]);
  copy_numbers<8>(numbers_[3]);
  for (const auto& copy : doubles_.converted) *copy.to = copy.factor * *copy.from + copy.offset;
  for (const auto& copy : floats_.converted) {
    *copy.to = static_cast<float>(copy.factor * *copy.from + copy.offset);
  }
  for (const auto& copy : strings_) *copy.to = *copy.from;
  for (const auto& copy : binaries_) *copy.to = *copy.from;
}

void Exchange::check_nan(Time time) const {
  check_nan(doubles_, time);
  check_nan(floats_, time);
}

template <class Real>
void Exchange::check_nan(const RealLists<Real>& lists, Time time) const {
  for (const auto& [value, id] : lists.checked) {
    if (!std::isnan(*value)) [[likely]]
      continue;
    fail_run(
        {{}, system_.components()[id.component].name, system_.variable(id).name, time},
        "the output is NaN (not a number), and another unit is connected to it",
        "look at what this unit received before this instant; a parameter may be out of range");
  }
}

}  // namespace stride::core
