#include "master/engine/run/exchange/exchange.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <ranges>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace stride::core {
namespace {

template <class Real>
constexpr const char* kRealName = sizeof(Real) == sizeof(float) ? "Float32" : "Float64";

/// Below it numbers of this type have fewer than three digits.
template <class Real>
constexpr double kLeast = 512.0 * static_cast<double>(std::numeric_limits<Real>::denorm_min());

/// One transfer for the variables of a component that have this type, are written at these
/// times, and belong to these clocks.
template <class Transfer>
Transfer make_transfer(const System& system, ValueType type, WriteTime write_time,
                       const std::vector<ValueReference>& clocks,
                       const std::vector<VariableId>& ids) {
  Transfer transfer{
      ValueBlock(type, 0), write_time, ValueBlock(type, 0), true, clocks, {}, ids, {}};
  std::size_t size = 0;
  for (const VariableId id : ids) {
    transfer.references.push_back(system.variable(id).reference);
    transfer.firsts.push_back(size);
    size += system.variable(id).size;
  }
  transfer.block = transfer.written = ValueBlock(type, size);
  return transfer;
}

WriteTime write_time_of(const Variable& variable, bool jumps) {
  const bool is_fixed =
      variable.causality == Causality::Parameter && variable.variability == Variability::Fixed;
  if (is_fixed) return WriteTime::Initialization;
  if (jumps || variable.variability != Variability::Continuous) return WriteTime::Change;
  return variable.intermediate_update ? WriteTime::PointAndWithin : WriteTime::Point;
}

/// At most three transfers for each type that occurs, one for each write time, and further ones for
/// each set of time-based clocks. `jumps`: variables that change by events whatever their
/// variability.
template <class Transfers>
void plan(Transfers& transfers, Transfers& sampled, const System& system,
          const std::set<VariableId>& ids, const std::set<VariableId>& jumps) {
  using Transfer = typename Transfers::value_type::value_type;
  using Key = std::tuple<std::size_t, ValueType, WriteTime, std::vector<ValueReference>>;
  std::map<Key, std::vector<VariableId>> groups;
  for (const VariableId id : ids) {
    const Variable& variable = system.variable(id);
    const WriteTime write_time = write_time_of(variable, jumps.contains(id));
    groups[{id.component, variable.type, write_time, variable.clocks}].push_back(id);
  }
  transfers.resize(system.components().size());
  sampled.resize(system.components().size());
  for (const auto& [key, members] : groups) {
    const auto& [component, type, write_time, clocks] = key;
    auto& list = clocks.empty() ? transfers : sampled;
    list[component].push_back(make_transfer<Transfer>(system, type, write_time, clocks, members));
  }
}

template <std::size_t kSize, class Copies>
void copy_numbers(const Copies& copies) {
  for (const auto& copy : copies) std::memcpy(copy.to, copy.from, kSize);
}

template <class To, class From>
void copy_mapped(void* to, const void* from, const Conversion& conversion) {
  *static_cast<To*>(to) = converted<To>(*static_cast<const From*>(from), conversion);
}

}  // namespace

Exchange::Exchange(const System& system, std::span<const VariableId> observed,
                   FirstValues first_values)
    : system_(system), first_values_(std::move(first_values)) {
  std::set<VariableId> outputs;
  std::set<VariableId> inputs;
  std::set<VariableId> jumps;  // fed by sampled values, which change by events
  for (const Connection& connection : system.connections()) {
    if (!system.is_signal(connection.from)) continue;
    outputs.insert(connection.from);
    inputs.insert(connection.to);
    if (system.is_sampled(connection.from)) jumps.insert(connection.to);
  }
  for (const VariableId id : observed) {
    if (!inputs.contains(id)) outputs.insert(id);
  }
  plan(outputs_, sampled_outputs_, system, outputs, {});
  plan(inputs_, sampled_inputs_, system, inputs, jumps);
  for (const Connection& connection : system.connections()) {
    if (!system.is_signal(connection.from)) continue;
    add_copies(connection);
    has_other_types_ |= system.variable(connection.from).type != ValueType::Float64;
  }
  for (Transfers* const transfers : {&outputs_, &sampled_outputs_}) add_item_checks(*transfers);
  has_other_types_ |= !items_.is_empty();
  make_ports();
}

void Exchange::add_item_checks(Transfers& transfers) {
  for (Transfer& transfer : transfers | std::views::join) {
    for (std::size_t i = 0; i < transfer.ids.size(); ++i) {
      const VariableId id = transfer.ids[i];
      items_.add(id, {&transfer.block, transfer.firsts[i], system_.variable(id).size});
    }
  }
}

/// They are adjacent, so that a communication step reads memory in one direction.
void Exchange::make_ports() {
  struct Lengths {
    std::size_t inputs, outputs;
  };
  std::vector<Lengths> lengths;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const std::size_t first = bound_values_.size();
    for (Transfer& input : inputs_[i]) {
      if (!input.is_discrete()) bound_values_.emplace_back(input.references, input.block);
    }
    const std::size_t inputs = bound_values_.size() - first;
    for (Transfer& output : outputs_[i]) {
      bound_values_.emplace_back(output.references, output.block);
    }
    lengths.push_back({inputs, outputs_[i].size()});
  }
  const BoundValues* next = bound_values_.data();
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto [inputs, outputs] = lengths[i];
    const bool has_discrete_inputs =
        std::ranges::any_of(inputs_[i], &Transfer::is_written_on_change);
    ports_.push_back({{{next, inputs}, {next + inputs, outputs}}, has_discrete_inputs});
    next += inputs + outputs;
  }
}

Exchange::TransferSlot Exchange::locate(Transfers& transfers, VariableId id) {
  for (Transfer& transfer : transfers[id.component]) {
    const auto found = std::lower_bound(transfer.ids.begin(), transfer.ids.end(), id);
    if (found == transfer.ids.end() || *found != id) continue;
    return {&transfer, transfer.firsts[static_cast<std::size_t>(found - transfer.ids.begin())]};
  }
  return {};
}

Exchange::TransferSlot Exchange::locate_input(VariableId id) {
  return locate(system_.variable(id).is_clocked() ? sampled_inputs_ : inputs_, id);
}

Exchange::TransferSlot Exchange::locate_output(VariableId id) {
  return locate(system_.variable(id).is_clocked() ? sampled_outputs_ : outputs_, id);
}

Signal Exchange::signal(VariableId id) {
  const TransferSlot input = locate_input(id);
  if (input.transfer != nullptr && system_.variable(id).is_clocked()) {
    return {id, &input.transfer->written, input.first};
  }
  const ValueSlice value = slice(id);
  return {id, value.block, value.first};
}

ValueSlice Exchange::slice(VariableId id) {
  const TransferSlot input = locate_input(id);
  const TransferSlot slot = input.transfer != nullptr ? input : locate_output(id);
  return {&slot.transfer->block, slot.first, system_.variable(id).size};
}

ValueSlice Exchange::slice(const ElementRange& range) {
  const ValueSlice whole = slice(range.id);
  return {whole.block, whole.first + range.first, range.size};
}

void Exchange::add_copies(const Connection& connection) {
  const TransferSlot from = locate_output(connection.from);
  const TransferSlot to = locate_input(connection.to);
  const std::size_t from_first = from.first + connection.from_first;
  const std::size_t to_first = to.first + connection.to_first;
  for (std::size_t i = 0; i < connection.size; ++i) {
    add_copy(connection, to.transfer->block, to_first + i, from.transfer->block, from_first + i);
  }
}

void Exchange::add_copy(const Connection& connection, ValueBlock& target, std::size_t target_at,
                        const ValueBlock& source, std::size_t source_at) {
  switch (source.type()) {
    case ValueType::String:
      strings_.push_back({&target.strings()[target_at], &source.strings()[source_at]});
      break;
    case ValueType::Binary:
      binaries_.push_back({&target.binaries()[target_at], &source.binaries()[source_at]});
      break;
    case ValueType::Float64:
      add_real(doubles_, connection, target, target_at, &source.numbers<double>()[source_at]);
      break;
    case ValueType::Float32:
      add_real(floats_, connection, target, target_at, &source.numbers<float>()[source_at]);
      break;
    default:
      add_number(connection, target, target_at, source, source_at);
  }
}

template <class Real, class Other>
void Exchange::add_real(RealLists<Real, Other>& lists, const Connection& connection,
                        ValueBlock& target, std::size_t target_at, const Real* from) {
  const LinearConversion& linear = connection.conversion.linear;
  lists.checked.push_back({from, connection.from});
  if (target.type() != system_.variable(connection.from).type) {
    lists.changed.push_back(
        {{&target.numbers<Other>()[target_at], from, linear.factor, linear.offset},
         first_values_.warns() ? kLeast<Other> : 0});
  } else if (linear.is_identity()) {
    lists.plain.push_back({&target.numbers<Real>()[target_at], from});
  } else {
    lists.converted.push_back(
        {&target.numbers<Real>()[target_at], from, linear.factor, linear.offset});
  }
}

void Exchange::add_number(const Connection& connection, ValueBlock& target, std::size_t target_at,
                          const ValueBlock& source, std::size_t source_at) {
  const std::size_t size = element_size(target.type());
  const Conversion& conversion = connection.conversion;
  std::byte* const to = target.bytes() + target_at * size;
  if (target.type() == source.type() && conversion.is_identity()) {
    const std::size_t list = size == 1 ? 0 : size == 2 ? 1 : size == 4 ? 2 : 3;
    numbers_[list].push_back({to, source.bytes() + source_at * size});
    return;
  }
  const auto* const from = source.bytes() + source_at * element_size(source.type());
  visit(target, [&]<class To>(std::span<To>) {
    visit(source, [&]<class From>(std::span<const From>) {
      if constexpr (std::is_arithmetic_v<To> && std::is_integral_v<From>) {
        mapped_.push_back({&copy_mapped<To, From>, to, from, &connection, {&target, target_at, 1}});
      }
    });
  });
}

void Exchange::read_outputs(std::size_t component, Unit& unit) {
  for (const BoundValues& output : ports_[component].values.outputs) {
    unit.get(output.references, *output.block);
  }
}

void Exchange::begin_samples(std::size_t component, Unit& unit) {
  for (Transfer& transfer : sampled_outputs_[component]) {
    unit.get(transfer.references, transfer.block);
  }
  for (Transfer& transfer : sampled_inputs_[component]) {
    transfer.written = transfer.block;
    transfer.is_new = false;
  }
}

bool Exchange::any_discrete_change(std::size_t component) const {
  for (const Transfer& transfer : inputs_[component]) {
    if (transfer.is_written_on_change() && !(transfer.block == transfer.written)) return true;
  }
  return false;
}

void Exchange::write_inputs(std::size_t component, Unit& unit) {
  ports_[component].written_route = route_;
  // units of other threads do the same meanwhile
  std::atomic_ref(written_alone_).store(route_, std::memory_order_relaxed);
  for (const BoundValues& input : ports_[component].values.inputs) {
    unit.set(input.references, *input.block);
  }
  if (ports_[component].has_discrete_inputs) write_discrete_inputs(component, unit);
}

void Exchange::write_discrete_inputs(std::size_t component, Unit& unit) {
  for (Transfer& transfer : inputs_[component]) {
    if (transfer.is_written_on_change() && is_changed(transfer)) write(transfer, unit);
  }
}

void Exchange::write(Transfer& transfer, Unit& unit) {
  transfer.written = transfer.block;
  transfer.is_new = false;
  unit.set(transfer.references, transfer.block);
}

bool Exchange::is_of(const Transfer& transfer, std::span<const ValueReference> ticking) {
  return std::ranges::find_first_of(transfer.clocks, ticking) != transfer.clocks.end();
}

void Exchange::read_sampled_outputs(std::size_t component, Unit& unit,
                                    std::span<const ValueReference> ticking) {
  for (Transfer& transfer : sampled_outputs_[component]) {
    if (is_of(transfer, ticking)) unit.get(transfer.references, transfer.block);
  }
}

void Exchange::write_sampled_inputs(std::size_t component, Unit& unit,
                                    std::span<const ValueReference> ticking) {
  for (Transfer& transfer : sampled_inputs_[component]) {
    if (is_of(transfer, ticking) && is_changed(transfer)) write(transfer, unit);
  }
}

bool Exchange::has_sampled_change(std::size_t component,
                                  std::span<const ValueReference> ticking) const {
  const auto& transfers = sampled_inputs_[component];
  return std::any_of(transfers.begin(), transfers.end(), [&](const Transfer& transfer) {
    return is_of(transfer, ticking) && is_changed(transfer);
  });
}

std::vector<VariableId> Exchange::sampled_changes(std::size_t component,
                                                  std::span<const ValueReference> ticking) const {
  std::vector<VariableId> changes;
  for (const Transfer& transfer : sampled_inputs_[component]) {
    if (is_of(transfer, ticking)) add_changes(transfer, transfer.written, changes);
  }
  return changes;
}

void Exchange::write_inputs_within_step(std::size_t component, Unit& unit) {
  for (const Transfer& transfer : inputs_[component]) {
    if (transfer.write_time != WriteTime::PointAndWithin) continue;
    unit.set(transfer.references, transfer.block);
  }
}

std::vector<ContinuousLink> Exchange::links_from(Variability source_variability) {
  std::vector<ContinuousLink> links;
  for (const Connection& connection : system_.connections()) {
    const Variable& source = system_.variable(connection.from);
    const Variable& target = system_.variable(connection.to);
    const bool is_wanted = source.variability == source_variability &&
                           target.variability == Variability::Continuous && is_real(source.type) &&
                           is_real(target.type);
    if (!is_wanted || source.is_clocked() || target.is_clocked()) continue;
    const ValueSlice from = slice(connection.source());
    const ValueSlice to = slice(connection.target());
    for (std::size_t i = 0; i < connection.size; ++i) {
      links.push_back({connection.from,
                       connection.to,
                       {from.block, from.first + i},
                       {to.block, to.first + i},
                       connection.conversion.linear});
    }
  }
  return links;
}

std::vector<Exchange::RealValue> Exchange::elements(
    std::vector<Transfer>& transfers, const std::function<bool(const Transfer&)>& is_wanted) const {
  std::vector<RealValue> elements;
  for (Transfer& transfer : transfers) {
    if (!is_wanted(transfer)) continue;
    for (std::size_t i = 0; i < transfer.ids.size(); ++i) {
      for (std::size_t k = 0; k < system_.variable(transfer.ids[i]).size; ++k) {
        elements.push_back({transfer.ids[i], {&transfer.block, transfer.firsts[i] + k}});
      }
    }
  }
  return elements;
}

std::vector<Exchange::RealValue> Exchange::continuous_inputs(std::size_t component) {
  return elements(inputs_[component], [](const Transfer& t) { return !t.is_discrete(); });
}

std::vector<Exchange::RealValue> Exchange::outputs_with_tolerance(std::size_t component) {
  std::vector<RealValue> values = elements(outputs_[component], [](const Transfer& transfer) {
    return transfer.block.type() == ValueType::Float64;
  });
  std::erase_if(values, [&](const RealValue& v) { return !system_.variable(v.id).tolerance; });
  return values;
}

/// The variables of which a value is not what it was.
void Exchange::add_changes(const Transfer& transfer, const ValueBlock& before,
                           std::vector<VariableId>& changes) const {
  for (std::size_t i = 0; i < transfer.ids.size(); ++i) {
    const std::size_t first = transfer.firsts[i];
    const std::size_t end = first + system_.variable(transfer.ids[i]).size;
    bool differs = false;
    for (std::size_t k = first; k < end; ++k) differs |= !is_same(transfer.block, k, before, k);
    if (differs) changes.push_back(transfer.ids[i]);
  }
}

template <class Real, class Other>
[[gnu::always_inline]] inline bool Exchange::RealLists<Real, Other>::route() const {
  bool is_odd = false;
  for (const auto& [to, from] : plain) {
    const Real value = *from;
    *to = value;
    is_odd |= std::isnan(value);
  }
  for (const auto& copy : converted) {
    const Real value = *copy.from;
    const Real result = static_cast<Real>(copy.factor * value + copy.offset);
    *copy.to = result;
    is_odd |= !std::isfinite(result) && !std::isinf(value);
  }
  for (const auto& copy : changed) {
    const Real value = *copy.from;
    const double exact = copy.factor * value + copy.offset;
    const Other result = static_cast<Other>(exact);
    *copy.to = result;
    is_odd |= (!std::isfinite(result) && !std::isinf(value)) || copy.is_lost(exact);
  }
  return is_odd;
}

void Exchange::route(const Time& time) {
  ++route_;
  const bool is_odd = doubles_.route();
  if (is_odd || has_other_types_ || !forced_.empty()) route_further(is_odd, time);
}

void Exchange::route_further(bool is_odd, const Time& time) {
  if (has_other_types_) {
    route_other_types(time);
    is_odd |= floats_.route();
  }
  if (is_odd) [[unlikely]]
    check_nan(time);
  for (const Forced& forced : forced_) keep(forced);
}

void Exchange::force(VariableId input, const ValueBlock& value) {
  release(input);
  keep(forced_.emplace_back(Forced{input, slice(input), value}));
}

void Exchange::release(VariableId input) {
  std::erase_if(forced_, [&](const Forced& forced) { return forced.input == input; });
}

ValueBlock Exchange::value(VariableId id) {
  const Signal from = signal(id);
  const Variable& variable = system_.variable(id);
  ValueBlock value(variable.type, variable.size);
  copy_elements(value, 0, *from.block, from.first, variable.size);
  return value;
}

void Exchange::route_other_types(Time time) {
  items_.check(time);
  copy_numbers<1>(numbers_[0]);
  copy_numbers<2>(numbers_[1]);
  copy_numbers<4>(numbers_[2]);
  copy_numbers<8>(numbers_[3]);
  for (const MappedCopy& copy : mapped_) {
    copy.copy(copy.to, copy.from, copy.connection->conversion);
    check_mapped(copy, time);
  }
  for (const auto& copy : strings_) *copy.to = *copy.from;
  for (const auto& copy : binaries_) *copy.to = *copy.from;
}

void Exchange::check_mapped(const MappedCopy& copy, Time time) const {
  const Connection& connection = *copy.connection;
  check_converted(system_, connection.from, connection.to, connection.conversion, copy.target, time,
                  &first_values_);
}

void Exchange::check_values(Time time) const {
  check_nan(time);
  items_.check(time);
  for (const MappedCopy& copy : mapped_) check_mapped(copy, time);
}

void Exchange::check_nan(Time time) const {
  check_nan(doubles_, time);
  check_nan(floats_, time);
}

template <class Real, class Other>
void Exchange::check_nan(const RealLists<Real, Other>& lists, Time time) const {
  for (const auto& [value, id] : lists.checked) {
    if (!std::isnan(*value)) [[likely]]
      continue;
    fail_run(
        output_context(id, time),
        "the output is NaN (not a number), and another unit is connected to it",
        "look at what this unit received before this instant; a parameter may be out of range");
  }
  const auto check_range = [&]<class To>(const ConvertedCopy<To, Real>& copy) {
    const To result = static_cast<To>(copy.factor * *copy.from + copy.offset);
    if (std::isfinite(result) || std::isinf(*copy.from)) [[likely]]
      return;
    fail_run(output_context(source_of(lists, copy.from), time),
             fmt::format("the output is {}, which is beyond the range of {} in the input that it "
                         "is connected to",
                         *copy.from, kRealName<To>),
             "connect it to a Float64, or look at the units of measure of both");
  };
  for (const auto& copy : lists.converted) check_range(copy);
  for (const auto& copy : lists.changed) check_range.template operator()<Other>(copy);
  note_lost(lists, time);
}

template <class Real, class Other>
void Exchange::note_lost(const RealLists<Real, Other>& lists, Time time) const {
  for (auto& copy : lists.changed) {
    const double exact = copy.factor * *copy.from + copy.offset;
    if (!copy.is_lost(exact)) [[likely]]
      continue;
    copy.least = 0;
    const VariableId id = source_of(lists, copy.from);
    if (!lost_.insert(id).second) continue;
    first_values_.warn(
        to_text(output_context(id, time)) +
        fmt::format("the output is {}, which becomes {} in the input that it is connected to: "
                    "{} has no such number so near to 0 (said once)",
                    *copy.from, static_cast<Other>(exact), kRealName<Other>));
  }
}

template <class Real, class Other>
VariableId Exchange::source_of(const RealLists<Real, Other>& lists, const Real* from) {
  return std::ranges::find(lists.checked, from, &Checked<Real>::value)->id;
}

Context Exchange::output_context(VariableId id, Time time) const {
  return {{}, system_.components()[id.component].name, system_.variable(id).name, time};
}

}  // namespace stride::core
