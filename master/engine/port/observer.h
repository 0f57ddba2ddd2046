// The interface of observers of a run: recorders, progress, checks.
#ifndef STRIDE_MASTER_ENGINE_PORT_OBSERVER_H
#define STRIDE_MASTER_ENGINE_PORT_OBSERVER_H

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/values.h"
#include "master/engine/model/variable_id.h"

namespace stride::core {

/// The current value of an observed variable: `variable.size` elements of the block from `first`
/// on. Valid and kept up to date for the whole run.
struct Signal {
  VariableId id;
  const ValueBlock* block = nullptr;
  std::size_t first = 0;
};

/// A clock that ticked, with the values that it carries. A message is reported where it is sent,
/// and at each component that receives it.
struct Message {
  Time time;
  std::uint32_t index = 0;  ///< the super-dense index: which event iteration at this time
  VariableId id;            ///< the clocked variable, or the clock itself if it carries none
  bool received = false;
  const ValueBlock* block = nullptr;  ///< null for a bare clock
  std::size_t first = 0;
  /// The content of a Binary value as text, from its component (MessageText::describe_message()) or
  /// else from one that it is connected to, in one line of at most kLongestContent characters.
  /// Empty where no component describes it, and where no observer needs it. Valid during the call.
  std::string_view content{};
};

inline constexpr std::size_t kLongestContent = 200;

/// An activity of a component other than an ordinary step.
struct Activity {
  enum class Kind : std::uint8_t {
    Idle,         ///< it was suspended, since it promised to be idle
    Event,        ///< it was in Event Mode
    EarlyReturn,  ///< its step ended before the target
    Rejection,    ///< it rejected a step to `until`
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
  /// Whether on_message() needs Message::content, which units have to provide.
  virtual bool wants_content() const { return false; }
  virtual void on_message(const Message& /*message*/) {}
  /// The run's options have changed a variable, or the messages that it receives, at an instant and
  /// its super-dense index; `text` says how, such as "set to 3 V" (Intervention).
  virtual void on_intervention(Time /*time*/, std::uint32_t /*index*/, VariableId /*id*/,
                               std::string_view /*text*/) {}
  /// Whether on_activity() is to be called. Read once, before the run.
  virtual bool watches_activities() const { return false; }
  /// Called when the activity is over, in an order that does not depend on threads; at the end of
  /// the run, successful or not, for activities that last until then.
  virtual void on_activity(const Activity& /*activity*/) {}
  /// At the start time, and at each communication point, after its events.
  virtual void on_communication_point(Time /*time*/) {}
  /// The run is over, successful or not; records must be complete on disk when this returns.
  virtual void on_finish() {}
};

/// Reports activities to the observers that watch them. Without such an observer a report is one
/// comparison.
class Activities {
 public:
  void add(Observer& observer) {
    if (observer.watches_activities()) watchers_.push_back(&observer);
  }
  void report(const Activity& activity) const {
    for (Observer* watcher : watchers_) watcher->on_activity(activity);
  }

 private:
  std::vector<Observer*> watchers_;
};

}  // namespace stride::core

#endif
