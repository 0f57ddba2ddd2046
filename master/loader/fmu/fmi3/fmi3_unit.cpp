#include "master/loader/fmu/fmi3/fmi3_unit.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace stride::importer {
namespace {

/// The getter and setter of a C type. Enumerations travel as Int64.
template <class T>
struct Access;
#define STRIDE_ACCESS(T)                                  \
  template <>                                             \
  struct Access<fmi3##T> {                                \
    static constexpr const char* kGetName = "fmi3Get" #T; \
    static constexpr const char* kSetName = "fmi3Set" #T; \
    static constexpr auto kGet = &Fmi3Functions::Get##T;  \
    static constexpr auto kSet = &Fmi3Functions::Set##T;  \
  };
FMI3_VALUE_TYPES(STRIDE_ACCESS)
#undef STRIDE_ACCESS

/// The inputs that may be set within a step.
std::vector<core::ValueReference> intermediate_inputs(const core::UnitDescription& description) {
  std::vector<core::ValueReference> references;
  if (!description.provides_intermediate_update) return references;
  for (const core::Variable& variable : description.variables) {
    const bool is_input = variable.causality == core::Causality::Input &&
                          variable.variability == core::Variability::Continuous;
    if (is_input && variable.intermediate_update) references.push_back(variable.reference);
  }
  return references;
}

}  // namespace

// ---- Life cycle ----

Fmi3Unit::Fmi3Unit(std::string name, std::shared_ptr<const Fmi3Library> library, UnitParts parts,
                   InstanceOptions options)
    : FmuInstance("fmi3", library, std::move(name), std::move(parts), std::move(options)),
      fmi_(library->functions()),
      library_(std::move(library)),
      tangent_outputs_(tangent_outputs(*parts_.description)) {
  const core::UnitDescription& description = *parts_.description;
  const bool has_resources = !parts_.resources.empty();
  std::vector<core::ValueReference> intermediate;
  if (options_.intermediate_update) intermediate = intermediate_inputs(description);
  instantiate_by("fmi3InstantiateCoSimulation", [&] {
    return fmi_.InstantiateCoSimulation(
        name_.c_str(), description.instantiation_token.c_str(),
        has_resources ? parts_.resources.c_str() : nullptr, fmi3False, options_.debug_logging,
        description.has_event_mode, options_.early_return_allowed, intermediate.data(),
        intermediate.size(), environment(), &on_log,
        intermediate.empty() ? nullptr : &on_intermediate_update);
  });
}

Fmi3Unit::~Fmi3Unit() {
  free_or_warn([this] { Fmi3Unit::free(); });
}

void Fmi3Unit::free() {
  if (instance_ == nullptr || is_unusable_) return;
  for (SavedState& saved : states_) free_state(saved);
  free_instance_by("fmi3FreeInstance", fmi_.FreeInstance);
}

core::Capability* Fmi3Unit::find_capability(core::CapabilityId id) {
  const bool has_text = library_->describe_functions().DescribeMessage != nullptr;
  if (id == core::StepsInARow::kId) return implemented(id);
  if (id == core::MessageText::kId ? !has_text : !declares(id)) return nullptr;
  return id == core::UnitDiagnostics::kId ? diagnostics() : implemented(id);
}

void Fmi3Unit::enter_configuration_mode() {
  const char* const capability = "structural parameters";
  require("fmi3EnterConfigurationMode", fmi_.EnterConfigurationMode, capability);
  require("fmi3ExitConfigurationMode", fmi_.ExitConfigurationMode, capability);
  call_and_watch("fmi3EnterConfigurationMode", fmi_.EnterConfigurationMode);
}

void Fmi3Unit::exit_configuration_mode() {
  call_and_watch("fmi3ExitConfigurationMode", fmi_.ExitConfigurationMode);
}

void Fmi3Unit::enter_initialization(Time start, std::optional<Time> stop) {
  time_ = start;
  const double stop_seconds = set_stop(start, stop);
  const auto tolerance = parts_.description->default_tolerance;
  call_and_watch("fmi3EnterInitializationMode", fmi_.EnterInitializationMode, tolerance.has_value(),
                 tolerance.value_or(0), to_seconds(start), stop.has_value(), stop_seconds);
}

void Fmi3Unit::exit_initialization() {
  call_and_end_watch("fmi3ExitInitializationMode", fmi_.ExitInitializationMode);
}

void Fmi3Unit::terminate() {
  if (has_failed()) return;
  call("fmi3Terminate", fmi_.Terminate);
}

std::string Fmi3Unit::describe_message(core::ValueReference variable, const core::Binary& value) {
  const char* const name = "strideDescribeMessage";
  auto* const function = library_->describe_functions().DescribeMessage;
  const fmi3Byte none = 0;
  std::string text(kLongestDescription, '\0');
  std::size_t size = 0;
  const Status status =
      call_discardable(name, function, variable, value.empty() ? &none : value.data(), value.size(),
                       text.data(), text.size(), &size);
  if (status == Status::Discard) {
    drop_messages();
    return {};
  }
  if (size > text.size()) {
    fail(fmt::format("{} reports that it has written {} bytes where {} fit", name, size,
                     text.size()));
  }
  text.resize(size);
  return text;
}

void Fmi3Unit::on_log(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                      fmi3String message) {
  with_receiver<Fmi3Unit>(
      environment, [&](Fmi3Unit& unit) { unit.receive(status_of(status), category, message); });
}

// ---- Values ----

void Fmi3Unit::get(References references, core::ValueBlock& values) {
  if (values.type() == core::ValueType::Clock) {
    call("fmi3GetClock", fmi_.GetClock, references.data(), references.size(),
         values.numbers<bool>().data());
    return;
  }
  core::visit(values, [&]<class T>(std::span<T> elements) {
    if constexpr (std::is_same_v<T, std::string>) {
      get_strings(references, elements);
    } else if constexpr (std::is_same_v<T, core::Binary>) {
      get_binaries(references, elements);
    } else {
      call(Access<T>::kGetName, fmi_.*Access<T>::kGet, references.data(), references.size(),
           elements.data(), elements.size());
    }
  });
}

void Fmi3Unit::set(References references, const core::ValueBlock& values) {
  if (values.type() == core::ValueType::Clock) {
    call("fmi3SetClock", fmi_.SetClock, references.data(), references.size(),
         values.numbers<bool>().data());
    return;
  }
  core::visit(values, [&]<class T>(std::span<const T> elements) {
    if constexpr (std::is_same_v<T, std::string>) {
      set_strings(references, elements);
    } else if constexpr (std::is_same_v<T, core::Binary>) {
      set_binaries(references, elements);
    } else {
      call(Access<T>::kSetName, fmi_.*Access<T>::kSet, references.data(), references.size(),
           elements.data(), elements.size());
    }
  });
}

// What a unit returns is its own memory, valid until its next function is called: copied at once.

void Fmi3Unit::get_strings(References references, std::span<std::string> values) {
  texts_.assign(values.size(), nullptr);
  call("fmi3GetString", fmi_.GetString, references.data(), references.size(), texts_.data(),
       texts_.size());
  copy_texts("fmi3GetString", references, texts_, values);
}

void Fmi3Unit::set_strings(References references, std::span<const std::string> values) {
  texts_.resize(values.size());
  std::transform(values.begin(), values.end(), texts_.begin(),
                 [](const std::string& value) { return value.c_str(); });
  call("fmi3SetString", fmi_.SetString, references.data(), references.size(),
       std::as_const(texts_).data(), texts_.size());
}

void Fmi3Unit::get_binaries(References references, std::span<core::Binary> values) {
  bytes_.assign(values.size(), nullptr);
  sizes_.assign(values.size(), 0);
  call("fmi3GetBinary", fmi_.GetBinary, references.data(), references.size(), sizes_.data(),
       bytes_.data(), bytes_.size());
  copy_binaries("fmi3GetBinary", references, bytes_, sizes_, values);
}

void Fmi3Unit::set_binaries(References references, std::span<const core::Binary> values) {
  bytes_.resize(values.size());
  sizes_.resize(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    bytes_[i] = values[i].data();
    sizes_[i] = values[i].size();
  }
  call("fmi3SetBinary", fmi_.SetBinary, references.data(), references.size(),
       std::as_const(sizes_).data(), std::as_const(bytes_).data(), bytes_.size());
}

void Fmi3Unit::get_directional_derivative(References unknowns, References knowns,
                                          std::span<const double> seed,
                                          std::span<double> sensitivity) {
  require("fmi3GetDirectionalDerivative", fmi_.GetDirectionalDerivative,
          "providesDirectionalDerivatives");
  call("fmi3GetDirectionalDerivative", fmi_.GetDirectionalDerivative, unknowns.data(),
       unknowns.size(), knowns.data(), knowns.size(), seed.data(), seed.size(), sensitivity.data(),
       sensitivity.size());
}

// ---- Events ----

void Fmi3Unit::enter_event_mode() { call("fmi3EnterEventMode", fmi_.EnterEventMode); }

void Fmi3Unit::enter_step_mode() { call("fmi3EnterStepMode", fmi_.EnterStepMode); }

core::EventResult Fmi3Unit::update_discrete_states() {
  bool iterate = false;
  bool terminate = false;
  bool nominals_changed = false;
  bool values_changed = false;
  bool has_next = false;
  double next = 0;
  call("fmi3UpdateDiscreteStates", fmi_.UpdateDiscreteStates, &iterate, &terminate,
       &nominals_changed, &values_changed, &has_next, &next);
  core::EventResult result{.discrete_states_need_update = iterate,
                           .terminate_simulation = terminate,
                           .next_event_time = {}};
  // Some units express "never" by a time that no simulation reaches.
  if (has_next && !(next > kMaxSeconds)) {
    result.next_event_time = checked_time(next, "nextEventTime");
    // a unit may compare: it is not entered a rounding error before the instant that it gave
    while (to_seconds(*result.next_event_time) < next) *result.next_event_time += Duration(1);
  }
  return result;
}

}  // namespace stride::importer
