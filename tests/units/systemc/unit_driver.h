// Drives a unit of the kit through its C++ interface, as an importer does through FMI's.
#ifndef STRIDE_TESTS_UNITS_SYSTEMC_UNIT_DRIVER_H
#define STRIDE_TESTS_UNITS_SYSTEMC_UNIT_DRIVER_H

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <stride/unit.h>

#include "interfaces/unit/idle_settings.h"
#include "interfaces/unit/table.h"

namespace stride::tests {

class UnitDriver {
 public:
  explicit UnitDriver(std::unique_ptr<Unit> unit) : unit_(std::move(unit)) {
    unit_->set_logger(
        [this](Severity severity, const std::string& text) { log.emplace_back(severity, text); });
  }

  template <class T>
  T& value(const std::string& name) {
    return *static_cast<T*>(const_cast<void*>(row(name).data));
  }
  const Variable& row(const std::string& name) const {
    for (const Variable& row : unit_->variables()) {
      if (row.name == name) return row;
    }
    throw std::out_of_range("no variable " + name);
  }

  /// Before initialize().
  void enable_skipping(Duration max_skip = Duration::max()) {
    kit::IdleSettings(*unit_, table_).enable(max_skip);
  }

  void initialize(Time start = {}) {
    now_ = start;
    unit_->initialize(start);
  }

  /// Returns the instant that it reached.
  Time step(Time to, bool may_return_early = false) {
    Step step(now_, to, may_return_early);
    unit_->step(step);
    terminates_ |= step.terminates();
    needs_event_ = step.event_needed();
    return now_ = step.reached().value_or(to);
  }

  void event() {
    Event event(now_);
    unit_->event(event);
    terminates_ |= event.terminates();
  }
  /// The last step has ended for an event.
  bool needs_event() const { return needs_event_; }
  /// The unit has requested the end of the simulation.
  bool terminates() const { return terminates_; }

  Time idle_until() const { return unit_->idle_until(now_); }
  Time now() const { return now_; }
  Unit& unit() { return *unit_; }

  std::vector<std::pair<Severity, std::string>> log;

 private:
  std::unique_ptr<Unit> unit_;
  double seconds_ = 0;
  kit::Table table_{*unit_, seconds_};
  Time now_;
  bool terminates_ = false;
  bool needs_event_ = false;
};

}  // namespace stride::tests

#endif
