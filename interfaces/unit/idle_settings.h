// What an importer has set for a unit's idle skipping (<stride/idle.h>), kept where the unit reads
// it.
#ifndef STRIDE_INTERFACES_UNIT_IDLE_SETTINGS_H
#define STRIDE_INTERFACES_UNIT_IDLE_SETTINGS_H

#include <stride/fmi3.h>
#include <stride/unit.h>

#include "interfaces/unit/table.h"

namespace stride::kit {

class IdleSettings {
 public:
  /// Switched off, with the tolerances that the unit declares. `unit` and `table` must outlive it.
  IdleSettings(Unit& unit, const Table& table);

  bool is_enabled() const { return unit_->max_skip_.has_value(); }
  std::optional<Duration> max_skip() const { return unit_->max_skip_; }
  void enable(Duration max_skip) { unit_->max_skip_ = max_skip; }

  /// Whether the variable is an output with a tolerance.
  bool has_tolerance(fmi3ValueReference reference) const;
  void set_tolerance(fmi3ValueReference reference, double tolerance);

  void save(StateWriter& writer) const;
  void load(StateReader& reader);

 private:
  Unit* unit_;
  const Table* table_;
};

}  // namespace stride::kit

#endif
