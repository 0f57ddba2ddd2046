#include "master/loader/fmu/fmi2/fmi2_unit.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "master/loader/fmu/instance/printf_text.h"

namespace stride::importer {

// ---- Life cycle ----

Fmi2Unit::Fmi2Unit(std::string name, std::shared_ptr<const Fmi2Library> library,
                   std::shared_ptr<const Fmi2Attributes> attributes, UnitParts parts,
                   InstanceOptions options)
    : ScalarUnit("fmi2", library->functions(), attributes->references, library, std::move(name),
                 std::move(parts), std::move(options)),
      saves_each_step_(parts_.description->can_save_state),
      library_(std::move(library)),
      attributes_(std::move(attributes)) {
  const bool may_be_pending = attributes_->can_run_asynchronously;
  callbacks_ = {&on_log, &std::calloc, &std::free, may_be_pending ? &on_step_finished : nullptr,
                environment()};
  instantiate_by("fmi2Instantiate", [&] {
    return fmi_.Instantiate(
        name_.c_str(), fmi2CoSimulation, parts_.description->instantiation_token.c_str(),
        parts_.resources.c_str(), &callbacks_, fmi2False, options_.debug_logging);
  });
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
  const double stop_seconds = set_stop(start, stop);
  const auto tolerance = parts_.description->default_tolerance;
  call_and_watch("fmi2SetupExperiment", fmi_.SetupExperiment, tolerance ? fmi2True : fmi2False,
                 tolerance.value_or(0), to_seconds(start), stop ? fmi2True : fmi2False,
                 stop_seconds);
  is_instantiated_only_ = false;
  for (const auto& [references, values] : std::exchange(kept_parameters_, {})) {
    set(references, values);
  }
  call_and_watch("fmi2EnterInitializationMode", fmi_.EnterInitializationMode);
  for (const auto& [references, values] : std::exchange(kept_inputs_, {})) set(references, values);
}

void Fmi2Unit::exit_initialization() {
  call_and_end_watch("fmi2ExitInitializationMode", fmi_.ExitInitializationMode);
}

void Fmi2Unit::terminate() {
  if (has_failed()) return;
  call("fmi2Terminate", fmi_.Terminate);
}

// ---- Messages ----

void Fmi2Unit::on_log(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status,
                      fmi2String category, fmi2String message, ...) {
  std::va_list arguments;
  va_start(arguments, message);
  try {
    const std::string text = message != nullptr ? printf_text(message, arguments) : "";
    with_receiver<Fmi2Unit>(environment, [&](Fmi2Unit& unit) {
      unit.receive(status_of(status), category, unit.with_names(text).c_str());
    });
  } catch (...) {  // nothing may cross the unit's C code
  }
  va_end(arguments);
}

// ---- Values ----

// Most values are of this type.
[[gnu::always_inline]] inline void Fmi2Unit::get(CallSequence& calls,
                                                 const core::BoundValues& values) {
  if (values.float64s.empty()) return get(values.references, *values.block);
  calls.call("fmi2GetReal", fmi_.GetReal, own(values.references), values.references.size(),
             values.float64s.data());
}

[[gnu::always_inline]] inline void Fmi2Unit::set(CallSequence& calls,
                                                 const core::BoundValues& values) {
  if (values.float64s.empty()) return set(values.references, *values.block);
  calls.call("fmi2SetReal", fmi_.SetReal, own(values.references), values.references.size(),
             std::as_const(*values.block).numbers<double>().data());
}

void Fmi2Unit::set(References references, const core::ValueBlock& values) {
  if (is_instantiated_only_) return keep(references, values);
  is_as_saved_ = false;
  if (sampled_inputs_ != nullptr && values.type() == core::ValueType::Float64) {
    return sampled_inputs_->add(own(references), values.numbers<double>());
  }
  ScalarUnit::set(references, values);
}

/// Inputs have to wait for Initialization Mode (FMI 2.0, 4.2.4).
void Fmi2Unit::keep(References references, const core::ValueBlock& values) {
  const bool has_input = std::ranges::any_of(references, [&](core::ValueReference r) {
    return parts_.description->variables[r].causality == core::Causality::Input;
  });
  auto& kept = has_input ? kept_inputs_ : kept_parameters_;
  kept.emplace_back(std::vector(references.begin(), references.end()), values);
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
  CallSequence calls(*this, "fmi2DoStep", interval.from);
  for (const core::BoundValues& input : values.inputs) set(calls, input);
  return make_step(calls, interval, values.outputs);
}

core::StepResult Fmi2Unit::save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                          const core::StepValues& values) {
  if (&unit != this) return StateSaving::save_with_step(unit, interval, values);
  CallSequence calls(*this, "fmi2DoStep", interval.from);
  for (const core::BoundValues& input : values.inputs) set(calls, input);
  Fmi2Unit::save_state();
  return make_step(calls, interval, values.outputs);
}

/// Behind its inputs: the step, and its outputs.
[[gnu::always_inline]] inline core::StepResult Fmi2Unit::make_step(
    CallSequence& calls, const core::StepInterval& interval,
    std::span<const core::BoundValues> outputs) {
  const double size = size_of(interval);
  if (!(size > 0)) {  // to the unit, whose time is a double, it is the same instant
    calls.set_time(interval.to);
    return {.reached = interval.to};
  }
  if (input_update_) set_input_derivatives(size);
  if (saves_each_step_ && !is_as_saved_) save(before_step_);
  core::StepResult result{.reached = interval.to};
  if (do_step(calls, interval, size) == Status::Discard) [[unlikely]] {
    result = handle_discard(interval);
    if (result.rejected) return result;
  }
  is_as_saved_ = was_restored_ = false;
  calls.set_time(result.reached);
  for (const core::BoundValues& output : outputs) get(calls, output);
  return result;
}

}  // namespace stride::importer
