#include "master/loader/fmu/description/common_description.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/time_text.h"

namespace stride::importer {
namespace {

bool is_step(double seconds) {
  return seconds > 0 && seconds <= kMaxSeconds &&
         !core::Interval::from_seconds(seconds).is_below_picosecond();
}

/// Reads <DefaultExperiment>, which is a proposal: what cannot be used of it is ignored.
class Experiment {
 public:
  Experiment(const xml::Element& element, core::UnitDescription& unit)
      : element_(element), unit_(unit) {}

  /// Nothing if there is none, or none that `fits`, which a warning says.
  template <class Fits>
  std::optional<double> number(const char* attribute, const char* expected, Fits&& fits) {
    const auto text = element_.attribute(attribute);
    if (!text) return std::nullopt;
    const auto words = xml::split(*text);
    const auto value = words.size() == 1 ? xml::to_number<double>(words.front()) : std::nullopt;
    if (value && std::isfinite(*value) && fits(*value)) return value;
    ignore(attribute, expected);
    return std::nullopt;
  }

  std::optional<Duration> seconds(const char* attribute) {
    const auto value = number(attribute, "a number of seconds within 1e15",
                              [](double v) { return std::abs(v) <= kMaxSeconds; });
    return value ? std::optional(duration_from_seconds(*value)) : std::nullopt;
  }

  std::optional<core::Interval> step_size() {
    const auto value = number("stepSize", "a positive number of seconds within 1e15", &is_step);
    return value ? std::optional(core::Interval::from_seconds(*value)) : std::nullopt;
  }

  std::optional<Time> start() {
    const auto value = seconds("startTime");
    return value ? std::optional(Time(*value)) : std::nullopt;
  }

  /// One beyond the time that can be simulated cannot be reached, but is no mistake.
  std::optional<Time> stop(Time start) {
    const auto value = number("stopTime", "a number of seconds", [](double) { return true; });
    if (!value) return std::nullopt;
    if (*value > kMaxSeconds) return Time::max();
    const Time stop = time_from_seconds(std::max(*value, -kMaxSeconds));
    if (stop > start) return stop;
    ignore("stopTime", fmt::format("a time after the start, {} s", core::to_text(start)));
    return std::nullopt;
  }

 private:
  void ignore(const char* attribute, const std::string& expected) {
    unit_.warnings.push_back(core::to_text({.where = element_.where()}) +
                             fmt::format("{}=\"{}\" of {} is ignored: expected {}", attribute,
                                         *element_.attribute(attribute), element_.tag(), expected));
  }

  xml::Element element_;
  core::UnitDescription& unit_;
};

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

xml::Element find_co_simulation(const xml::Element& root, std::vector<std::string>& warnings) {
  if (const auto found = root.lenient_child("CoSimulation", warnings)) return *found;
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
  unit.can_vary_step =
      co_simulation.lenient_flag("canHandleVariableCommunicationStepSize", unit.warnings);
  unit.single_instance =
      co_simulation.lenient_flag("canBeInstantiatedOnlyOncePerProcess", unit.warnings);
  unit.needs_execution_tool = co_simulation.lenient_flag("needsExecutionTool", unit.warnings);
  unit.max_output_derivative_order =
      co_simulation.number<unsigned>("maxOutputDerivativeOrder").value_or(0);
}

std::optional<core::Interval> read_step_size(const xml::Element& element, const char* attribute) {
  const auto seconds = element.number<double>(attribute);
  if (!seconds) return std::nullopt;
  if (is_step(*seconds)) return core::Interval::from_seconds(*seconds);
  element.fail(fmt::format(
      "{}=\"{}\" of {}: expected a positive number of seconds within 1e15, at least the "
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

void read_model_structure(const xml::Element& root, core::UnitDescription& unit,
                          const UnknownsReader& read_outputs, const UnknownsReader& read_initial) {
  const char* const ignored =
      "without what it has of dependencies, each output may depend on all inputs";
  const auto structure = root.child("ModelStructure");
  if (!structure) {
    unit.warnings.push_back(core::to_text({.where = root.where()}) +
                            fmt::format("<ModelStructure> is missing; {}", ignored));
    return;
  }
  try {
    unit.outputs = read_outputs(*structure);
    unit.initial_unknowns = read_initial(*structure);
  } catch (const core::Error& mistake) {
    unit.outputs.clear();
    unit.warnings.push_back(
        fmt::format("{}; <ModelStructure> is ignored, and {}", mistake.what(), ignored));
  }
}

void read_default_experiment(const xml::Element& root, core::UnitDescription& unit) {
  const auto element = root.child("DefaultExperiment");
  if (!element) return;
  Experiment experiment(*element, unit);
  unit.default_step = experiment.step_size();
  unit.default_tolerance =
      experiment.number("tolerance", "a positive number", [](double v) { return v > 0; });
  unit.default_start = experiment.start();
  unit.default_stop = experiment.stop(unit.default_start.value_or(Time{}));
}

}  // namespace stride::importer
