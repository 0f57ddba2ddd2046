// A scripted unit that steps in rows.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_ROW_UNIT_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_ROW_UNIT_H

#include <memory>
#include <span>
#include <vector>

#include "master/engine/port/capabilities/steps_in_a_row.h"
#include "tests/master/engine/run/scripted_unit.h"

namespace stride::core {

/// Steps in a row with all of its kind that come after it.
class RowUnit : public ScriptedUnit, public StepsInARow {
 public:
  using ScriptedUnit::ScriptedUnit;

  int sets = 0;
  int rows = 0;  ///< steps of a row that begins with it

  void set(std::span<const ValueReference> references, const ValueBlock& values) override {
    ++sets;
    ScriptedUnit::set(references, values);
  }
  std::unique_ptr<UnitRow> make_row(std::span<const Member> members) override {
    auto row = std::make_unique<Row>();
    for (const Member& member : members) {
      if (dynamic_cast<RowUnit*>(member.unit) == nullptr) break;
      row->members.push_back(member);
    }
    row->first = this;
    return row;
  }

 private:
  struct Row : UnitRow {
    std::vector<Member> members;
    RowUnit* first;

    std::size_t size() const override { return members.size(); }
    bool step(const StepInterval& interval, Progress& progress) override {
      ++first->rows;
      for (const Member& member : members) {
        progress.result = member.unit->step(interval, member.values);
        if (!progress.result.reached_without_request(interval.to)) return false;
        ++progress.plain;
      }
      return true;
    }
  };

  Capability* find_capability(CapabilityId id) override {
    if (id == StepsInARow::kId) return static_cast<StepsInARow*>(this);
    return ScriptedUnit::find_capability(id);
  }
};

}  // namespace stride::core

#endif
