// Whether a unit keeps a promise to be idle (<stride/idle.h>).
#ifndef STRIDE_TESTS_PROPERTY_PROMISE_H
#define STRIDE_TESTS_PROPERTY_PROMISE_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "master/loader/fmu/fmu.h"
#include "tests/master/engine/run/unit_capabilities.h"

namespace stride::tests {

/// A single unit that is stepped and handles its events; its messages are not received.
class SteppedUnit {
 public:
  using Settings = std::vector<std::pair<std::string, std::string>>;

  /// In Step Mode at 0 s, with its first event handled. Without max_skip skipping stays off.
  SteppedUnit(std::shared_ptr<importer::Fmu> fmu, const Settings& settings,
              std::optional<Duration> max_skip);

  Time now() const { return now_; }
  core::Unit& unit() { return *unit_; }
  const core::UnitDescription& description() const { return *fmu_->description(); }

  void set(const std::string& name, const std::string& text);
  void set(const core::Variable& variable, double value);
  core::ValueBlock get(const core::Variable& variable);
  /// The first derivatives of an output with a tolerance, element by element.
  std::vector<double> slopes(const core::Variable& variable);

  /// One step, not more; a step that is rejected leaves the unit where it is.
  core::StepResult step(Time to);
  /// Goes through the Event Mode that a step asked for.
  void handle_event();
  /// To `to` by steps of at most `step`, with events.
  void advance(Time to, Duration step);
  /// Until when it promises to be idle; now() if it does not.
  Time promise();

 private:
  void handle_events();

  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
  Time now_{};
  std::optional<Time> next_event_;
};

/// Three equal units at the same time. The promise is checked by one step over all of it, by small
/// steps, and by small steps with skipping off. In small steps the inputs vary within their
/// deadbands.
struct PromiseCheck {
  SteppedUnit single_step, small_steps, no_skipping;
  std::uint64_t seed;        ///< of the steps and the inputs
  Time until = Time::max();  ///< the promise is checked up to here at most

  /// What was broken: the output or the step, and when; empty if nothing was. `promised` is until
  /// when there was a promise.
  std::string run(Time& promised);
};

}  // namespace stride::tests

#endif
