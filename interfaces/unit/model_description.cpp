#include "interfaces/unit/model_description.h"

#include <algorithm>
#include <map>
#include <set>

#include <stride/value_text.h>

#include "interfaces/unit/fractions.h"
#include "interfaces/unit/hash.h"
#include "interfaces/unit/idle_manifest.h"
#include "interfaces/unit/log_categories.h"
#include "interfaces/unit/units_of_measure.h"
#include "interfaces/unit/xml_writer.h"

namespace stride::kit {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : " ").append(word);
  return text;
}

std::string element_text(double value) { return to_text(value); }
std::string element_text(float value) { return to_text(value); }
std::string element_text(bool value) { return value ? "true" : "false"; }
std::string element_text(const std::string& value) { return value; }
std::string element_text(const Binary& value) {
  std::string text;
  append_value(text, value);
  return text;
}
std::string element_text(const Clock&) { return {}; }
template <class Integer>
std::string element_text(Integer value) {
  return std::to_string(value);
}

std::vector<std::string> start_texts(const Variable& row) {
  std::vector<std::string> texts;
  visit(row.type, row.data, [&](const auto* elements) {
    for (std::size_t i = 0; i < row.size; ++i) texts.push_back(element_text(elements[i]));
  });
  return texts;
}

std::string bound_text(Type type, double value) {
  switch (type) {
    case Type::Float32:
    case Type::Float64:
      return to_text(value);
    case Type::UInt64:
      return std::to_string(static_cast<std::uint64_t>(value));
    default:  // Table::check() lets no other value come here than those of the type
      return std::to_string(static_cast<std::int64_t>(value));
  }
}

bool has_start(const Variable& row) {
  return row.initial == Initial::Exact || row.initial == Initial::Approx;
}

std::string type_name(const Variable& row) { return row.name + " type"; }

class Writer {
 public:
  Writer(const std::string& unit_name, const Unit& unit, const Table& table)
      : name_(unit_name), unit_(unit), table_(table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
      if (table.row(i).causality == Causality::Parameter) parameters_.push_back(i);
    }
  }

  std::string write(const std::string& token) {
    xml_.open("fmiModelDescription")
        .attribute("fmiVersion", FMI3_VERSION)
        .attribute("modelName", name_)
        .attribute("instantiationToken", token);
    if (!unit_.info().description.empty()) {
      xml_.attribute("description", unit_.info().description);
    }
    xml_.attribute("version", unit_.info().version)
        .attribute("generationTool", "stride unit kit")
        .attribute("variableNamingConvention", "structured");
    write_interface_type();
    write_units();
    write_types();
    write_log_categories();
    write_default_experiment();
    xml_.open("ModelVariables");
    for (std::size_t i = 0; i < table_.size(); ++i) write_variable(i);
    xml_.close();
    write_structure();
    write_annotations();
    xml_.close();
    return xml_.text();
  }

 private:
  void write_default_experiment() {
    const UnitInfo& info = unit_.info();
    if (!info.default_start && !info.default_stop && !info.default_step) return;
    xml_.open("DefaultExperiment");
    if (info.default_start) xml_.attribute("startTime", to_seconds(*info.default_start));
    if (info.default_stop) xml_.attribute("stopTime", to_seconds(*info.default_stop));
    if (info.default_step) xml_.attribute("stepSize", to_seconds(*info.default_step));
    xml_.close();
  }

  void write_interface_type() {
    const UnitInfo& info = unit_.info();
    xml_.open("CoSimulation").attribute("modelIdentifier", name_);
    if (info.single_instance) xml_.attribute("canBeInstantiatedOnlyOncePerProcess", true);
    if (unit_.lists_state()) {
      xml_.attribute("canGetAndSetFMUState", true).attribute("canSerializeFMUState", true);
    }
    xml_.attribute("canHandleVariableCommunicationStepSize", true);
    if (info.fixed_step) xml_.attribute("fixedInternalStepSize", to_seconds(*info.fixed_step));
    const auto& rows = unit_.variables();
    if (std::any_of(rows.begin(), rows.end(), [](const Variable& r) { return r.derivative; })) {
      xml_.attribute("maxOutputDerivativeOrder", "1");
    }
    if (std::any_of(rows.begin(), rows.end(), [](const Variable& r) { return r.intermediate; })) {
      xml_.attribute("providesIntermediateUpdate", true);
    }
    if (info.early_return) xml_.attribute("mightReturnEarlyFromDoStep", true);
    xml_.attribute("hasEventMode", true).close();
  }

  void write_units() {
    std::set<std::string> symbols;
    for (std::size_t i = 0; i < table_.size(); ++i) symbols.insert(table_.row(i).unit);
    symbols.erase("");
    const OwnUnitsOfMeasure own = own_units_of_measure(unit_);
    xml_.open("UnitDefinitions");
    for (const std::string& symbol : symbols) {
      xml_.open("Unit").attribute("name", symbol);
      if (const auto unit = find_unit_of_measure(symbol, own)) write_base_unit(*unit);
      xml_.close();
    }
    xml_.close();
  }

  void write_base_unit(const BaseUnitOfMeasure& unit) {
    xml_.open("BaseUnit");
    for (std::size_t i = 0; i < unit.exponents.size(); ++i) {
      const int exponent = unit.exponents[i];
      if (exponent != 0) xml_.attribute(kUnitOfMeasureBases[i], std::int64_t{exponent});
    }
    if (unit.factor != 1) xml_.attribute("factor", static_cast<double>(unit.factor));
    if (unit.offset != 0) xml_.attribute("offset", static_cast<double>(unit.offset));
    xml_.close();
  }

  void write_types() {
    bool any = false;
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const Variable& row = table_.row(i);
      if (row.type != Type::Enumeration) continue;
      if (!any) xml_.open("TypeDefinitions");
      any = true;
      xml_.open("EnumerationType").attribute("name", type_name(row));
      for (const auto& [item, value] : row.items) {
        xml_.open("Item").attribute("name", item).attribute("value", value).close();
      }
      xml_.close();
    }
    if (any) xml_.close();
  }

  void write_log_categories() {
    xml_.open("LogCategories");
    for (const NamedLogCategory& category : kLogCategories) {
      xml_.open("Category").attribute("name", category.name).close();
    }
    xml_.close();
  }

  void write_variable(std::size_t reference) {
    const Variable& row = table_.row(reference);
    xml_.open(name(row.type))
        .attribute("name", row.name)
        .attribute("valueReference", static_cast<std::int64_t>(reference));
    if (!row.description.empty()) xml_.attribute("description", row.description);
    xml_.attribute("causality", name(row.causality));
    if (row.type == Type::Clock) {
      write_timing(row);
      xml_.close();
      return;
    }
    write_variability(row);
    if (row.type == Type::Enumeration) xml_.attribute("declaredType", type_name(row));
    if (!row.unit.empty()) xml_.attribute("unit", row.unit);
    if (row.is_relative) xml_.attribute("relativeQuantity", true);
    if (row.min) xml_.attribute("min", bound_text(row.type, *row.min));
    if (row.max) xml_.attribute("max", bound_text(row.type, *row.max));
    if (!row.mime_type.empty()) xml_.attribute("mimeType", row.mime_type);
    if (row.intermediate) xml_.attribute("intermediateUpdate", true);
    write_start_and_dimensions(row);
    xml_.close();
  }

  /// Intervals as decimals for all importers, and as counts of picoseconds.
  void write_timing(const Variable& row) {
    xml_.attribute("intervalVariability", name(row.interval_variability));
    if (!is_time_based(row)) return;
    const auto& clock = *static_cast<const Clock*>(row.data);
    const bool is_shifted = clock.shift() != Duration{};
    if (row.has_interval) {
      xml_.attribute("intervalDecimal", to_seconds(clock.interval()));
      if (is_shifted) xml_.attribute("shiftDecimal", to_seconds(clock.shift()));
    }
    xml_.attribute("supportsFraction", true);
    if (!row.has_interval) return;
    const Fractions counters = fractions_of(clock.interval(), clock.shift());
    xml_.attribute("resolution", static_cast<std::int64_t>(counters.resolution))
        .attribute("intervalCounter", static_cast<std::int64_t>(counters.first));
    if (is_shifted) xml_.attribute("shiftCounter", static_cast<std::int64_t>(counters.second));
  }

  void write_variability(const Variable& row) {
    xml_.attribute("variability", name(row.variability));
    if (row.clock != nullptr) {
      xml_.attribute("clocks", std::int64_t{table_.reference_of(*row.clock)});
    }
    constexpr const char* kNames[] = {"", "exact", "approx", "calculated"};
    const bool implied = row.causality == Causality::Input || row.initial == Initial::None;
    if (!implied) xml_.attribute("initial", kNames[static_cast<std::size_t>(row.initial)]);
  }

  void write_start_and_dimensions(const Variable& row) {
    const std::vector<std::string> values = start_texts(row);
    const bool as_elements = row.type == Type::String || row.type == Type::Binary;
    if (has_start(row) && !as_elements) xml_.attribute("start", join(values));
    for (const std::size_t size : row.dimensions) {
      xml_.open("Dimension").attribute("start", static_cast<std::int64_t>(size)).close();
    }
    if (!has_start(row) || !as_elements) return;
    for (const std::string& value : values) xml_.open("Start").attribute("value", value).close();
  }

  void write_structure() {
    xml_.open("ModelStructure");
    for (std::size_t i = 0; i < table_.size(); ++i) {
      if (table_.row(i).causality == Causality::Output) write_unknown("Output", i);
    }
    for (std::size_t i = 0; i < table_.size(); ++i) {
      if (is_initial_unknown(table_.row(i))) write_unknown("InitialUnknown", i);
    }
    xml_.close();
  }

  /// Outputs that are computed at the start, clocks included, but not what comes with a clock: it
  /// may be listed, but FMPy takes that for a mistake.
  static bool is_initial_unknown(const Variable& row) {
    const bool computed = row.initial == Initial::Calculated || row.type == Type::Clock;
    return row.causality == Causality::Output && computed && row.clock == nullptr;
  }

  void write_unknown(const std::string& element, std::size_t reference) {
    const Variable& row = table_.row(reference);
    xml_.open(element).attribute("valueReference", static_cast<std::int64_t>(reference));
    if (row.type == Type::Clock) {
      // a tick is made by fmi3DoStep or fmi3UpdateDiscreteStates and seen after it (FMI 3.0, 2.2.9)
      xml_.attribute("dependencies", "");
    } else if (row.dependencies) {
      std::set<std::size_t> knowns;
      for (const std::string& name : *row.dependencies) knowns.insert(table_.reference_of(name));
      if (element == "InitialUnknown") knowns.insert(parameters_.begin(), parameters_.end());
      std::vector<std::string> words;
      for (const std::size_t known : knowns) words.push_back(std::to_string(known));
      xml_.attribute("dependencies", join(words));
    }
    xml_.close();
  }

  /// What FMI has no attribute for: an importer without this annotation has to expect
  /// fmi3Discard.
  void write_annotations() {
    xml_.open("Annotations").open("Annotation").attribute("type", "org.stride.unit");
    xml_.open("stride:Unit")
        .attribute("xmlns:stride", "urn:org.stride:unit:1")
        .attribute("mayReject", unit_.info().may_reject);
    if (unit_.info().split_invariant) xml_.attribute("splitInvariant", true);
    if (!unit_.info().allows_snapshots) xml_.attribute("allowsSnapshots", false);
    const auto& longest = unit_.info().maximum_step;
    if (longest && to_seconds(*longest) <= kMaxSeconds) {
      xml_.attribute("maximumStep", to_seconds(*longest));
    }
    for (const Variable& row : unit_.variables()) {
      if (row.is_verdict) xml_.attribute("verdict", row.name);
      if (row.is_verdict_text) xml_.attribute("verdictText", row.name);
    }
    xml_.close().close().close();
  }

  std::string name_;
  const Unit& unit_;
  const Table& table_;
  std::vector<std::size_t> parameters_;  ///< their value references
  XmlWriter xml_;
};

}  // namespace

std::string instantiation_token(const std::string& name, const Unit& unit, const Table& table) {
  const std::string text = Writer(name, unit, table).write("") + idle_manifest(unit, table);
  const std::uint64_t value = hash(text.data(), text.size());
  std::string token = "stride-";
  for (int shift = 56; shift >= 0; shift -= 8) {
    append_hexadecimal(token, static_cast<std::uint8_t>(value >> shift));
  }
  return token;
}

std::string model_description(const std::string& name, const Unit& unit, const Table& table) {
  return Writer(name, unit, table).write(instantiation_token(name, unit, table));
}

}  // namespace stride::kit
