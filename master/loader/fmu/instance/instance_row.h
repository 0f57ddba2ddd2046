// Instances of units that step in a row.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_INSTANCE_ROW_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_INSTANCE_ROW_H

#include <cstdint>
#include <span>

#include <stride/time.h>

#include "master/loader/fmu/instance/present_call.h"

namespace stride::importer {

/// What is known of a row's instances, and not noted of each one yet: the steps that all of them
/// have just made since settle(). An instance adds it to what it knows of itself, and settles
/// before anything is done with it alone.
class InstanceRow {
 public:
  std::uint64_t steps() const noexcept { return steps_; }
  /// Where the last one began and ended, if there are some.
  Time from() const noexcept { return from_; }
  Time to() const noexcept { return to_; }
  const RowCall& present() const noexcept { return present_; }

  /// Notes them of each instance.
  virtual void settle() noexcept = 0;

 protected:
  explicit InstanceRow(std::span<PresentCall* const> members) : present_(members) {}
  ~InstanceRow() = default;

  void add_step(Time from, Time to) noexcept {
    ++steps_;
    from_ = from;
    to_ = to;
  }
  void forget_steps() noexcept { steps_ = 0; }

  RowCall present_;

 private:
  std::uint64_t steps_ = 0;
  Time from_{}, to_{};
};

}  // namespace stride::importer

#endif
