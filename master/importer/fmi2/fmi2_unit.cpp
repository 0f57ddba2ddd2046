#include "master/importer/fmi2/fmi2_unit.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "master/importer/fmi2/fmi2_log.h"
#include "master/importer/printf_text.h"

namespace stride::importer {

// ---- Life cycle ----

Fmi2Unit::Fmi2Unit(std::string name, std::shared_ptr<const Fmi2Library> library,
                   std::shared_ptr<const Fmi2Attributes> attributes, UnitParts parts,
                   InstanceOptions options)
    : FmuInstance("fmi2", library, std::move(name), std::move(parts), std::move(options)),
      fmi_(library->functions()),
      unit_references_(attributes->references.data()),
      saves_each_step_(parts_.description->can_save_state),
      library_(std::move(library)),
      attributes_(std::move(attributes)) {
  check_callable("fmi2Instantiate");
  const bool may_be_pending = attributes_->can_run_asynchronously;
  callbacks_ = {&on_log, &std::calloc, &std::free, may_be_pending ? &on_step_finished : nullptr,
                environment()};
  instance_ = guarded("fmi2Instantiate", [&] {
    return fmi_.Instantiate(
        name_.c_str(), fmi2CoSimulation, parts_.description->instantiation_token.c_str(),
        parts_.resources.c_str(), &callbacks_, fmi2False, options_.debug_logging);
  });
  restore_process("fmi2Instantiate");
  if (instance_ == nullptr) {
    fail(fmt::format("fmi2Instantiate failed: {}", take_messages("fmi2Instantiate")));
  }
}

Fmi2Unit::~Fmi2Unit() {
  free_or_warn([this] { Fmi2Unit::free(); });
}

void Fmi2Unit::free() {
  if (instance_ == nullptr) return;
  free_state(before_step_);
  for (SavedState& saved : states_) free_state(saved);
  free_instance_by("fmi2FreeInstance", fmi_.FreeInstance);
}

core::Capability* Fmi2Unit::find_capability(core::CapabilityId id) {
  if (!declares(id)) return nullptr;
  return id == core::UnitDiagnostics::kId ? diagnostics() : implemented(id);
}

/// Start values come after fmi2SetupExperiment, as in other importers: some units reset them there.
void Fmi2Unit::enter_initialization(Time start, std::optional<Time> stop) {
  time_ = start;
  const auto tolerance = parts_.description->default_tolerance;
  call_and_restore("fmi2SetupExperiment", fmi_.SetupExperiment, tolerance ? fmi2True : fmi2False,
                   tolerance.value_or(0), to_seconds(start), stop ? fmi2True : fmi2False,
                   to_seconds(stop.value_or(Time{})));
  is_instantiated_only_ = false;
  for (const auto& [references, values] : std::exchange(kept_parameters_, {})) {
    set(references, values);
  }
  call_and_restore("fmi2EnterInitializationMode", fmi_.EnterInitializationMode);
  for (const auto& [references, values] : std::exchange(kept_inputs_, {})) set(references, values);
}

void Fmi2Unit::exit_initialization() {
  call_and_restore("fmi2ExitInitializationMode", fmi_.ExitInitializationMode);
}

void Fmi2Unit::terminate() {
  if (has_failed()) return;
  call("fmi2Terminate", fmi_.Terminate);
}

void Fmi2Unit::enter_event_mode() { fail("FMI 2.0 Co-Simulation has no Event Mode"); }

core::EventResult Fmi2Unit::update_discrete_states() {
  fail("FMI 2.0 Co-Simulation has no Event Mode");
}

void Fmi2Unit::enter_step_mode() { fail("FMI 2.0 Co-Simulation has no Event Mode"); }

// ---- Messages ----

void Fmi2Unit::on_log(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status,
                      fmi2String category, fmi2String message, ...) {
  std::va_list arguments;
  va_start(arguments, message);
  try {
    const std::string text = message != nullptr ? printf_text(message, arguments) : "";
    with_receiver<Fmi2Unit>(environment, [&](Fmi2Unit& unit) {
      unit.receive(static_cast<Status>(status), category, unit.with_names(text).c_str());
    });
  } catch (...) {  // nothing may cross the unit's C code
  }
  va_end(arguments);
}

std::string Fmi2Unit::with_names(const std::string& message) const {
  return name_variables(message,
                        [&](char type, fmi2ValueReference r) { return variable_name(type, r); });
}

/// The first of them, if there are aliases.
std::string Fmi2Unit::variable_name(char type, fmi2ValueReference reference) const {
  const auto is_of_type = [&](core::ValueType t) {
    switch (type) {
      case 'r':
        return t == core::ValueType::Float64;
      case 'i':
        return t == core::ValueType::Int32 || t == core::ValueType::Enumeration;
      case 'b':
        return t == core::ValueType::Boolean;
      default:
        return t == core::ValueType::String;
    }
  };
  for (const core::Variable& variable : parts_.description->variables) {
    if (unit_references_[variable.reference] == reference && is_of_type(variable.type)) {
      return variable.name;
    }
  }
  return "";
}

// ---- Values ----

/// The unit's value references, in place of core's.
inline const fmi2ValueReference* Fmi2Unit::own(References references,
                                               std::vector<fmi2ValueReference>& into) {
  into.resize(references.size());
  for (std::size_t i = 0; i < references.size(); ++i) into[i] = unit_references_[references[i]];
  return into.data();
}

// Most values are of this type.
inline void Fmi2Unit::get(const core::BoundValues& values) {
  if (values.float64s.empty()) return get(values.references, *values.block);
  call("fmi2GetReal", fmi_.GetReal, own(values.references), values.references.size(),
       values.float64s.data());
}

inline void Fmi2Unit::set(const core::BoundValues& values) {
  if (values.float64s.empty()) return set(values.references, *values.block);
  call("fmi2SetReal", fmi_.SetReal, own(values.references), values.references.size(),
       std::as_const(*values.block).numbers<double>().data());
}

void Fmi2Unit::get(References references, core::ValueBlock& values) {
  switch (values.type()) {
    case core::ValueType::Float64:
      return call("fmi2GetReal", fmi_.GetReal, own(references), references.size(),
                  values.numbers<double>().data());
    case core::ValueType::Int32:
      return call("fmi2GetInteger", fmi_.GetInteger, own(references), references.size(),
                  values.numbers<fmi2Integer>().data());
    case core::ValueType::Enumeration:
      return get_enumerations(references, values.numbers<std::int64_t>());
    case core::ValueType::Boolean:
      return get_booleans(references, values.numbers<bool>());
    case core::ValueType::String:
      return get_strings(references, values.strings());
    default:
      fail(fmt::format("FMI 2.0 has no type {}", core::name(values.type())));
  }
}

void Fmi2Unit::set(References references, const core::ValueBlock& values) {
  if (is_instantiated_only_) return keep(references, values);
  is_as_saved_ = false;
  switch (values.type()) {
    case core::ValueType::Float64:
      if (sampled_inputs_ != nullptr) {
        return sampled_inputs_->add(own(references), values.numbers<double>());
      }
      return call("fmi2SetReal", fmi_.SetReal, own(references), references.size(),
                  values.numbers<double>().data());
    case core::ValueType::Int32:
      return call("fmi2SetInteger", fmi_.SetInteger, own(references), references.size(),
                  values.numbers<fmi2Integer>().data());
    case core::ValueType::Enumeration:
      return set_enumerations(references, values.numbers<std::int64_t>());
    case core::ValueType::Boolean:
      return set_booleans(references, values.numbers<bool>());
    case core::ValueType::String:
      return set_strings(references, values.strings());
    default:
      fail(fmt::format("FMI 2.0 has no type {}", core::name(values.type())));
  }
}

/// Inputs have to wait for Initialization Mode (FMI 2.0, 4.2.4).
void Fmi2Unit::keep(References references, const core::ValueBlock& values) {
  const bool has_input = std::ranges::any_of(references, [&](core::ValueReference r) {
    return parts_.description->variables[r].causality == core::Causality::Input;
  });
  auto& kept = has_input ? kept_inputs_ : kept_parameters_;
  kept.emplace_back(std::vector(references.begin(), references.end()), values);
}

void Fmi2Unit::get_enumerations(References references, std::span<std::int64_t> values) {
  integers_.resize(values.size());
  call("fmi2GetInteger", fmi_.GetInteger, own(references), references.size(), integers_.data());
  std::copy(integers_.begin(), integers_.end(), values.begin());
}

void Fmi2Unit::set_enumerations(References references, std::span<const std::int64_t> values) {
  integers_.clear();
  for (const std::int64_t value : values) {
    using Limits = std::numeric_limits<fmi2Integer>;
    if (value < Limits::min() || value > Limits::max()) {
      fail(
          fmt::format("the value {} does not fit into an Enumeration of FMI 2.0 (32 bits)", value));
    }
    integers_.push_back(static_cast<fmi2Integer>(value));
  }
  call("fmi2SetInteger", fmi_.SetInteger, own(references), references.size(),
       std::as_const(integers_).data());
}

void Fmi2Unit::get_booleans(References references, std::span<bool> values) {
  integers_.resize(values.size());
  call("fmi2GetBoolean", fmi_.GetBoolean, own(references), references.size(), integers_.data());
  std::transform(integers_.begin(), integers_.end(), values.begin(),
                 [](fmi2Boolean value) { return value != fmi2False; });
}

void Fmi2Unit::set_booleans(References references, std::span<const bool> values) {
  integers_.resize(values.size());
  std::transform(values.begin(), values.end(), integers_.begin(),
                 [](bool value) { return value ? fmi2True : fmi2False; });
  call("fmi2SetBoolean", fmi_.SetBoolean, own(references), references.size(),
       std::as_const(integers_).data());
}

// What a unit returns is its own memory, valid until its next function is called: copied at once.
void Fmi2Unit::get_strings(References references, std::span<std::string> values) {
  texts_.assign(values.size(), nullptr);
  call("fmi2GetString", fmi_.GetString, own(references), references.size(), texts_.data());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i].assign(texts_[i] != nullptr ? texts_[i] : "");
  }
}

void Fmi2Unit::set_strings(References references, std::span<const std::string> values) {
  texts_.resize(values.size());
  std::transform(values.begin(), values.end(), texts_.begin(),
                 [](const std::string& value) { return value.c_str(); });
  call("fmi2SetString", fmi_.SetString, own(references), references.size(),
       std::as_const(texts_).data());
}

void Fmi2Unit::get_directional_derivative(References unknowns, References knowns,
                                          std::span<const double> seed,
                                          std::span<double> sensitivity) {
  require("fmi2GetDirectionalDerivative", fmi_.GetDirectionalDerivative,
          "providesDirectionalDerivative");
  call("fmi2GetDirectionalDerivative", fmi_.GetDirectionalDerivative, own(unknowns),
       unknowns.size(), own(knowns, own_knowns_), knowns.size(), seed.data(), sensitivity.data());
}

// ---- Steps ----

core::StepResult Fmi2Unit::step(const core::StepInterval& interval,
                                const core::StepValues& values) {
  for (const core::BoundValues& input : values.inputs) set(input);
  time_ = interval.from;
  // no other double lands nearer to the end
  const double size = interval.end_seconds - interval.begin_seconds;
  if (!(size > 0)) {  // to the unit, whose time is a double, it is the same instant
    time_ = interval.to;
    return {.reached = interval.to};
  }
  if (input_update_) set_input_derivatives(size);
  if (saves_each_step_ && !is_as_saved_) save(before_step_);
  core::StepResult result{.reached = interval.to};
  if (do_step(interval, size) == Status::Discard) [[unlikely]] {
    result = handle_discard(interval);
    if (result.rejected) return result;
  }
  is_as_saved_ = was_restored_ = false;
  time_ = result.reached;
  for (const core::BoundValues& output : values.outputs) get(output);
  return result;
}

}  // namespace stride::importer
