#include "master/study/campaign/definition/aggregates.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "master/engine/model/values.h"
#include "master/system/declaration/find_variable.h"

namespace stride::campaign {
namespace {

using Function = Aggregate::Function;

double number_in(const core::Signal& signal) {
  return core::visit(*signal.block, [&]<class T>(std::span<T> elements) -> double {
    if constexpr (std::is_arithmetic_v<T>) {
      return static_cast<double>(elements[signal.first]);
    } else {
      return 0;  // has_numbers() has refused it
    }
  });
}

bool has_number(const core::Variable& variable) {
  return variable.size == 1 && variable.is_unclocked_value() &&
         variable.type != core::ValueType::String && variable.type != core::ValueType::Binary;
}

/// With what the rounding has lost so far.
void add_exactly(double& sum, double& error, double value) {
  const double total = sum + value;
  error += std::abs(sum) >= std::abs(value) ? (sum - total) + value : (value - total) + sum;
  sum = total;
}

}  // namespace

Aggregates::Aggregates(const std::vector<Aggregate>& aggregates, const core::System& system) {
  for (const Aggregate& aggregate : aggregates) {
    signals_.push_back(scenario::find_variable(
        system, aggregate.signal, aggregate.where, "a signal with a number",
        [](const auto&, const core::Variable& variable) { return has_number(variable); }));
    sums_.push_back({aggregate.function, aggregate.at});
  }
}

void Aggregates::on_start(std::span<const core::Signal> signals) {
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i].signal = signals[i];
}

void Aggregates::on_communication_point(Time time) {
  if (!start_) start_ = time;
  for (Sum& sum : sums_) add(sum, number_in(sum.signal), time);
  last_ = time;
}

void Aggregates::add(Sum& sum, double value, Time time) const {
  const bool is_first = !sum.is_known;
  switch (sum.function) {
    case Function::Min:
      sum.result = is_first ? value : std::min(sum.result, value);
      break;
    case Function::Max:
      sum.result = is_first ? value : std::max(sum.result, value);
      break;
    case Function::Final:
      sum.result = value;
      break;
    case Function::At:
      if (time > sum.at) return;
      sum.result = value;
      break;
    case Function::Mean:
    case Function::Integral:
      if (is_first) break;
      add_exactly(sum.result, sum.error, to_seconds(time - *last_) * (sum.last + value) / 2);
      break;
  }
  sum.last = value;
  sum.is_known = true;
}

std::vector<std::optional<double>> Aggregates::values() const {
  std::vector<std::optional<double>> values;
  for (const Sum& sum : sums_) {
    std::optional<double>& value = values.emplace_back();
    if (!sum.is_known || (sum.function == Function::At && *last_ < sum.at)) continue;
    value = sum.result + sum.error;
    if (sum.function != Function::Mean) continue;
    const double span = to_seconds(*last_ - *start_);
    value = span > 0 ? *value / span : sum.last;
  }
  return values;
}

}  // namespace stride::campaign
