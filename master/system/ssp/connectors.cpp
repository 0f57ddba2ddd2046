#include "master/system/ssp/connectors.h"

#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/system/ssp/ssp.h"

namespace stride::ssp {
namespace {

using core::Causality;
using core::ValueType;

Flow flow_of(Causality causality) {
  const bool is_in = causality == Causality::Input || causality == Causality::Parameter ||
                     causality == Causality::StructuralParameter;
  return is_in ? Flow::In : Flow::Out;
}

void read_kind(const xml::Element& element, Connector& connector,
               std::vector<std::string>& warnings) {
  const std::vector<std::string> known{
      "input",    "output", "parameter", "calculatedParameter", "structuralParameter",
      "constant", "local",  "inout",     "unspecified"};
  element.required("kind");
  const std::string kind = *element.lenient_word("kind", known, warnings);
  for (const Causality causality :
       {Causality::Input, Causality::Output, Causality::Parameter, Causality::CalculatedParameter,
        Causality::StructuralParameter, Causality::Local}) {
    if (kind != core::name(causality)) continue;
    connector.declared.causality = causality;
    connector.flow = flow_of(causality);
    return;
  }
  if (kind == "constant") connector.flow = Flow::Out;
}

/// Of the types of SSP 1.0 that may be of any width.
std::optional<ValueType> kin_of(std::string_view name) {
  if (name == "Real") return ValueType::Float64;
  return name == "Integer" ? std::optional(ValueType::Int32) : std::nullopt;
}

std::optional<ValueType> type_of(const xml::Element& type, const std::string& ssp_version) {
  const std::string_view name = type.name().local;
  if (const auto kin = kin_of(name)) return ssp_version != "1.0" ? kin : std::nullopt;
  std::vector<std::string> known{"Real", "Integer"};
  for (std::size_t i = 0; i < core::kValueTypeCount; ++i) {
    const auto candidate = static_cast<ValueType>(i);
    if (name == core::name(candidate)) return candidate;
    known.emplace_back(core::name(candidate));
  }
  type.fail(fmt::format("{} is not a type of a connector", type.tag()),
            core::suggestion(std::string(name), known));
}

/// SSP gives units of measure to floating-point numbers only.
void note_unit(const xml::Element& type, std::vector<std::string>& warnings) {
  const std::string_view name = type.name().local;
  const bool is_real = name == "Real" || name == "Float64" || name == "Float32";
  const auto unit = type.attribute("unit");
  if (is_real || !unit) return;
  warnings.push_back(core::to_text({.where = type.where()}) +
                     fmt::format("unit=\"{}\" of {} is ignored: only <ssc:Float64>, <ssc:Float32> "
                                 "and <ssc:Real> have a unit of measure",
                                 *unit, type.tag()));
}

/// The interval of a unit's clock is not changed by a connector.
void note_interval(const xml::Element& type, std::vector<std::string>& warnings) {
  for (const char* attribute :
       {"intervalDecimal", "intervalCounter", "shiftDecimal", "shiftCounter", "resolution"}) {
    if (!type.attribute(attribute)) continue;
    warnings.push_back(core::to_text({.where = type.where()}) +
                       fmt::format("{}=\"{}\" of {} is ignored: the unit's own clock holds",
                                   attribute, *type.attribute(attribute), type.tag()));
  }
}

void read_child(const xml::Element& child, const SspFile& file,
                core::ConnectorDeclaration& connector, bool& has_type,
                std::vector<std::string>& warnings) {
  const xml::Name name = child.name();
  if (name == xml::Name{kSsc, "Dimension"}) {
    connector.dimensions.push_back(read_dimension(child));
    return;
  }
  // a unit's own clocks hold; geometry and annotations change nothing
  if (name == xml::Name{kSsd, "Clock"} || name == xml::Name{kSsd, "ConnectorGeometry"} ||
      name == xml::Name{kSsd, "Annotations"} || name == xml::Name{kSsc, "MetaData"} ||
      name == xml::Name{kSsc, "Signature"}) {
    return;
  }
  if (!read_type(child, file, connector, warnings)) {
    child.fail(fmt::format("{} is not known in a connector", child.tag()),
               fmt::format("types are in the namespace '{}': <ssc:Float64/>", kSsc));
  }
  if (std::exchange(has_type, true)) {
    child.fail(fmt::format("{} is a second type of this connector", child.tag()));
  }
}

Connector read_connector(const xml::Element& element, const SspFile& file,
                         std::vector<std::string>& warnings) {
  if (const auto type = element.attribute("type")) {
    element.fail(fmt::format("{} has no attribute 'type'", element.tag()),
                 fmt::format("its type is an element in it: <ssc:{}/>", *type));
  }
  element.allow_attributes({"name", "kind"});
  Connector connector;
  connector.declared.name = element.required("name");
  connector.declared.where = element.where();
  read_kind(element, connector, warnings);
  bool has_type = false;
  for (const xml::Element& child : element.children()) {
    read_child(child, file, connector.declared, has_type, warnings);
  }
  return connector;
}

}  // namespace

core::DimensionDeclaration read_dimension(const xml::Element& dimension) {
  dimension.allow_attributes({"size", "sizeConnector"});
  if (dimension.attribute("size").has_value() == dimension.attribute("sizeConnector").has_value()) {
    dimension.fail(
        fmt::format("{} needs one of the attributes 'size' and 'sizeConnector'", dimension.tag()));
  }
  return {dimension.number<std::size_t>("size"), dimension.attribute_or("sizeConnector")};
}

bool read_type(const xml::Element& child, const SspFile& file,
               core::ConnectorDeclaration& connector, std::vector<std::string>& warnings) {
  if (child.name().name_space != kSsc) return false;
  child.allow_attributes({"unit", "name", "mime-type", "intervalVariability", "intervalDecimal",
                          "intervalCounter", "shiftDecimal", "shiftCounter", "resolution",
                          "supportsFraction", "canBeDeactivated", "priority"});
  connector.type = type_of(child, file.version);
  if (!connector.type) connector.kin = kin_of(child.name().local);
  if (connector.type == ValueType::Clock) note_interval(child, warnings);
  note_unit(child, warnings);
  connector.unit = file.definitions.unit(child.attribute_or("unit"));
  if (connector.type == ValueType::Enumeration) {
    const auto& enumerations = file.definitions.enumerations;
    const std::string name = child.attribute_or("name");
    const auto found = enumerations.find(name);
    if (found != enumerations.end()) connector.items = found->second;
    if (found == enumerations.end() && !name.empty()) {
      warnings.push_back(core::to_text({.where = child.where()}) +
                         fmt::format("nothing defines the enumeration '{}', so the items are those "
                                     "of the unit",
                                     name));
    }
  }
  return true;
}

std::vector<Connector> read_connectors(const xml::Element& owner, const SspFile& file,
                                       std::vector<std::string>& warnings) {
  std::vector<Connector> all;
  const auto connectors = owner.child({kSsd, "Connectors"});
  if (!connectors) return all;
  connectors->allow_children({{kSsd, "Connector"}});
  std::map<std::string, int> lines;
  for (const xml::Element& element : connectors->children()) {
    Connector connector = read_connector(element, file, warnings);
    const core::ConnectorDeclaration& declared = connector.declared;
    const auto [first, is_new] = lines.emplace(declared.name, declared.where.line);
    if (!is_new) {
      element.fail(fmt::format("two connectors are named '{}'; the first is in line {}",
                               declared.name, first->second));
    }
    all.push_back(std::move(connector));
  }
  return all;
}

}  // namespace stride::ssp
