// Units that step in a row, and go back to where their states were not saved.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_COASTING_ROW_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_COASTING_ROW_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "master/engine/port/capabilities/steps_in_a_row.h"
#include "master/engine/run/stepping/coasting_unit.h"
#include "master/engine/run/stepping/row_log.h"
#include "master/engine/run/stepping/save_interval.h"

namespace stride::core {

/// CoastingUnit::save_and_step() of units that step in a row. What they are given is noted for all
/// of them at once, which costs less than to save even a small state; their states are saved before
/// the same step, mostly. In such a step each unit is called by itself, in all others the row is.
///
/// Where anything else is asked of a unit, it takes over what is noted of it here, and leaves the
/// row. It joins again in the next step of the row, and is saved there by itself if it has to be
/// earlier than the others, such as behind an event.
class CoastingRow : public UnitRow {
 public:
  struct Member {
    CoastingUnit* unit;
    StepValues values;
  };

  /// `row` has the units that the members decorate. They must outlive this object.
  CoastingRow(std::unique_ptr<UnitRow> row, std::span<const Member> members);
  ~CoastingRow() override;

  std::size_t size() const override { return members_.size(); }
  bool step(const StepInterval& interval, Progress& progress) override;
  void release() override;

  // For its units:
  const RowLog& log() const { return log_; }
  /// One of them has left what is noted here.
  void note_departure() { settled_until_ = 0; }
  /// Whether to save the states of units costs less than that they take over so many steps each.
  bool is_save_cheaper(std::size_t steps) const {
    return interval_.is_save_cheaper(steps * members_.size());
  }
  /// One of them is taken back. Counts once in a step of the row.
  void count_rollback();

 private:
  SaveInterval interval_of(std::span<const Member> members) const;
  bool are_all_due() const;
  void settle();
  bool step_unsettled(const StepInterval& interval, Progress& progress);
  void step_next(std::size_t stretch, const StepInterval& interval, Progress& progress);
  void step_next_measured(std::size_t stretch, const StepInterval& interval, Progress& progress);
  bool conclude(const Progress& progress);

  std::unique_ptr<UnitRow> row_;
  std::vector<Member> members_;
  RowLog log_;
  SaveInterval interval_;
  std::uint64_t settled_until_ = 0;  ///< up to this position there is nothing but to note steps
  std::uint64_t steps_ = 0;
  std::uint64_t rolled_back_ = 0;  ///< the last of them that was
};

}  // namespace stride::core

#endif
