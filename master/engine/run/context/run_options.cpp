#include "master/engine/run/context/run_options.h"

#include <span>

#include "master/engine/model/system/system.h"

namespace stride::core {
namespace {

/// The last one counts.
std::optional<double> setting_of(std::span<const IdleSetting> settings, VariableId id) {
  std::optional<double> value;
  for (const IdleSetting& setting : settings) {
    if (setting.id == id) value = setting.value;
  }
  return value;
}

}  // namespace

const char* name(Coupling coupling) {
  return coupling == Coupling::Jacobi ? "jacobi" : "gauss-seidel";
}

const char* name(Extrapolation extrapolation) {
  switch (extrapolation) {
    case Extrapolation::Hold:
      return "hold";
    case Extrapolation::Linear:
      return "linear";
    case Extrapolation::Quadratic:
      break;
  }
  return "quadratic";
}

std::optional<Duration> IdleOptions::longest_suspension(const System& system,
                                                        std::size_t component) const {
  const Component& of = system.components()[component];
  const bool may = of.description->promises_idle && !of.keeps_own_step();
  return may && component < max_skip.size() ? max_skip[component] : std::nullopt;
}

std::optional<double> IdleOptions::tolerance(const System& system, VariableId output) const {
  const auto setting = setting_of(tolerances, output);
  return setting ? setting : system.variable(output).tolerance;
}

double IdleOptions::deadband(const System& system, VariableId input) const {
  return setting_of(deadbands, input).value_or(system.variable(input).deadband);
}

}  // namespace stride::core
