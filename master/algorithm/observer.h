// What is told to those who watch a run: recorders, progress, checks.
#ifndef STRIDE_MASTER_ALGORITHM_OBSERVER_H
#define STRIDE_MASTER_ALGORITHM_OBSERVER_H

#include <cstdint>
#include <span>
#include <string_view>

#include <stride/time.h>

#include "master/model/values.h"
#include "master/model/variable_id.h"

namespace stride::core {

/// Where an observed variable's present value stands: `variable.size` elements of the block from
/// `first` on. Valid and kept up to date for the whole run.
struct Signal {
  VariableId id;
  const ValueBlock* block = nullptr;
  std::size_t first = 0;
};

/// A clock that ticked, with the values that it carries. A message is seen twice: where it is sent,
/// and at each component that receives it.
struct Message {
  Time time;
  std::uint32_t index = 0;  ///< the super-dense index: which event iteration at this time
  VariableId id;            ///< the clocked variable, or the clock itself if it carries none
  bool received = false;
  const ValueBlock* block = nullptr;  ///< null for a bare clock
  std::size_t first = 0;
  /// What a Binary value says, in the words of its component (Unit::describe_message()) or else of
  /// one that it is wired to, in one line of kLongestContent characters at most. Empty where none
  /// says anything, and where no observer wants to know. Valid during the call.
  std::string_view content{};
};

inline constexpr std::size_t kLongestContent = 200;

/// Something that a component did beside ordinary steps.
struct Activity {
  enum class Kind : std::uint8_t {
    Idle,         ///< the master left it alone, since it promised to be idle
    Event,        ///< it was in Event Mode
    EarlyReturn,  ///< its step ended before the end that it was given
    Rejection,    ///< it refused a step, which would have gone to `until`
    Undone        ///< its step was undone, because of another component or an input's error
  };
  std::size_t component = 0;
  Kind kind = Kind::Event;
  Time from;
  Time until;  ///< the same instant for an event
  bool operator==(const Activity&) const = default;
};

/// Called from the thread that runs the simulation, in simulated order. An observer may throw
/// core::Error to end the run.
class Observer {
 public:
  virtual ~Observer() = default;

  /// Before the first communication point. The signals are those that the observer was added with
  /// (Simulation::add_observer), or else RunOptions::recorded, in that order.
  virtual void on_start(std::span<const Signal> /*signals*/) {}
  /// Whether messages are to come with their content, for which units have to be asked.
  virtual bool wants_content() const { return false; }
  virtual void on_message(const Message& /*message*/) {}
  /// Asked once, before the run: whether it wants to hear of activities.
  virtual bool watches_activities() const { return false; }
  /// Each is told when it is over, in an order that does not depend on threads; what lasts until
  /// the run ends, well or not, is told then.
  virtual void on_activity(const Activity& /*activity*/) {}
  /// The initial instant, and each communication point once all values and events are exchanged.
  virtual void on_communication_point(Time /*time*/) {}
  /// The run is over, well or not; what was recorded must be complete on disk when this returns.
  virtual void on_finish() {}
};

}  // namespace stride::core

#endif
