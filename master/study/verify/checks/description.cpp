#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/loader/fmu/pack.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

using core::Causality;
using core::Initial;
using core::Unknown;
using core::ValueReference;
using core::ValueType;
using core::Variable;

/// Collects what is wrong.
class Examination {
 public:
  explicit Examination(const core::UnitDescription& unit) : unit_(unit) {}

  void run() {
    for (const Variable& variable : unit_.variables) examine(variable);
    examine_unknowns(unit_.outputs, "Output");
    examine_unknowns(unit_.initial_unknowns, "InitialUnknown");
    require_listed();
    require_event_mode();
  }
  const std::vector<std::string>& mistakes() const { return mistakes_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// Of the standards: what it says of variables, and of the model structure.
  static constexpr Rules kVariables{"2.2.7", "2.4.7"};
  static constexpr Rules kStructure{"2.2.8", "2.4.8"};

  template <class... Arguments>
  void mistake(const Rules& rules, fmt::format_string<Arguments...> text,
               Arguments&&... arguments) {
    std::string seen = fmt::format(text, std::forward<Arguments>(arguments)...);
    const std::string rule = rule_of(rules, unit_.fmi_version);
    mistakes_.push_back(rule.empty() ? std::move(seen) : fmt::format("{} ({})", seen, rule));
  }

  void examine(const Variable& variable) {
    const bool is_known = variable.causality == Causality::Input ||
                          variable.causality == Causality::Parameter ||
                          variable.initial == Initial::Exact || variable.initial == Initial::Approx;
    const bool may_lack_it = unit_.fmi_version.starts_with("1.");
    if (is_known && variable.start.empty() && has_start(variable) && !may_lack_it) {
      mistake(kVariables, "'{}' is {} and has no start value", variable.name,
              name(variable.causality));
    }
    if (!variable.unit.empty() && !unit_.units_of_measure.contains(variable.unit) &&
        !find_unit_of_measure(variable.unit) && said_units_.insert(variable.unit).second) {
      notes_.push_back(fmt::format(
          "the unit '{}' of '{}' is neither defined by a BaseUnit nor known by name, so it cannot "
          "be converted",
          variable.unit, variable.name));
    }
    examine_range(variable);
  }

  /// An empty text is a start value, too.
  static bool has_start(const Variable& variable) {
    return variable.type != ValueType::Clock && variable.type != ValueType::String &&
           variable.type != ValueType::Binary;
  }

  void examine_range(const Variable& variable) {
    if (!has_start_value(variable)) return;
    try {
      const core::ValueBlock start = core::parse_start(variable, variable.start);
      compare(variable, start);
    } catch (const std::invalid_argument& error) {
      if (variable.start.empty()) return;
      mistake(kVariables, "'{}' has the start value '{}': {}", variable.name, variable.start,
              error.what());
    }
  }

  void compare(const Variable& variable, const core::ValueBlock& start) {
    core::visit(start, [&]<class T>(std::span<const T> elements) {
      if constexpr (std::is_arithmetic_v<T>) {
        for (const T element : elements) {
          const auto number = static_cast<double>(element);
          const bool is_low = !variable.min.empty() && number < std::stod(variable.min);
          const bool is_high = !variable.max.empty() && number > std::stod(variable.max);
          if (!is_low && !is_high) continue;
          mistake(kVariables, "'{}' has the start value {}, which is {} its {} {}", variable.name,
                  variable.start, is_low ? "below" : "above", is_low ? "min" : "max",
                  is_low ? variable.min : variable.max);
          return;
        }
      }
    });
  }

  void examine_unknowns(const std::vector<Unknown>& unknowns, const char* element) {
    std::set<ValueReference> listed;
    for (const Unknown& unknown : unknowns) {
      const Variable& variable = unit_.variables[*unit_.find(unknown.reference)];
      if (!listed.insert(unknown.reference).second) {
        mistake(kStructure, "<{}> lists '{}' twice", element, variable.name);
      }
      const bool is_output = variable.causality == Causality::Output;
      if (std::string(element) == "Output" && !is_output) {
        mistake(kStructure, "<Output> lists '{}', which is {}", variable.name,
                name(variable.causality));
      }
      for (const ValueReference known :
           unknown.dependencies.value_or(std::vector<ValueReference>{})) {
        const Variable& source = unit_.variables[*unit_.find(known)];
        if (source.variability != core::Variability::Constant) continue;
        mistake(kStructure, "<{}> lets '{}' depend on '{}', which is a constant", element,
                variable.name, source.name);
      }
    }
  }

  static bool lists(const std::vector<Unknown>& unknowns, ValueReference reference) {
    return std::any_of(unknowns.begin(), unknowns.end(),
                       [&](const Unknown& unknown) { return unknown.reference == reference; });
  }

  void require_listed() {
    for (const Variable& variable : unit_.variables) {
      const bool is_output = variable.causality == Causality::Output;
      if (is_output && !lists(unit_.outputs, variable.reference)) {
        mistake(kStructure, "<ModelStructure> has no <Output> for '{}'", variable.name);
      }
      const bool is_computed =
          variable.initial == Initial::Calculated || variable.initial == Initial::Approx;
      const bool is_unknown = (is_output && is_computed && !variable.is_clocked()) ||
                              variable.causality == Causality::CalculatedParameter;
      if (is_unknown && !lists(unit_.initial_unknowns, variable.reference)) {
        mistake(
            kStructure,
            "<ModelStructure> has no <InitialUnknown> for '{}', whose initial value is computed",
            variable.name);
      }
    }
  }

  void require_event_mode() {
    if (unit_.has_event_mode) return;
    for (const Variable& variable : unit_.variables) {
      if (variable.type != ValueType::Clock) continue;
      return mistake(kVariables, "'{}' is a clock, and the unit has no Event Mode (hasEventMode)",
                     variable.name);
    }
  }

  const core::UnitDescription& unit_;
  std::vector<std::string> mistakes_;
  std::vector<std::string> notes_;
  std::set<std::string> said_units_;
};

/// A library of the unit kit knows its description; the one in the archive must be the same.
void compare_with_library(const Trial& trial, std::vector<std::string>& mistakes) {
  const auto library = trial.tested.fmu().load_fmi3_library();
  if (!library || !library->describes_itself()) return;
  const std::filesystem::path folder = trial.tested.fmu().folder();
  const std::filesystem::path resources = folder / "resources";
  trial.note.write("strideModelDescription");
  std::string own = library->describe(core::is_folder(resources) ? resources : "");
  trial.note.clear();
  importer::set_model_name(own, trial.tested.description().model_name);  // which packing may choose
  const std::string packed = core::read_input(folder / "modelDescription.xml");
  if (own == packed) return;
  const auto place = std::mismatch(own.begin(), own.end(), packed.begin(), packed.end()).first;
  mistakes.push_back(fmt::format(
      "modelDescription.xml differs from the library's own description, first in line {}; "
      "pack the unit again",
      1 + std::count(own.begin(), place, '\n')));
}

}  // namespace

Finding check_description(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  Examination examination(unit);
  examination.run();
  std::vector<std::string> mistakes = examination.mistakes();
  compare_with_library(trial, mistakes);
  if (!mistakes.empty()) {
    std::vector<std::string> notes(mistakes.begin() + 1, mistakes.end());
    return failed(mistakes.front(), std::move(notes));
  }
  return passed(fmt::format("{} outputs and {} initial unknowns are listed", unit.outputs.size(),
                            unit.initial_unknowns.size()),
                examination.notes());
}

}  // namespace stride::verify
