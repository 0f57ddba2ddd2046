#include "master/importer/common_description.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/util/time_text.h"

namespace stride::importer {
namespace {

/// Nothing if there is no such attribute.
std::optional<Duration> read_seconds(const xml::Element& element, const char* attribute) {
  const auto seconds = element.number<double>(attribute);
  if (!seconds) return std::nullopt;
  try {
    return duration_from_seconds(*seconds);
  } catch (const std::out_of_range& error) {
    element.fail(fmt::format("{}=\"{}\" of {}: {}", attribute, *element.attribute(attribute),
                             element.tag(), error.what()));
  }
}

/// One that no solver can have is ignored.
void read_tolerance(const xml::Element& experiment, core::UnitDescription& unit) {
  const auto tolerance = experiment.number<double>("tolerance");
  if (!tolerance) return;
  if (std::isfinite(*tolerance) && *tolerance > 0) {
    unit.default_tolerance = tolerance;
    return;
  }
  unit.warnings.push_back(
      core::to_text({.where = experiment.where()}) +
      fmt::format("tolerance=\"{}\" of {} is ignored: expected a positive number",
                  *experiment.attribute("tolerance"), experiment.tag()));
}

}  // namespace

std::string read_model_identifier(const xml::Element& owner) {
  const std::string identifier = owner.required("modelIdentifier");
  const bool is_plain =
      !identifier.empty() && identifier.front() != '.' && identifier.find('/') == std::string::npos;
  if (!is_plain) {
    owner.fail(fmt::format("modelIdentifier=\"{}\": expected the plain name of the unit's library",
                           identifier));
  }
  return identifier;
}

xml::Element find_co_simulation(const xml::Element& root) {
  if (const auto found = root.child("CoSimulation")) return *found;
  std::vector<std::string> others;
  for (const char* other : {"ModelExchange", "ScheduledExecution"}) {
    if (root.child(other)) others.emplace_back(other);
  }
  root.fail(
      fmt::format("the unit has no Co-Simulation interface, which stride needs; it has {}",
                  others.empty() ? "none at all" : fmt::format("{} only", fmt::join(others, ", "))),
      "export the unit for Co-Simulation, with a solver of its own");
}

void read_capabilities(const xml::Element& co_simulation, core::UnitDescription& unit) {
  unit.model_identifier = read_model_identifier(co_simulation);
  unit.can_vary_step = co_simulation.flag("canHandleVariableCommunicationStepSize");
  unit.single_instance = co_simulation.flag("canBeInstantiatedOnlyOncePerProcess");
  unit.needs_execution_tool = co_simulation.flag("needsExecutionTool");
  unit.max_output_derivative_order =
      co_simulation.number<unsigned>("maxOutputDerivativeOrder").value_or(0);
}

std::optional<Duration> read_step_size(const xml::Element& element, const char* attribute) {
  const auto size = read_seconds(element, attribute);
  if (!size || *size > Duration{}) return size;
  element.fail(
      fmt::format("{}=\"{}\" of {}: expected a positive number of seconds, at least the "
                  "picosecond that times are counted in",
                  attribute, *element.attribute(attribute), element.tag()));
}

void read_units(const xml::Element& root, core::UnitDescription& unit) {
  const auto definitions = root.child("UnitDefinitions");
  if (!definitions) return;
  for (const xml::Element& definition : definitions->children("Unit")) {
    const std::string name = definition.given("name");
    const auto element = definition.child("BaseUnit");
    if (!element) continue;
    unit.units_of_measure[name] = core::read_base_unit(*element);
  }
}

void read_default_experiment(const xml::Element& root, core::UnitDescription& unit) {
  const auto experiment = root.child("DefaultExperiment");
  if (!experiment) return;
  unit.default_step = read_step_size(*experiment, "stepSize");
  read_tolerance(*experiment, unit);
  const Duration start = read_seconds(*experiment, "startTime").value_or(Duration{});
  const auto seconds = experiment->number<double>("stopTime");
  // such an experiment cannot be run to its end, but the unit can be used in others
  if (seconds && std::isfinite(*seconds) && *seconds > kMaxSeconds) return;
  const auto stop = read_seconds(*experiment, "stopTime");
  if (!stop) return;
  if (*stop <= start) {
    experiment->fail(
        fmt::format("stopTime=\"{}\" of <DefaultExperiment>: expected a time at least a "
                    "picosecond after the start, {} s",
                    *experiment->attribute("stopTime"), core::to_text(start)));
  }
  unit.default_stop = Time(*stop);
}

}  // namespace stride::importer
