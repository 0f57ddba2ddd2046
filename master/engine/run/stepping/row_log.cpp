#include "master/engine/run/stepping/row_log.h"

#include <algorithm>
#include <bit>

namespace stride::core {

RowLog::RowLog(std::span<const StepValues> units) {
  for (const StepValues& values : units) {
    inputs_.add(values.inputs);
    outputs_.add(values.outputs);
  }
  for (Numbers* const numbers : {&inputs_, &outputs_}) numbers->firsts.push_back(numbers->size);
}

void RowLog::Numbers::add(std::span<const BoundValues> blocks) {
  firsts.push_back(size);
  for (const BoundValues& block : blocks) {
    const std::span<const double> numbers = block.float64s;
    if (!runs.empty() && runs.back().first + runs.back().size == numbers.data()) {
      runs.back().size += numbers.size();
    } else if (!numbers.empty()) {
      runs.push_back({numbers.data(), numbers.size()});
    }
    size += numbers.size();
  }
}

inline void RowLog::Numbers::copy_to(double* target) const {
  for (const Run& run : runs) {
    if (run.size == 1) {  // as most are
      *target++ = *run.first;
    } else {
      target = std::copy_n(run.first, run.size, target);
    }
  }
}

void RowLog::make_room(std::size_t steps) {
  const std::size_t room = std::bit_ceil(std::max<std::size_t>(steps, 1));
  mask_ = room - 1;
  steps_.assign(room, StepInterval(Time{}, Time{}));
  given_ = std::make_unique_for_overwrite<double[]>(room * inputs_.size);
  before_ = std::make_unique_for_overwrite<double[]>(outputs_.size);
}

const StepInterval& RowLog::begin_step(const StepInterval& interval, bool may_go_back_before) {
  StepInterval& step = steps_[slot(end_)];
  step = interval;
  step.may_go_back_before = may_go_back_before;
  inputs_.copy_to(given_.get() + slot(end_) * inputs_.size);
  outputs_.copy_to(before_.get());
  return step;
}

std::span<const double> RowLog::inputs(std::size_t unit, std::uint64_t position) const {
  return inputs_.of(unit, given_.get() + slot(position) * inputs_.size);
}

std::span<const double> RowLog::outputs_before(std::size_t unit) const {
  return outputs_.of(unit, before_.get());
}

}  // namespace stride::core
