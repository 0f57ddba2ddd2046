#include <functional>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

using core::ValueReference;
using core::Variable;

enum class State { Instantiated, Initialization, StepMode, EventMode, Terminated };
constexpr const char* kStateNames[] = {"Instantiated", "Initialization Mode", "Step Mode",
                                       "Event Mode", "Terminated"};

/// A new instance in a state.
TestInstance instance_in(const Trial& trial, State state) {
  TestInstance instance = trial.make_instance();
  if (state == State::Instantiated) return instance;
  instance.set_start_values();
  instance.enter_initialization();
  if (state == State::Initialization) return instance;
  instance.exit_initialization();
  instance.run_to(3);
  if (state == State::EventMode) instance.unit().enter_event_mode();
  if (state == State::Terminated) instance.terminate();
  return instance;
}

/// A call that is not allowed in a state (FMI 3.0, 2.3 and 4.2; FMI 2.0, 4.2.4).
struct Offence {
  std::string function;
  State state;
  std::function<void(TestInstance&)> commit;
};

ValueReference unused_reference(const core::UnitDescription& unit) {
  ValueReference reference = 0;
  for (const Variable& variable : unit.variables) {
    reference = std::max(reference, variable.reference);
  }
  return reference + 1;
}

void step(TestInstance& instance) {
  instance.unit().step({instance.now(), instance.now() + std::chrono::milliseconds(1)});
}

std::vector<Offence> offences_of_any_unit() {
  return {
      {"DoStep", State::Instantiated, step},
      {"DoStep", State::Initialization, step},
      {"DoStep", State::Terminated, step},
      {"ExitInitializationMode", State::Instantiated,
       [](TestInstance& instance) { instance.unit().exit_initialization(); }},
      {"ExitInitializationMode", State::StepMode,
       [](TestInstance& instance) { instance.unit().exit_initialization(); }},
      {"EnterInitializationMode", State::StepMode,
       [](TestInstance& instance) { instance.unit().enter_initialization({}, std::nullopt); }},
      {"Terminate", State::Instantiated, [](TestInstance& instance) { instance.terminate(); }},
  };
}

/// Of a unit with Event Mode.
void add_event_mode(std::vector<Offence>& list) {
  list.push_back({"DoStep", State::EventMode, step});
  list.push_back({"EnterEventMode", State::Instantiated,
                  [](TestInstance& instance) { instance.unit().enter_event_mode(); }});
  list.push_back({"UpdateDiscreteStates", State::StepMode,
                  [](TestInstance& instance) { instance.unit().update_discrete_states(); }});
  list.push_back({"EnterStepMode", State::StepMode,
                  [](TestInstance& instance) { instance.unit().enter_step_mode(); }});
}

void add_unknown_reference(std::vector<Offence>& list, ValueReference unknown) {
  list.push_back({"GetBoolean of a value reference that no variable has", State::StepMode,
                  [unknown](TestInstance& instance) {
                    core::ValueBlock value(core::ValueType::Boolean, 1);
                    instance.unit().get({&unknown, 1}, value);
                  }});
  list.push_back({"SetBoolean of a value reference that no variable has", State::StepMode,
                  [unknown](TestInstance& instance) {
                    const core::ValueBlock value(core::ValueType::Boolean, 1);
                    instance.unit().set({&unknown, 1}, value);
                  }});
}

std::vector<Offence> offences(const TestedUnit& tested) {
  const core::UnitDescription& unit = tested.description();
  std::vector<Offence> list = offences_of_any_unit();
  if (unit.has_event_mode) add_event_mode(list);
  if (unit.fmi_version.starts_with("1.")) {  // which has no Initialization Mode
    std::erase_if(list, [](const Offence& offence) {
      return offence.function == "ExitInitializationMode" || offence.state == State::Initialization;
    });
  }
  // before FMI 3.0 the importer numbers the variables
  if (unit.fmi_version.starts_with("3")) add_unknown_reference(list, unused_reference(unit));
  return list;
}

/// "refused", "accepted", or how it ended.
std::string consequence(const Trial& trial, const Offence& offence) {
  try {
    return trial.in_child([&] {
      TestInstance instance = instance_in(trial, offence.state);
      try {
        offence.commit(instance);
        return std::string("accepted");
      } catch (const core::Error&) {
        return std::string("refused");
      }
    });
  } catch (const Failure& failure) {
    return failure.what();
  }
}

/// An instance may be freed in each state.
std::size_t end_everywhere(const Trial& trial) {
  std::size_t count = 0;
  for (const State state : {State::Instantiated, State::Initialization, State::StepMode,
                            State::EventMode, State::Terminated}) {
    if (state == State::EventMode && !trial.tested.description().has_event_mode) continue;
    trial.in_child([&] {
      instance_in(trial, state);
      return std::string();
    });
    ++count;
  }
  return count;
}

}  // namespace

Finding check_calls(const Trial& trial) {
  const std::size_t ends = end_everywhere(trial);
  // the standard demands an error only where one is detected, as our own kit does, so only that can
  // fail
  const bool is_of_kit = trial.is_of_kit();
  std::vector<std::string> notes;
  const std::vector<Offence> list = offences(trial.tested);
  for (const Offence& offence : list) {
    const std::string seen = consequence(trial, offence);
    if (seen == "refused") continue;
    std::string text =
        fmt::format("{} in the state {}: {}", trial.tested.function(offence.function),
                    kStateNames[static_cast<std::size_t>(offence.state)], seen);
    if (is_of_kit) return failed(std::move(text));
    notes.push_back(std::move(text));
  }
  return passed(fmt::format("a whole life, {} ways to end it; {} of {} calls out of order are "
                            "refused",
                            ends, list.size() - notes.size(), list.size()),
                std::move(notes));
}

}  // namespace stride::verify
