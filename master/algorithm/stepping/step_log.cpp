#include "master/algorithm/stepping/step_log.h"

#include <algorithm>
#include <cstring>

namespace stride::core {

void StepLog::cut(const Mark& mark) {
  assignments_.resize(mark.assignments);
  references_.resize(mark.references);
  bytes_.resize(mark.bytes);
  steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(mark.steps), steps_.end());
}

StepLog::Mark StepLog::mark() const {
  return {assignments_.size(), references_.size(), bytes_.size(), steps_.size()};
}

void StepLog::reserve(std::size_t times) {
  assignments_.reserve(assignments_.size() * times);
  references_.reserve(references_.size() * times);
  bytes_.reserve(bytes_.size() * times);
  steps_.reserve(steps_.size() * times);
}

std::size_t StepLog::size() const {
  return assignments_.size() * sizeof(Assignment) + references_.size() * sizeof(ValueReference) +
         bytes_.size() + steps_.size() * sizeof(Step);
}

void StepLog::add_inputs(std::span<const ValueReference> references, const ValueBlock& values) {
  assignments_.push_back(
      {references_.size(), references.size(), bytes_.size(), values.size(), values.type()});
  references_.insert(references_.end(), references.begin(), references.end());
  const std::byte* const first = values.bytes();
  bytes_.insert(bytes_.end(), first, first + values.size() * element_size(values.type()));
}

void StepLog::add_step(const StepInterval& interval, std::span<const BoundValues> outputs,
                       const StepResult& result) {
  steps_.push_back({interval, outputs, result.reached, assignments_.size()});
}

void StepLog::set_inputs(Unit& unit) {
  assign(unit, steps_.empty() ? 0 : steps_.back().assignments, assignments_.size());
}

void StepLog::assign(Unit& unit, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const Assignment& from = assignments_[i];
    ValueBlock& values = block(from.type, from.size);
    std::memcpy(values.bytes(), bytes_.data() + from.first_byte,
                from.size * element_size(from.type));
    unit.set(std::span(references_).subspan(from.first_reference, from.references), values);
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
