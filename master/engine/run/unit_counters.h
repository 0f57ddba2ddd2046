// What the parts of a run count of each unit, added to its statistics.
#ifndef STRIDE_MASTER_ENGINE_RUN_UNIT_COUNTERS_H
#define STRIDE_MASTER_ENGINE_RUN_UNIT_COUNTERS_H

#include <cstdint>
#include <vector>

#include "master/engine/run/context/run_context.h"
#include "master/engine/run/stepping/coasting_unit.h"
#include "master/engine/run/stepping/stepper.h"

namespace stride::core {

/// Counts that are kept by the unit itself, its process, the stepper and what saves its state.
class UnitCounters {
 public:
  /// All must outlive this object. `coasting`: by component; null where no state is saved.
  UnitCounters(const RunContext& context, const std::vector<CoastingUnit*>& coasting,
               const Stepper& stepper);

  /// The run is resumed: what the units and their processes have counted up to here was to bring
  /// them to where they are.
  void resume();

  /// To the present statistics of the run, or a copy of them, once.
  void add_to(RunStatistics& statistics) const;

 private:
  struct Counts {
    std::uint64_t calls = 0, snapshots = 0, restores = 0;
  };

  void add_counted_by_unit(std::size_t component, UnitStatistics& statistics) const;

  const RunContext& context_;
  const std::vector<CoastingUnit*>& coasting_;
  const Stepper& stepper_;
  std::vector<Counts> ignored_;  ///< by component
};

}  // namespace stride::core

#endif
