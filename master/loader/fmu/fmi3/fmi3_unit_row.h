// A row of units of FMI 3.0.
#ifndef STRIDE_MASTER_LOADER_FMU_FMI3_FMI3_UNIT_ROW_H
#define STRIDE_MASTER_LOADER_FMU_FMI3_FMI3_UNIT_ROW_H

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "master/loader/fmu/fmi3/fmi3_unit.h"
#include "master/loader/fmu/instance/instance_row.h"

namespace stride::importer {

/// What a unit step needs is close together, and no unit is touched but by its own code.
class Fmi3Unit::Row final : public core::UnitRow, public InstanceRow {
 public:
  /// Of members that can be in it.
  explicit Row(std::span<const Member> members);
  ~Row();

  std::size_t size() const override { return members_.size(); }
  bool step(const core::StepInterval& interval, Progress& progress) override;
  void release() noexcept override { settle(); }
  void settle() noexcept override;

 private:
  struct Block {
    const fmi3ValueReference* references = nullptr;
    double* values = nullptr;
    std::uint32_t count = 0, size = 0;  ///< of references, which are none if there is no block
  };
  struct InRow {
    fmi3Instance instance;
    const Fmi3Functions* functions;
    Fmi3Unit* unit;
    const LeftCall* left;
    Block input, output;
    core::ProcessorMode::Signals signals;  ///< behind its last step
    bool may_go_back;
    bool drifts = false;  ///< from the ends of steps, as has been said of it
  };
  /// The calls of a unit step, up to one of them.
  enum class Stage : std::uint8_t { Set, Step, Get };
  /// The last one, and what it has answered.
  struct Answer {
    Stage stage;
    Status status;
    StepAnswer step;
  };
  /// Looks at the mode of the processor behind a unit.
  struct ModeCheck {
    [[gnu::always_inline]] ~ModeCheck() {
      member.signals.note();
      if (!row.mode_.is_almost_present()) [[unlikely]]
        member.unit->restore_mode("fmi3DoStep");
      core::ProcessorMode::empty_registers();
    }
    const Row& row;
    InRow& member;
  };

  static std::vector<PresentCall*> present_calls(std::span<const Member> members);
  Block block(std::span<const core::BoundValues> blocks);
  bool is_quick(const core::StepInterval& interval) const {
    const double sum = interval.begin_seconds + interval.size_seconds;
    return !is_watched_ && interval.size_seconds > 0 && sum <= stop_seconds_;
  }
  /// Whether a step that ended at this time of the unit's own needs no further look.
  static bool is_usual_end(const InRow& member, const core::StepInterval& interval, double seconds,
                           double tolerance) {
    constexpr double kMost = 9e6;  // it is a Time
    return is_end(interval, seconds, tolerance) || (member.drifts && std::abs(seconds) < kMost);
  }
  bool step_singly(const core::StepInterval& interval, Progress& progress);
  bool step_quickly(InRow& member, const core::StepInterval& interval, double tolerance,
                    core::StepResult& result);
  template <class Function, class... Arguments>
  Status call(const InRow& member, Stage stage, Function* function, Arguments... arguments);
  Status set(const InRow& member);
  Status do_step(const InRow& member, const core::StepInterval& interval, StepAnswer& answer);
  Status get(const InRow& member);
  bool go_on(InRow& member, const core::StepInterval& interval, Answer answer,
             core::StepResult& result);
  core::StepResult end_step(InRow& member, const core::StepInterval& interval,
                            const Answer& answer);
  void look_closely(const InRow& member, Stage stage);
  void note_steps(std::size_t first, std::size_t last, std::uint64_t steps, Time from, Time to);
  void conclude(const InRow* last, Progress& progress);
  bool has_usual_signals(const InRow& member) const { return member.signals == mode_.signals(); }
  void restore_signals(std::size_t stepped);

  const core::ProcessorMode mode_;
  std::vector<fmi3ValueReference> references_;
  std::vector<InRow> members_;
  std::vector<core::StepValues> values_;
  bool is_watched_ = true;   ///< some are closely watched, and step as if each were alone
  double stop_seconds_ = 0;  ///< the earliest of the units; known when they have stepped
  // of the present step:
  Time from_now_{}, to_now_{};
  bool is_close_ = false;    ///< what is made in it is noted of each unit
  std::size_t noted_ = 0;    ///< so many of the members have a step that is
  std::uint64_t calls_ = 0;  ///< likewise, of the next one
};

}  // namespace stride::importer

#endif
