#ifndef STRIDE_MASTER_ENGINE_PORT_FORWARDING_UNIT_H
#define STRIDE_MASTER_ENGINE_PORT_FORWARDING_UNIT_H

#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "master/engine/port/unit.h"

namespace stride::core {

/// Base of decorators: forwards all calls and all capabilities to the decorated unit. A decorator
/// that intercepts a capability implements its interface and overrides one function:
///
///   core::Capability* find_capability(core::CapabilityId id) override {
///     return find_decorated<core::StateSaving, core::Resetting>(*this, id);
///   }
class ForwardingUnit : public Unit {
 public:
  void enter_initialization(Time start, std::optional<Time> stop) override {
    unit_->enter_initialization(start, stop);
  }
  void exit_initialization() override { unit_->exit_initialization(); }
  void get(std::span<const ValueReference> references, ValueBlock& values) override {
    unit_->get(references, values);
  }
  void set(std::span<const ValueReference> references, const ValueBlock& values) override {
    unit_->set(references, values);
  }
  StepResult step(const StepInterval& interval) override { return unit_->step(interval); }
  StepResult step(const StepInterval& interval, const StepValues& values) override {
    return unit_->step(interval, values);
  }
  void enter_event_mode() override { unit_->enter_event_mode(); }
  EventResult update_discrete_states() override { return unit_->update_discrete_states(); }
  void enter_step_mode() override { unit_->enter_step_mode(); }
  void terminate() override { unit_->terminate(); }
  void free() override { unit_->free(); }

 protected:
  explicit ForwardingUnit(std::unique_ptr<Unit> unit) : unit_(std::move(unit)) {}

  Unit& inner() { return *unit_; }
  /// For a decorator that has to act after the unit is destroyed; no call may follow.
  void destroy_inner() { unit_.reset(); }

  Capability* find_capability(CapabilityId id) override { return unit_->capability(id); }

  /// The decorator's own implementation of those Cs that the unit has; of all else, the unit's.
  template <CapabilityInterface... Cs, class Decorator>
  static Capability* find_decorated(Decorator& decorator, CapabilityId id) {
    Capability* const found = decorator.inner().capability(id);
    Capability* const own = select_capability<Cs...>(decorator, id);
    return found != nullptr && own != nullptr ? own : found;
  }

 private:
  std::unique_ptr<Unit> unit_;
};

}  // namespace stride::core

#endif
