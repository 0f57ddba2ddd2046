#include "master/engine/run/stepping/step_log.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace stride::core {
namespace {

/// The first of `count` new elements; `used` are in use.
template <class T>
T* extend(std::vector<T>& list, std::size_t& used, std::size_t count = 1) {
  const std::size_t first = std::exchange(used, used + count);
  if (used > list.size()) [[unlikely]]
    list.resize(2 * used);
  return list.data() + first;
}

}  // namespace

void StepLog::reserve(std::size_t times) {
  assignments_.resize(used_.assignments * times);
  bytes_.resize(used_.bytes * times);
  steps_.resize(used_.steps * times);
}

std::size_t StepLog::size() const {
  return used_.assignments * sizeof(Assignment) + used_.bytes + used_.steps * sizeof(Step);
}

void StepLog::add_inputs(std::span<const ValueReference> references, const ValueBlock& values) {
  add_assignment(references, values.type(), values.size(),
                 {values.bytes(), values.size() * element_size(values.type())});
}

void StepLog::add_inputs(std::span<const BoundValues> inputs) {
  for (const BoundValues& input : inputs) {
    if (input.float64s.empty()) {
      add_inputs(input.references, *input.block);
    } else {  // as most are
      add_inputs(input.references, input.float64s);
    }
  }
}

void StepLog::add_inputs(std::span<const ValueReference> references,
                         std::span<const double> values) {
  add_assignment(references, ValueType::Float64, values.size(), std::as_bytes(values));
}

inline void StepLog::add_assignment(std::span<const ValueReference> references, ValueType type,
                                    std::size_t size, std::span<const std::byte> bytes) {
  *extend(assignments_, used_.assignments) = {references, used_.bytes, size, type};
  std::memcpy(extend(bytes_, used_.bytes, bytes.size()), bytes.data(), bytes.size());
}

void StepLog::add_step(const StepInterval& interval, std::span<const BoundValues> outputs,
                       const StepResult& result) {
  *extend(steps_, used_.steps) = {interval, outputs, result.reached, used_.assignments};
}

void StepLog::set_inputs(Unit& unit) {
  const std::size_t in_steps = used_.steps == 0 ? 0 : steps_[used_.steps - 1].assignments;
  assign(unit, in_steps, used_.assignments);
}

void StepLog::assign(Unit& unit, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const Assignment& from = assignments_[i];
    ValueBlock& values = block(from.type, from.size);
    std::memcpy(values.bytes(), bytes_.data() + from.first_byte,
                from.size * element_size(from.type));
    unit.set(from.references, values);
  }
}

ValueBlock& StepLog::block(ValueType type, std::size_t size) {
  const auto found = std::ranges::find_if(blocks_, [&](const ValueBlock& block) {
    return block.type() == type && block.size() == size;
  });
  return found != blocks_.end() ? *found : blocks_.emplace_back(type, size);
}

bool StepLog::repeat(Unit& unit, const Step& step) {
  const StepResult result = unit.step(step.interval, {{}, step.outputs});
  return !result.rejected && result.reached == step.reached;
}

}  // namespace stride::core
