// Idle skipping: the functions of <stride/idle.h>, and FMI's output derivatives.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "master/loader/fmu/fmi3/fmi3_unit.h"

namespace stride::importer {

std::vector<Fmi3Unit::TangentOutput> Fmi3Unit::tangent_outputs(
    const core::UnitDescription& description) {
  std::vector<TangentOutput> outputs;
  for (const core::Variable& variable : description.variables) {
    if (!variable.tolerance) continue;
    outputs.push_back({variable.reference, variable.size, variable.has_derivative});
  }
  std::sort(outputs.begin(), outputs.end(), [](const TangentOutput& a, const TangentOutput& b) {
    return a.reference < b.reference;
  });
  return outputs;
}

void Fmi3Unit::enable_idle_skipping(Duration max_skip) {
  library_->require_idle_functions(options_.where);
  const bool is_endless = max_skip == Duration::max();
  call("strideEnableIdleSkipping", library_->idle_functions().EnableIdleSkipping,
       is_endless ? std::numeric_limits<double>::infinity() : to_seconds(max_skip));
  may_skip_ = true;
}

void Fmi3Unit::set_idle_tolerances(References outputs, std::span<const double> tolerances) {
  library_->require_idle_functions(options_.where);
  call("strideSetIdleTolerances", library_->idle_functions().SetIdleTolerances, outputs.data(),
       outputs.size(), tolerances.data(), tolerances.size());
}

Time Fmi3Unit::idle_until() {
  if (!may_skip_) return Time::min();
  double until = -std::numeric_limits<double>::infinity();
  call("strideGetIdlePromise", library_->idle_functions().GetIdlePromise, &until);
  if (until > kMaxSeconds) return Time::max();
  if (until < -kMaxSeconds) return Time::min();
  return checked_time(until, "the promise of strideGetIdlePromise");
}

const Fmi3Unit::TangentOutput& Fmi3Unit::tangent_output(core::ValueReference reference) const {
  const auto found = std::lower_bound(
      tangent_outputs_.begin(), tangent_outputs_.end(), reference,
      [](const TangentOutput& output, core::ValueReference r) { return output.reference < r; });
  if (found != tangent_outputs_.end() && found->reference == reference) return *found;
  fail(fmt::format(
      "the variable with the value reference {} is not an output with a tolerance, so it "
      "has no tangent",
      reference));
}

void Fmi3Unit::get_derivatives(References outputs, std::span<double> derivatives) {
  derived_.clear();
  std::size_t elements = 0;
  for (const core::ValueReference reference : outputs) {
    const TangentOutput& output = tangent_output(reference);
    if (!output.has_derivative) continue;
    derived_.push_back(reference);
    elements += output.size;
  }
  orders_.assign(derived_.size(), 1);
  slopes_.assign(elements, 0);
  if (!derived_.empty()) {
    if (fmi_.GetOutputDerivatives == nullptr) {
      fail("its library does not export fmi3GetOutputDerivatives",
           "a unit whose outputs have derivatives must have it (maxOutputDerivativeOrder)");
    }
    call("fmi3GetOutputDerivatives", fmi_.GetOutputDerivatives, derived_.data(), derived_.size(),
         std::as_const(orders_).data(), slopes_.data(), slopes_.size());
  }
  auto from = slopes_.begin();
  auto to = derivatives.begin();
  for (const core::ValueReference reference : outputs) {
    const TangentOutput& output = tangent_output(reference);
    if (!output.has_derivative) {
      to = std::fill_n(to, output.size, 0.0);
    } else {
      to = std::copy_n(from, output.size, to);
      from += static_cast<std::ptrdiff_t>(output.size);
    }
  }
}

}  // namespace stride::importer
