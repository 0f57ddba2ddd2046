// A SystemC device as a unit: derive from DeviceUnit, make the device, and say what goes in and
// out.
//
//   class Blinker : public stride::systemc::DeviceUnit<BlinkerModule> {
//    public:
//     Blinker() : DeviceUnit("A blinker") {
//       input("supply", supply_).unit("V");
//       output("lit", lit_).discrete();
//     }
//
//    private:
//     std::unique_ptr<Device> make_device(Log log) override {
//       return std::make_unique<Device>(std::move(log), "blinker");
//     }
//     void write_inputs(BlinkerModule& blinker) override { blinker.supply.write(supply_); }
//     void read_outputs(BlinkerModule& blinker) override { lit_ = blinker.lit.read(); }
//     double supply_ = 0;
//     bool lit_ = false;
//   };
//   STRIDE_UNIT(Blinker)
#ifndef STRIDE_UNITS_SYSTEMC_UNIT_H
#define STRIDE_UNITS_SYSTEMC_UNIT_H

#include <deque>
#include <memory>
#include <string>
#include <utility>

#include <stride/unit.h>

#include "units/systemc/device.h"

namespace stride::systemc {

/// Messages that wait for their tick: a clock ticks once at a super-dense instant, so each further
/// message of the same instant, or of a step that could not stop early, takes one more.
class MessageOutput {
 public:
  MessageOutput(Binary& value, Clock& clock) : value_(value), clock_(clock) {}

  void push(Binary message) { waiting_.push_back(std::move(message)); }
  void clear() { waiting_.clear(); }
  bool empty() const { return waiting_.empty(); }

  /// Puts out the next message, if there is one, and ticks.
  void publish() {
    if (waiting_.empty()) return;
    value_ = std::move(waiting_.front());
    waiting_.pop_front();
    clock_.tick();
  }

 private:
  Binary& value_;
  Clock& clock_;
  std::deque<Binary> waiting_;
};

/// The device's own time starts at zero where the simulation starts. A device that calls sc_pause
/// asks for a communication point at that instant, and gets it if the master allows early return.
///
/// SystemC cannot save its state, so a device unit cannot be rolled back by itself.
template <class Module>
class DeviceUnit : public Unit {
 public:
  void initialize(Time start) final {
    start_ = start;
    device_.reset();
    device_ = make_device([this](sc_core::sc_severity severity, const std::string& message) {
      log(severity == sc_core::SC_INFO ? Severity::Info : Severity::Warning, message);
    });
    settle();
  }

  void step(Step& step) final {
    device_->within([this](Module& module) { write_inputs(module); });
    Time reached = device_->advance(device_->now());
    if (!step.early_return_allowed() || !has_message()) {
      reached = device_->advance(to_device(step.to()), step.early_return_allowed());
    }
    device_->within([this](Module& module) { read_outputs(module); });
    publish();
    if (to_master(reached) < step.to()) step.return_early(to_master(reached));
  }

  void event(Event&) final {
    device_->within([this](Module& module) { receive(module); });
    settle();
    publish();
  }

  void update_outputs() final { settle(); }

 protected:
  using Device = systemc::Device<Module>;
  using Log = Kernel::Log;

  explicit DeviceUnit(std::string description) {
    describe(std::move(description)).early_return = true;
  }

  /// Called at each initialization, with the parameters in their members.
  virtual std::unique_ptr<Device> make_device(Log log) = 0;
  /// Hands inputs to the module and fetches outputs from it.
  virtual void write_inputs(Module& module) = 0;
  virtual void read_outputs(Module& module) = 0;
  /// Takes up the messages whose clocks have ticked.
  virtual void receive(Module& /*module*/) {}
  /// Ticks output clocks, a message each.
  virtual void publish() {}
  /// Whether publish() has something to do. The inputs of a step may cause a message where the step
  /// begins; the step then ends there, too, if it may.
  virtual bool has_message() const { return false; }

  Time to_device(Time time) const { return Time(time - start_); }
  Time to_master(Time time) const { return start_ + time.time_since_epoch(); }

 private:
  /// Lets the device take up its inputs at the instant where it is.
  void settle() {
    device_->within([this](Module& module) { write_inputs(module); });
    device_->advance(device_->now());
    device_->within([this](Module& module) { read_outputs(module); });
  }

  Time start_;
  std::unique_ptr<Device> device_;
};

}  // namespace stride::systemc

#endif
