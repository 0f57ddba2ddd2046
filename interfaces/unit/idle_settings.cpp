#include "interfaces/unit/idle_settings.h"

#include <functional>
#include <stdexcept>

namespace stride {

double Unit::tolerance_of(const double& output) const {
  constexpr std::less<const double*> is_before;  // a total order, whatever the members' places
  for (const Tolerance& known : tolerances_) {
    if (!is_before(&output, known.first) && is_before(&output, known.last)) return known.value;
  }
  throw std::logic_error("tolerance_of() is asked for a member that has no tolerance()");
}

}  // namespace stride

namespace stride::kit {

IdleSettings::IdleSettings(Unit& unit, const Table& table) : unit_(&unit), table_(&table) {
  unit.max_skip_.reset();
  unit.tolerances_.clear();
  for (const Variable& row : unit.variables()) {
    if (!row.tolerance) continue;
    const auto* first = static_cast<const double*>(row.data);
    unit.tolerances_.push_back({first, first + row.size, *row.tolerance});
  }
}

bool IdleSettings::has_tolerance(fmi3ValueReference reference) const {
  return table_->row(reference).tolerance.has_value();
}

void IdleSettings::set_tolerance(fmi3ValueReference reference, double tolerance) {
  const void* data = table_->slot(reference).data;
  for (Unit::Tolerance& known : unit_->tolerances_) {
    if (known.first == data) known.value = tolerance;
  }
}

void IdleSettings::save(StateWriter& writer) const {
  writer.write(is_enabled());
  writer.write(unit_->max_skip_.value_or(Duration{}));
  for (const Unit::Tolerance& known : unit_->tolerances_) writer.write(known.value);
}

void IdleSettings::load(StateReader& reader) {
  bool enabled = false;
  Duration max_skip{};
  reader.read(enabled);
  reader.read(max_skip);
  unit_->max_skip_ = enabled ? std::optional(max_skip) : std::nullopt;
  for (Unit::Tolerance& known : unit_->tolerances_) reader.read(known.value);
}

}  // namespace stride::kit
