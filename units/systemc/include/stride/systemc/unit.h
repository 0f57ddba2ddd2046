// A SystemC device as a unit: derive from DeviceUnit, make the device, and list what goes in and
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
#ifndef STRIDE_SYSTEMC_UNIT_H
#define STRIDE_SYSTEMC_UNIT_H

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <stride/systemc/device.h>
#include <stride/systemc/idle.h>
#include <stride/systemc/message.h>
#include <stride/systemc/trace.h>
#include <stride/unit.h>

namespace stride::systemc {

/// The device's own time starts at zero where the simulation starts. A device that calls sc_pause
/// asks for a communication point at that instant, and gets it if the master allows early return.
/// One that calls sc_stop has finished: the unit requests the end of the simulation there.
///
/// Every device has the parameters `trace.file`, relative to the unit's own folder of results
/// (stride::Setup), and `trace.signals`; see trace.h. One that declares
/// what idle means has its idle time skipped where the importer enables it, and can be suspended
/// while its outputs keep their tangents; see <stride/idle.h> and idle.h.
///
/// SystemC cannot save its state, so a device unit cannot be rolled back by itself; in a process of
/// its own `stride` takes it back by snapshots of that.
template <class Module>
class DeviceUnit : public Unit {
 public:
  void initialize(Time start) final {
    start_ = start;
    trace_.reset();
    skipper_.reset();
    device_.reset();
    device_ = make_device([this](sc_core::sc_severity severity, const std::string& message) {
      log(severity == sc_core::SC_INFO ? Severity::Info : Severity::Warning, message);
    });
    make_skipper();
    if (!trace_options_.file.empty()) open_trace();
    settle();
  }

  void step(Step& step) final {
    begin_step(step);
    hand_over_inputs();
    Time reached = device_->advance(device_->now());
    if (!step.early_return_allowed() || !wants_to_stop()) {
      reached = advance(to_device(step.to()), step.early_return_allowed());
    }
    device_->within([this](Module& module) { read_outputs(module); });
    publish();
    if (has_finished()) step.terminate_simulation();
    if (step.early_return_allowed() && to_master(reached) < step.to()) {
      // where a step began it ends for an event only (FMI 3.0, 2.4.7)
      if (to_master(reached) == step.from()) step.need_event();
      step.return_early(to_master(reached));
    }
  }

  void event(Event& event) final {
    device_->within([this](Module& module) { receive(module); });
    settle();
    publish();
    if (has_finished()) event.terminate_simulation();
  }

  void update_outputs() final { settle(); }

  void terminate() final {
    end();
    report_skips();
    trace_.reset();
  }

  Time idle_until(Time now) const final {
    if (has_message() || device_->kernel().stopped() || !skipper_->has_settled()) return now;
    return device_->within([&](const Module& module) {
      if (!inputs_are_taken_up() || !idle(module)) return now;
      return std::min(later(now, tangents_hold_for(module)), next_happening(module));
    });
  }

 protected:
  using Device = systemc::Device<Module>;
  using Log = Kernel::Log;

  explicit DeviceUnit(std::string description) {
    describe(std::move(description)).early_return = true;
    parameter("trace.file", trace_options_.file)
        .description("VCD file of the device's signals; none if empty");
    parameter("trace.signals", trace_options_.signals)
        .description("which of them: patterns with * and ?, separated by spaces");
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
  /// Whether publish() has something to do.
  virtual bool has_message() const { return false; }
  /// Whether the inputs of a step have caused something where the step begins that other units need
  /// to see there, as a message is; the step then ends there, too, if it may.
  virtual bool wants_to_stop() const { return has_message(); }

  /// The signals that `trace.signals` chooses from: by default all that trace.h finds by itself.
  virtual void list_signals(const Module& module, SignalList& signals) const {
    signals.add_all_within(module);
  }

  /// Called before the inputs of a step are handed over.
  virtual void begin_step(const Step& /*step*/) {}
  /// Called where the simulation ends.
  virtual void end() {}
  Kernel& kernel() { return device_->kernel(); }

  // What idle means. The first is enough for a device whose clocks stand still while it is idle.

  /// To be called in the constructor if idle() can be true.
  void may_idle() { describe(info().description).promises_idle = true; }
  /// With the inputs as they are, nothing happens by itself until the next Timer: no command is
  /// queued, no frame on the air, no wait(time) or delayed notification is pending. Clocks may go
  /// on.
  virtual bool idle(const Module& /*module*/) const { return false; }
  /// The period of the clocks that go on meanwhile (the least common multiple of several).
  virtual Duration clock_period(const Module& /*module*/) const { return {}; }
  /// Closes the time that has been skipped for what the device adds up cycle by cycle, along the
  /// rate that it has now: `charge += current * to_seconds(skipped)`.
  virtual void on_skip(Module& /*module*/, Duration /*skipped*/) {}
  /// Whether a skip needs a clock period that has left the module as it was, see StateWatch: then
  /// on_skip() has nothing to do.
  virtual bool is_watched() const { return false; }
  /// For how long on_skip() is good enough; see tangent_holds_for().
  virtual Duration longest_skip(const Module& /*module*/) const { return Duration::max(); }
  /// For how long, while it is idle, each output stays within its tolerance of its tangent, those
  /// without a tolerance what they are. Zero is not a promise; the next Timer ends one by itself.
  virtual Duration tangents_hold_for(const Module& /*module*/) const { return {}; }

  Time to_device(Time time) const { return Time(time - start_); }
  Time to_master(Time time) const { return start_ + time.time_since_epoch(); }

 private:
  class Rules final : public IdleRules {
   public:
    explicit Rules(DeviceUnit& unit) : unit_(unit) {}
    bool idle() const override { return unit_.idle(module()); }
    Duration clock_period() const override { return unit_.clock_period(module()); }
    Duration longest_skip() const override { return unit_.longest_skip(module()); }
    void on_skip(Duration skipped) override { unit_.on_skip(module(), skipped); }
    void write_inputs() const { unit_.write_inputs(module()); }

   private:
    Module& module() const { return unit_.device_->module(); }
    DeviceUnit& unit_;
  };

  Time advance(Time to, bool may_stop_early) {
    if (!max_skip()) return device_->advance(to, may_stop_early);
    return skipper_->advance(to, may_stop_early, *max_skip());
  }

  void hand_over_inputs() {
    device_->within([this](Module& module) { write_inputs(module); });
    inputs_since_ = simulated();
  }

  /// The device has called sc_stop, and all that it has sent is out.
  bool has_finished() const { return device_->kernel().stopped() && !has_message(); }

  /// Lets the device take up its inputs at the instant where it is.
  void settle() {
    hand_over_inputs();
    device_->advance(device_->now());
    device_->within([this](Module& module) { read_outputs(module); });
  }

  /// The device has them (a signal that is written with what it holds asks for no update), and a
  /// clock that goes on has had an edge at which to sample them.
  bool inputs_are_taken_up() const {
    rules_.write_inputs();
    return device_->kernel().at_rest() &&
           simulated() - inputs_since_ >= clock_period(device_->module());
  }

  /// What SystemC has simulated, from the start on.
  Duration simulated() const {
    return device_->now().time_since_epoch() - device_->kernel().skipped();
  }

  /// A clock that goes on does not count.
  Time next_happening(const Module& module) const {
    Kernel& kernel = device_->kernel();
    const Duration period = clock_period(module);
    std::optional<Time> next = period == Duration{} ? kernel.next_event() : kernel.next_timer();
    if (period > Duration{}) {
      const auto pending = kernel.unclocked_notifications(period);
      if (pending) next = std::min(next.value_or(pending->first), pending->first);
    }
    return next ? to_master(*next) : Time::max();
  }

  void make_skipper() {
    std::optional<StateWatch> watch;
    if (max_skip() && is_watched()) {
      device_->within([&](const Module& module) { watch.emplace(module); });
    }
    skipper_.emplace(device_->kernel(), rules_, std::move(watch));
  }

  void open_trace() {
    SignalList signals;
    device_->within([&](Module& module) { list_signals(module, signals); });
    const std::string file = (results() / trace_options_.file).string();
    trace_.emplace(device_->kernel(), TraceOptions{file, trace_options_.signals}, signals);
  }

  void report_skips() {
    if (!max_skip() || !skipper_) return;
    log(Severity::Info, to_text(skipper_->statistics()));
    if (skipper_->obstacle()) {
      log(Severity::Warning, obstacle_text(to_master(*skipper_->obstacle())));
    }
    if (const auto& unrest = skipper_->unrest()) {
      log(Severity::Warning, unrest_text({to_master(unrest->when), unrest->place}));
    }
  }

  Time start_;
  Duration inputs_since_{};  ///< what was simulated when they were handed over
  Rules rules_{*this};
  TraceOptions trace_options_;
  std::unique_ptr<Device> device_;
  std::optional<IdleSkipper> skipper_;
  std::optional<Trace> trace_;  // closed before the device is destroyed
};

}  // namespace stride::systemc

#endif
