#include "master/verify/watched_unit.h"

#include <cstdio>
#include <utility>

namespace stride::verify {
namespace {

/// "GetFloat64" with the name that a type has in each version of the standard.
struct Accessor {
  char text[32];
  Accessor(const char* verb, core::ValueType type, bool is_fmi2) {
    using core::ValueType;
    const char* name = core::name(type);
    if (type == ValueType::Enumeration) name = is_fmi2 ? "Integer" : "Int64";
    if (is_fmi2 && type == ValueType::Float64) name = "Real";
    if (is_fmi2 && type == ValueType::Int32) name = "Integer";
    std::snprintf(text, sizeof text, "%s%s", verb, name);
  }
};

}  // namespace

template <class Work>
decltype(auto) WatchedUnit::watched(const char* function, Work&& work) {
  char name[64];
  std::snprintf(name, sizeof name, "%s%s", is_fmi2_ ? "fmi2" : "fmi3", function);
  return noted(name, std::forward<Work>(work));
}

template <class Work>
decltype(auto) WatchedUnit::noted(const char* name, Work&& work) {
  note_.write(name, now_.time_since_epoch().count());
  struct End {
    process::SharedNote& note;
    ~End() { note.clear(); }
  } end{note_};
  return work();
}

WatchedUnit::WatchedUnit(const TestedUnit& tested, process::SharedNote& note,
                         const std::string& name, fmi::InstanceOptions options)
    : tested_(tested), note_(note), is_fmi2_(tested.description().fmi_version.starts_with("2")) {
  note_.write("the loading of its library", 0);
  tested_.fmu().load_library();
  unit_ = watched(is_fmi2_ ? "Instantiate" : "InstantiateCoSimulation",
                  [&] { return tested_.fmu().instantiate(name, std::move(options)); });
}

WatchedUnit::~WatchedUnit() {
  watched("FreeInstance", [&] { unit_.reset(); });
}

void WatchedUnit::enter_configuration_mode() {
  watched("EnterConfigurationMode", [&] { unit_->enter_configuration_mode(); });
}

void WatchedUnit::exit_configuration_mode() {
  watched("ExitConfigurationMode", [&] { unit_->exit_configuration_mode(); });
}

void WatchedUnit::enter_initialization(Time start, std::optional<Time> stop) {
  now_ = start;
  watched("EnterInitializationMode", [&] { unit_->enter_initialization(start, stop); });
}

void WatchedUnit::exit_initialization() {
  watched("ExitInitializationMode", [&] { unit_->exit_initialization(); });
}

void WatchedUnit::get(std::span<const core::ValueReference> references, core::ValueBlock& values) {
  watched(Accessor("Get", values.type(), is_fmi2_).text, [&] { unit_->get(references, values); });
}

void WatchedUnit::set(std::span<const core::ValueReference> references,
                      const core::ValueBlock& values) {
  watched(Accessor("Set", values.type(), is_fmi2_).text, [&] { unit_->set(references, values); });
}

core::StepResult WatchedUnit::step(const core::StepInterval& interval) {
  now_ = interval.from;
  const core::StepResult result = watched("DoStep", [&] { return unit_->step(interval); });
  now_ = result.reached;
  return result;
}

void WatchedUnit::save_state() {
  watched(is_fmi2_ ? "GetFMUstate" : "GetFMUState", [&] { unit_->save_state(); });
}

void WatchedUnit::restore_state() {
  watched(is_fmi2_ ? "SetFMUstate" : "SetFMUState", [&] { unit_->restore_state(); });
}

std::vector<std::uint8_t> WatchedUnit::serialize_state() {
  return watched(is_fmi2_ ? "SerializeFMUstate" : "SerializeFMUState",
                 [&] { return unit_->serialize_state(); });
}

void WatchedUnit::deserialize_state(std::span<const std::uint8_t> bytes) {
  watched(is_fmi2_ ? "DeSerializeFMUstate" : "DeserializeFMUState",
          [&] { unit_->deserialize_state(bytes); });
}

void WatchedUnit::reset() {
  watched("Reset", [&] { unit_->reset(); });
}

void WatchedUnit::enter_event_mode() {
  watched("EnterEventMode", [&] { unit_->enter_event_mode(); });
}

core::EventResult WatchedUnit::update_discrete_states() {
  return watched("UpdateDiscreteStates", [&] { return unit_->update_discrete_states(); });
}

void WatchedUnit::enter_step_mode() {
  watched("EnterStepMode", [&] { unit_->enter_step_mode(); });
}

core::ClockInterval WatchedUnit::clock_interval(const core::Variable& clock) {
  return watched("GetInterval", [&] { return unit_->clock_interval(clock); });
}

core::Interval WatchedUnit::clock_shift(const core::Variable& clock) {
  return watched("GetShift", [&] { return unit_->clock_shift(clock); });
}

std::string WatchedUnit::describe_message(core::ValueReference variable,
                                          const core::Binary& value) {
  return noted("strideDescribeMessage", [&] { return unit_->describe_message(variable, value); });
}

void WatchedUnit::terminate() {
  watched("Terminate", [&] { unit_->terminate(); });
}

}  // namespace stride::verify
