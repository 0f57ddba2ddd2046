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

/// Notes what is done at `now` while `work` does it.
template <class Work>
decltype(auto) noted(isolation::SharedNote& note, Time now, const char* name, Work&& work) {
  note.write(name, now.time_since_epoch().count());
  struct End {
    isolation::SharedNote& note;
    ~End() { note.clear(); }
  } end{note};
  return work();
}

bool is_fmi2(const TestedUnit& tested) { return tested.description().fmi_version.starts_with("2"); }

std::unique_ptr<core::Unit> instantiate(const TestedUnit& tested, isolation::SharedNote& note,
                                        const std::string& name,
                                        importer::InstanceOptions options) {
  note.write("the loading of its library", 0);
  tested.fmu().load_library();
  return noted(note, {}, is_fmi2(tested) ? "fmi2Instantiate" : "fmi3InstantiateCoSimulation",
               [&] { return tested.fmu().instantiate(name, std::move(options)); });
}

}  // namespace

template <class Work>
decltype(auto) WatchedUnit::watched(const char* function, Work&& work) {
  char name[64];
  std::snprintf(name, sizeof name, "%s%s", is_fmi2_ ? "fmi2" : "fmi3", function);
  return noted(note_, now_, name, std::forward<Work>(work));
}

WatchedUnit::WatchedUnit(const TestedUnit& tested, isolation::SharedNote& note,
                         const std::string& name, importer::InstanceOptions options)
    : ForwardingUnit(instantiate(tested, note, name, std::move(options))),
      note_(note),
      is_fmi2_(is_fmi2(tested)),
      configuration_(inner().capability<core::ConfigurationMode>()),
      state_(inner().capability<core::StateSaving>()),
      serialization_(inner().capability<core::StateSerialization>()),
      resetting_(inner().capability<core::Resetting>()),
      intervals_(inner().capability<core::ClockIntervals>()),
      text_(inner().capability<core::MessageText>()) {}

WatchedUnit::~WatchedUnit() {
  watched("FreeInstance", [&] { destroy_inner(); });
}

core::Capability* WatchedUnit::find_capability(core::CapabilityId id) {
  return find_decorated<core::ConfigurationMode, core::StateSaving, core::StateSerialization,
                        core::Resetting, core::ClockIntervals, core::MessageText>(*this, id);
}

void WatchedUnit::enter_configuration_mode() {
  watched("EnterConfigurationMode", [&] { configuration_->enter_configuration_mode(); });
}

void WatchedUnit::exit_configuration_mode() {
  watched("ExitConfigurationMode", [&] { configuration_->exit_configuration_mode(); });
}

void WatchedUnit::enter_initialization(Time start, std::optional<Time> stop) {
  now_ = start;
  watched("EnterInitializationMode", [&] { inner().enter_initialization(start, stop); });
}

void WatchedUnit::exit_initialization() {
  watched("ExitInitializationMode", [&] { inner().exit_initialization(); });
}

void WatchedUnit::get(std::span<const core::ValueReference> references, core::ValueBlock& values) {
  watched(Accessor("Get", values.type(), is_fmi2_).text, [&] { inner().get(references, values); });
}

void WatchedUnit::set(std::span<const core::ValueReference> references,
                      const core::ValueBlock& values) {
  watched(Accessor("Set", values.type(), is_fmi2_).text, [&] { inner().set(references, values); });
}

core::StepResult WatchedUnit::step(const core::StepInterval& interval) {
  now_ = interval.from;
  const core::StepResult result = watched("DoStep", [&] { return inner().step(interval); });
  now_ = result.reached;
  return result;
}

void WatchedUnit::save_state() {
  watched(is_fmi2_ ? "GetFMUstate" : "GetFMUState", [&] { state_->save_state(); });
}

void WatchedUnit::restore_state() {
  watched(is_fmi2_ ? "SetFMUstate" : "SetFMUState", [&] { state_->restore_state(); });
}

std::vector<std::uint8_t> WatchedUnit::serialize_state() {
  return watched(is_fmi2_ ? "SerializeFMUstate" : "SerializeFMUState",
                 [&] { return serialization_->serialize_state(); });
}

void WatchedUnit::deserialize_state(std::span<const std::uint8_t> bytes) {
  watched(is_fmi2_ ? "DeSerializeFMUstate" : "DeserializeFMUState",
          [&] { serialization_->deserialize_state(bytes); });
}

void WatchedUnit::reset() {
  watched("Reset", [&] { resetting_->reset(); });
}

void WatchedUnit::enter_event_mode() {
  watched("EnterEventMode", [&] { inner().enter_event_mode(); });
}

core::EventResult WatchedUnit::update_discrete_states() {
  return watched("UpdateDiscreteStates", [&] { return inner().update_discrete_states(); });
}

void WatchedUnit::enter_step_mode() {
  watched("EnterStepMode", [&] { inner().enter_step_mode(); });
}

core::ClockInterval WatchedUnit::clock_interval(const core::Variable& clock) {
  return watched("GetInterval", [&] { return intervals_->clock_interval(clock); });
}

core::Interval WatchedUnit::clock_shift(const core::Variable& clock) {
  return watched("GetShift", [&] { return intervals_->clock_shift(clock); });
}

std::string WatchedUnit::describe_message(core::ValueReference variable,
                                          const core::Binary& value) {
  return noted(note_, now_, "strideDescribeMessage",
               [&] { return text_->describe_message(variable, value); });
}

void WatchedUnit::terminate() {
  watched("Terminate", [&] { inner().terminate(); });
}

}  // namespace stride::verify
