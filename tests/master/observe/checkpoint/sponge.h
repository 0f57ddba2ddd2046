// A unit that forgets nothing: what it does next depends on each call that it ever had.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_CHECKPOINT_SPONGE_H
#define STRIDE_TESTS_MASTER_OBSERVE_CHECKPOINT_SPONGE_H

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "master/observe/checkpoint/answer_check.h"
#include "tests/master/engine/run/scripted_unit.h"
#include "tests/master/engine/run/unit_capabilities.h"

namespace stride::tests {

/// Which capabilities a Sponge has, and how it misbehaves.
struct SpongeTraits {
  bool saves = true;
  bool serializes = false;
  bool has_one_slot = false;          ///< and says so by std::logic_error
  bool fails_to_serialize = false;    ///< always
  bool serializes_sometimes = false;  ///< as its state says
  bool asks_for_inputs = false;
  bool rejects = false;
  bool is_concurrent = false;
  bool is_random = false;       ///< it does not repeat itself
  bool is_random_late = false;  ///< likewise, from 1 s on
  bool fails_when_repeated = false;
  bool does_not_restore = false;  ///< and says nothing
};

/// Inputs u (three numbers), n, s and b, a message m at the clock c, a countdown clock; outputs y,
/// z and t, all made of a hash over all calls and their values. Even its getters are calls, but for
/// one that serialises its state, whose outputs are read then.
class Sponge final : public core::Unit,
                     public core::ConfigurationMode,
                     public core::StateSaving,
                     public core::StateSerialization,
                     public core::Resetting,
                     public core::IdlePromises,
                     public core::ClockIntervals,
                     public core::InputsWithinStep,
                     public core::UnitDiagnostics,
                     public core::ConcurrentSteps {
 public:
  using References = std::span<const core::ValueReference>;
  using Log = std::vector<std::string>;

  static std::shared_ptr<const core::UnitDescription> description() {
    using core::Causality;
    using core::ValueType;
    const auto described = core::Describe("sponge")
                               .input("u")
                               .size(3)
                               .add("n", ValueType::Int32, Causality::Input)
                               .add("s", ValueType::String, Causality::Input)
                               .add("b", ValueType::Binary, Causality::Input)
                               .size(2)
                               .clock("c", core::IntervalVariability::Triggered)
                               .add("m", ValueType::Binary, Causality::Input)
                               .clocked_by(4)
                               .clock("countdown", core::IntervalVariability::Countdown)
                               .output("y")
                               .size(9)
                               .add("z", ValueType::Int64, Causality::Output)
                               .add("t", ValueType::String, Causality::Output)
                               .add("structural", ValueType::UInt64, Causality::StructuralParameter)
                               .event_mode()
                               .can_save_state()
                               .may_return_early()
                               .done();
    auto description = std::make_shared<core::UnitDescription>(*described);
    description->variables[0].intermediate_update = true;
    return description;
  }

  explicit Sponge(SpongeTraits traits, Log* log = nullptr) : traits_(traits), log_(log) {}

  // ---- Calls ----

  void enter_configuration_mode() override { absorb("configure"); }
  void exit_configuration_mode() override { absorb("configured"); }
  void enter_initialization(Time start, std::optional<Time> stop) override {
    absorb("initialize");
    absorb(start);
    absorb(stop.value_or(Time::min()));
  }
  void exit_initialization() override { absorb("initialized"); }
  void get(References references, core::ValueBlock& values) override {
    const checkpoint::AnswerCheck before = hash_;
    absorb("get");
    absorb(references);
    core::visit(values, [&](auto elements) {
      for (auto& element : elements) squeeze(element);
    });
    if (traits_.serializes) hash_ = before;
  }
  void set(References references, const core::ValueBlock& values) override {
    absorb("set");
    absorb(references);
    hash_.add(values);
  }
  core::StepResult step(const core::StepInterval& interval) override {
    absorb("step");
    absorb(interval.from);
    absorb(interval.to);
    hash_.add(interval.may_go_back_before ? 1U : 0U);
    const bool is_random = traits_.is_random || (traits_.is_random_late && interval.to > kLate);
    if (is_random) hash_.add(std::random_device()());
    if (traits_.fails_when_repeated && is_repeating_) {
      core::fail_run({.unit = "sponge", .time = interval.from}, "it is tired");
    }
    log("step");
    for (int i = 0; update_ && traits_.asks_for_inputs && i < 3; ++i) {
      const double share = static_cast<double>(draw() % 5) / 4;
      update_(share * interval.size_seconds);
    }
    if (traits_.rejects && draw() % 4 == 0) return {.rejected = true, .reached = interval.from};
    core::StepResult result{.reached = interval.to};
    if (draw() % 4 == 0) {
      result.early_return = true;
      result.reached = interval.from + (interval.to - interval.from) / 3;
    }
    result.event_handling_needed = draw() % 3 == 0;
    return result;
  }
  using core::Unit::step;
  void begin_step(const core::StepInterval& interval, const core::StepValues& values,
                  const Extras& extras) override {
    for (const core::BoundValues& input : values.inputs) set(input.references, *input.block);
    if (extras.saves_state) save_state();
    begun_ = interval;
    outputs_ = values.outputs;
  }
  core::StepResult finish_step() override { return core::Unit::step(*begun_, {{}, outputs_}); }
  std::chrono::nanoseconds step_time() const override { return {}; }
  void enter_event_mode() override { absorb("event"); }
  core::EventResult update_discrete_states() override {
    absorb("update");
    core::EventResult result;
    result.discrete_states_need_update = draw() % 4 == 0;
    if (draw() % 2 == 0) result.next_event_time = Time(Duration(draw() % 1000));
    return result;
  }
  void enter_step_mode() override { absorb("step mode"); }
  void terminate() override {}

  void enable_idle_skipping(Duration skip) override {
    absorb("skip");
    hash_.add(static_cast<std::uint64_t>(skip.count()));
  }
  void set_idle_tolerances(References outputs, std::span<const double> tolerances) override {
    absorb("tolerances");
    absorb(outputs);
    hash_.add(std::as_bytes(tolerances));
  }
  Time idle_until() override { return Time(Duration(hash_.hash() % 1000)); }
  void get_derivatives(References, std::span<double> derivatives) override {
    for (double& derivative : derivatives) derivative = static_cast<double>(hash_.byte());
  }
  core::ClockInterval clock_interval(const core::Variable& clock) override {
    absorb("interval");
    hash_.add(clock.reference);
    return {core::ClockInterval::State::Changed, core::Interval::from_fraction(draw() % 99, 100)};
  }
  core::Interval clock_shift(const core::Variable& clock) override {
    absorb("shift");
    hash_.add(clock.reference);
    return core::Interval::from_fraction(draw() % 99, 100);
  }
  void set_input_update(core::InputUpdate update) override { update_ = std::move(update); }

  // ---- States ----

  void save_state() override { slots_[slot_] = hash_; }
  void restore_state() override {
    if (!traits_.does_not_restore) hash_ = slots_.at(slot_).value();
  }
  void select_state(std::size_t slot) override {
    if (traits_.has_one_slot) throw std::logic_error("this kind of unit keeps one state only");
    slot_ = slot;
  }
  std::vector<std::uint8_t> serialize_state() override {
    const std::uint64_t hash = slots_.at(slot_).value().hash();
    if (traits_.fails_to_serialize || (traits_.serializes_sometimes && is_awake_)) {
      core::fail_run({.unit = "sponge"}, "it cannot be serialised now");
    }
    std::vector<std::uint8_t> bytes(sizeof hash);
    std::memcpy(bytes.data(), &hash, sizeof hash);
    return bytes;
  }
  void deserialize_state(std::span<const std::uint8_t> bytes) override {
    std::uint64_t hash = 0;
    if (bytes.size() != sizeof hash) core::fail_run({.unit = "sponge"}, "another size");
    std::memcpy(&hash, bytes.data(), sizeof hash);
    slots_[slot_] = checkpoint::AnswerCheck(hash);
  }
  void reset() override {}

  std::string rejection_reason() const override { return ""; }
  std::uint64_t calls() const override { return calls_; }
  void set_repeating(bool repeating) override { is_repeating_ = repeating; }

  /// From now on it can be serialised, or cannot; with `serializes_sometimes`.
  void wake(bool is_awake) { is_awake_ = is_awake; }

 private:
  static constexpr Time kLate = Time(std::chrono::seconds(1));

  core::Capability* find_capability(core::CapabilityId id) override {
    if (id == core::StateSaving::kId && !traits_.saves) return nullptr;
    if (id == core::StateSerialization::kId && !traits_.serializes) return nullptr;
    if (id == core::InputsWithinStep::kId && !traits_.asks_for_inputs) return nullptr;
    if (id == core::ConcurrentSteps::kId && !traits_.is_concurrent) return nullptr;
    return core::select_capability<core::ConfigurationMode, core::StateSaving,
                                   core::StateSerialization, core::Resetting, core::IdlePromises,
                                   core::ClockIntervals, core::InputsWithinStep,
                                   core::UnitDiagnostics, core::ConcurrentSteps>(*this, id);
  }

  void absorb(const char* call) {
    ++calls_;
    hash_.add(std::as_bytes(std::span(call, std::strlen(call))));
  }
  void absorb(Time time) { hash_.add(static_cast<std::uint64_t>(time.time_since_epoch().count())); }
  void absorb(References references) { hash_.add(std::as_bytes(references)); }
  /// Small numbers, as if drawn.
  std::uint32_t draw() {
    hash_.add(1U);
    return static_cast<std::uint32_t>(hash_.hash() >> 40);
  }
  template <class T>
  void squeeze(T& element) {
    if constexpr (std::is_same_v<T, bool>) {
      element = draw() % 2 != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
      element = static_cast<T>(draw() % 100);
    } else {
      element = T(draw() % 20, 'x');
    }
  }
  void log(const char* text) {
    if (log_ != nullptr && !is_repeating_) log_->push_back(text);
  }

  SpongeTraits traits_;
  Log* log_;
  checkpoint::AnswerCheck hash_;
  std::map<std::size_t, std::optional<checkpoint::AnswerCheck>> slots_;
  std::size_t slot_ = 0;
  bool is_awake_ = false;
  bool is_repeating_ = false;
  std::uint64_t calls_ = 0;
  core::InputUpdate update_;
  std::optional<core::StepInterval> begun_;
  std::span<const core::BoundValues> outputs_;
};

}  // namespace stride::tests

#endif
