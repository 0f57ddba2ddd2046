#ifndef STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_STEPS_IN_A_ROW_H
#define STRIDE_MASTER_ENGINE_PORT_CAPABILITIES_STEPS_IN_A_ROW_H

#include <cstddef>
#include <memory>
#include <span>

#include "master/engine/port/capability.h"
#include "master/engine/port/unit.h"

namespace stride::core {

/// Units that step one right after the other, with nothing between them.
class UnitRow {
 public:
  /// How far the units have come where one of them requests something, does not reach the end of
  /// the step, or throws an exception.
  struct Progress {
    /// So many of them, from the first on, have just reached the end of the step.
    std::size_t plain = 0;
    /// How the step of the next one has ended, if it did not throw; those behind it have not been
    /// called.
    StepResult result{};
  };

  virtual ~UnitRow() = default;

  virtual std::size_t size() const = 0;
  /// Makes the step of each unit as Unit::step() does, with the values that it has been given, up
  /// to the first one that requests something, or does not reach the end of the step. Returns
  /// whether there is none; else, and where it throws what the unit's own step would, the progress
  /// says how far the units have come.
  virtual bool step(const StepInterval& interval, Progress& progress) = 0;
  /// To be called before its units step on several threads: from now on, and until the next step of
  /// the row, nothing that is noted here belongs to one of them.
  virtual void release() {}
};

/// Of a unit whose steps cost less where they are made so.
class StepsInARow : public Capability {
 public:
  static constexpr CapabilityId kId = CapabilityId::StepsInARow;

  /// What a step exchanges with a unit; both must outlive the row.
  struct Member {
    Unit* unit;
    StepValues values;
  };

  /// A row of as many of the members as can be in one, from the first one on: one at least. Null if
  /// the first one cannot, as where it is not this unit but a decorator of it.
  virtual std::unique_ptr<UnitRow> make_row(std::span<const Member> members) = 0;
};

}  // namespace stride::core

#endif
