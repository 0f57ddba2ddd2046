// One instance of the unit, simulated from point to point of the grid with a stimulus.
#ifndef STRIDE_MASTER_STUDY_VERIFY_TEST_INSTANCE_H
#define STRIDE_MASTER_STUDY_VERIFY_TEST_INSTANCE_H

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/unit.h"
#include "master/engine/run/events/clocks.h"
#include "master/loader/fmu/instance/call_note.h"
#include "master/study/verify/recording.h"
#include "master/study/verify/stimulus.h"
#include "master/study/verify/tested_unit.h"

namespace stride::verify {

/// How a step of the grid is cut into communication steps. The inputs change at the grid alone.
enum class Split {
  None,
  Halves,
  Uneven,
  Random,  ///< unevenly, or not at all, by chance
};

struct TestInstanceOptions {
  std::string name = "unit";
  bool early_return_allowed = true;
  Split split = Split::None;
  std::uint64_t seed = 0;  ///< of all that is random; 0 = that of the request
  std::shared_ptr<const Stimulus> stimulus = nullptr;  ///< null: an ordinary one of that seed
};

/// Call order: {start(), run_to() with ascending points} again after each reset(). Throws Failure
/// where the unit does what no unit may, core::Error where it fails.
class TestInstance {
 public:
  /// In `note` is the function of the unit that is being called. `tested` and `note` must outlive
  /// this object.
  TestInstance(const TestedUnit& tested, importer::CallNote& note,
               TestInstanceOptions options = {});

  core::Unit& unit() { return *units_.front(); }
  /// A capability that the unit has by its description.
  template <core::CapabilityInterface C>
  C& capability() {
    return unit().require_capability<C>();
  }
  Time now() const { return position_.now; }
  /// The last point of the grid that was reached.
  std::size_t at() const { return position_.point; }
  /// What happened since the last start; its rows and steps are those of run_to(… , true).
  const Recording& recording() const { return recording_; }
  /// Drops the rows and steps up to here.
  void clear_recorded();
  /// Clocks that tick are recorded, as run_to(… , true) does.
  void record_from_here() { records_ = true; }

  /// Sets the start values and goes through initialization and the first events.
  void start();
  /// The same in parts, to look at the unit in between.
  void set_start_values();
  void enter_initialization();
  void exit_initialization();

  /// To the communication point k, unless the unit requests the end of the simulation before.
  void run_to(std::size_t k, bool records = true);
  /// Its two parts, of the way to the next point: sets the inputs of the point that was reached, in
  /// Event Mode where that is due; and makes the step.
  void hand_over_inputs();
  void step_to_next_point();
  /// What run_to() records at the point that was reached.
  void record_point();
  /// One step to the point k, with the inputs as they are; false if it was rejected.
  bool leap_to(std::size_t k);
  /// One communication step with the inputs as they are, and the events at its end; false if it was
  /// rejected, in which case nothing has changed.
  bool try_step(Time to);
  /// Event Mode at this instant, with the inputs of point k where it is given.
  void handle_events(std::optional<std::size_t> k = std::nullopt);

  /// The iterations of Event Mode, and back to Step Mode.
  void finish_events();

  void terminate() { unit().terminate(); }
  /// Resets the unit and this object.
  void reset();

  std::vector<std::string> observe();
  core::ValueBlock get(const core::Variable& variable);
  void set(const core::Variable& variable, const core::ValueBlock& value);

  /// What belongs to the instance beside its unit's state.
  struct Position {
    Time now{};
    std::size_t point = 0;
    std::optional<Time> next_event;
  };
  const Position& position() const { return position_; }
  /// Keeps the unit's state and the position in a slot, and goes back there.
  void save(std::size_t slot);
  void restore(std::size_t slot);
  /// After the unit itself got a state of another instance at this position. `clocks` may be null
  /// for a unit without time-based clocks.
  void set_position(const Position& position, const core::Clocks* clocks);
  const core::Clocks& clocks() const { return *clocks_; }

 private:
  struct Saved {  // by slot
    Position position;
    std::optional<core::Clocks> clocks;
  };

  void advance(Time to);
  void shorten(Time to);
  void record_step(const core::StepResult& result);
  void set_inputs(std::size_t k, bool continuous_only);
  void set_clocked_inputs(std::size_t k);
  std::vector<Time> targets(std::size_t k) const;
  bool is_event_due();
  void tick_triggered(std::size_t k);
  bool ticks(core::ValueReference clock) const;
  void record_ticks();

  const TestedUnit& tested_;
  TestInstanceOptions options_;
  std::uint64_t seed_;
  std::shared_ptr<const Stimulus> stimulus_;
  std::vector<std::unique_ptr<core::Unit>> units_;  ///< one
  std::optional<core::Clocks> clocks_;              ///< new with each start
  std::vector<core::ValueBlock> blocks_;            ///< for the groups of TestedUnit::observed()
  std::vector<core::ValueReference> ticking_;       ///< input clocks in this super-dense instant
  Position position_;
  Recording recording_;
  bool records_ = false;
  std::vector<Saved> saved_;
};

}  // namespace stride::verify

#endif
