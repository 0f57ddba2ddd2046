// Random calls of a unit, in the order in which a run makes them.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_CHECKPOINT_DRIVER_H
#define STRIDE_TESTS_MASTER_OBSERVE_CHECKPOINT_DRIVER_H

#include <algorithm>
#include <deque>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/base/time_text.h"
#include "tests/master/engine/run/unit_capabilities.h"

namespace stride::tests {

/// What a run is besides its units: a copy of it goes on with another unit by the same calls.
class Driver {
 public:
  using Values = std::vector<std::pair<std::string, std::string>>;

  Driver(std::shared_ptr<const core::UnitDescription> description, unsigned seed)
      : description_(std::move(description)), random_(seed) {
    for (const core::Variable& variable : description_->variables) {
      const bool is_value = variable.is_unclocked_value();
      if (is_value && variable.causality == core::Causality::Input) inputs_.push_back(&variable);
      if (is_value && variable.causality == core::Causality::Output) outputs_.push_back(&variable);
    }
  }

  bool goes_back = true;         ///< it rolls back now and then, if the unit can
  Values structure;              ///< values of structural parameters
  std::vector<std::string> got;  ///< all that the unit has answered

  /// Configuration, start values, idle skipping, initialization, first events.
  void start(core::Unit& unit, const Values& values = {}) {
    connect(unit);
    configure(unit);
    if (auto* const idle = unit.capability<core::IdlePromises>()) {
      idle->enable_idle_skipping(Duration(12345));
    }
    for (const auto& [name, text] : values) set(unit, variable(name), text);
    for (const core::Variable* input : inputs_) set_random(unit, *input);
    unit.enter_initialization(time_, Time(std::chrono::seconds(1000)));
    read(unit);
    ask_clocks(unit, true);
    unit.exit_initialization();
    if (!description_->has_event_mode) return;
    iterate(unit);
  }
  /// What a run does with a new unit before it reads its state.
  void connect(core::Unit& unit) {
    exchange_ = std::make_shared<Exchange>();
    for (const core::Variable* input : inputs_) exchange_->inputs.add(*input);
    for (const core::Variable* output : outputs_) exchange_->outputs.add(*output);
    auto* const within = unit.capability<core::InputsWithinStep>();
    if (within == nullptr) return;
    within->set_input_update([this, &unit](double) {
      for (const core::Variable* input : inputs_) {
        if (input->intermediate_update) set_random(unit, *input);
      }
    });
  }

  void advance(core::Unit& unit, int steps) {
    auto* const state = goes_back ? unit.capability<core::StateSaving>() : nullptr;
    for (int i = 0; i < steps; ++i) {
      Time to = time_ + Duration(1'000'000'000 * static_cast<std::int64_t>(1 + draw(3)));
      const bool saves = draw(2) == 0 && state != nullptr;
      const Time from = time_;
      core::StepResult result = step(unit, to, saves);
      while (saves && (result.rejected || draw(3) == 0)) {
        state->restore_state();
        time_ = from;
        to = from + (to - from) / 2;
        result = step(unit, to, false);
      }
      if (result.event_handling_needed || draw(6) == 0) handle_events(unit);
      read(unit);
    }
  }
  Time time() const { return time_; }

 private:
  /// Blocks that stay where they are.
  struct Blocks {
    void add(const core::Variable& variable) {
      core::ValueBlock& block = blocks.emplace_back(variable.type, variable.size);
      bound.emplace_back(std::span(&variable.reference, 1), block);
    }
    std::deque<core::ValueBlock> blocks;
    std::vector<core::BoundValues> bound;
  };
  struct Exchange {
    Blocks inputs, outputs;
  };

  unsigned draw(unsigned below) { return static_cast<unsigned>(random_() % below); }
  const core::Variable& variable(const std::string& name) const {
    return description_->variables.at(description_->find(name).value());
  }
  void set(core::Unit& unit, const core::Variable& variable, const std::string& text) {
    unit.set({&variable.reference, 1}, core::parse(variable, text));
  }
  void configure(core::Unit& unit) {
    auto* const configuration = unit.capability<core::ConfigurationMode>();
    if (configuration == nullptr) return;
    configuration->enter_configuration_mode();
    for (const auto& [name, text] : structure) set(unit, variable(name), text);
    configuration->exit_configuration_mode();
  }

  /// Numbers that often are those of before.
  core::ValueBlock random_values(const core::Variable& variable) {
    core::ValueBlock values(variable.type, variable.size);
    core::visit(values, [&]<class T>(std::span<T> elements) {
      for (T& element : elements) {
        const unsigned number = draw(3);
        if constexpr (std::is_same_v<T, bool>) {
          element = number == 1;
        } else if constexpr (std::is_arithmetic_v<T>) {
          element = static_cast<T>(variable.items.empty() ? number : variable.items[0].second);
        } else {
          element = T(number, 'a');
        }
      }
    });
    return values;
  }
  void set_random(core::Unit& unit, const core::Variable& variable) {
    unit.set({&variable.reference, 1}, random_values(variable));
  }

  core::StepResult step(core::Unit& unit, Time to, bool saves) {
    Exchange& exchange = *exchange_;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const core::ValueBlock values = random_values(*inputs_[i]);
      core::copy_elements(exchange.inputs.blocks[i], 0, values, 0, values.size());
    }
    const core::StepValues values{exchange.inputs.bound, exchange.outputs.bound};
    const core::StepResult result = make_step(unit, {time_, to}, values, saves);
    note(fmt::format("step {} {} {} {}", result.rejected, result.early_return,
                     result.event_handling_needed, core::to_text(result.reached)));
    if (result.rejected) return result;
    for (const auto& block : exchange.outputs.blocks) note(core::elements_text(block));
    time_ = result.reached;
    return result;
  }
  core::StepResult make_step(core::Unit& unit, const core::StepInterval& interval,
                             const core::StepValues& values, bool saves) {
    auto* const concurrent = unit.capability<core::ConcurrentSteps>();
    if (draw(2) == 0 && concurrent != nullptr) {
      concurrent->begin_step(interval, values, {.saves_state = saves});
      return concurrent->finish_step();
    }
    if (saves) state(unit).save_state();
    return unit.step(interval, values);
  }

  void handle_events(core::Unit& unit) {
    if (!description_->has_event_mode) return;
    unit.enter_event_mode();
    for (const core::Variable& variable : description_->variables) {
      const bool is_input = variable.causality == core::Causality::Input;
      if (!is_input || variable.type != core::ValueType::Clock || draw(2) == 0) continue;
      tick(unit, variable);
    }
    iterate(unit);
  }
  void tick(core::Unit& unit, const core::Variable& clock) {
    core::ValueBlock ticks(core::ValueType::Clock, clock.size);
    ticks.numbers<bool>()[0] = true;
    unit.set({&clock.reference, 1}, ticks);
    for (const core::Variable& message : description_->variables) {
      const bool is_input = message.causality == core::Causality::Input;
      if (is_input && message.belongs_to(clock.reference)) set_random(unit, message);
    }
  }
  void iterate(core::Unit& unit) {
    for (int i = 0; i < 10; ++i) {
      read(unit);
      const core::EventResult result = unit.update_discrete_states();
      note(result.next_event_time ? core::to_text(*result.next_event_time) : "no event");
      ask_clocks(unit, false);
      if (!result.discrete_states_need_update) break;
    }
    unit.enter_step_mode();
  }
  void ask_clocks(core::Unit& unit, bool is_start) {
    auto* const clocks = unit.capability<core::ClockIntervals>();
    if (clocks == nullptr) return;
    for (const core::Variable& variable : description_->variables) {
      if (!variable.is_time_based_clock() || variable.clock->interval) continue;
      const core::ClockInterval answer = clocks->clock_interval(variable);
      note(
          fmt::format("interval {} {}", static_cast<int>(answer.state), answer.interval.seconds()));
      if (is_start && variable.clock->is_periodic()) {
        note(fmt::format("shift {}", clocks->clock_shift(variable).seconds()));
      }
    }
  }
  void read(core::Unit& unit) {
    for (const core::Variable* output : outputs_) {
      core::ValueBlock values(output->type, output->size);
      unit.get({&output->reference, 1}, values);
      note(core::elements_text(values));
    }
  }
  void note(std::string text) { got.push_back(std::move(text)); }

  std::shared_ptr<const core::UnitDescription> description_;
  std::mt19937 random_;
  std::vector<const core::Variable*> inputs_, outputs_;
  std::shared_ptr<Exchange> exchange_;  ///< with the unit that was connected last
  Time time_{};
};

/// Shows the first difference only.
inline void check_same(const std::vector<std::string>& one, const std::vector<std::string>& other) {
  const auto [a, b] = std::ranges::mismatch(one, other);
  INFO("line " << a - one.begin() << " of " << one.size());
  CHECK((a == one.end() ? "" : *a) == (b == other.end() ? "" : *b));
  CHECK(one.size() == other.size());
}

}  // namespace stride::tests

#endif
