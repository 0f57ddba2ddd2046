#include "master/io/connectors.h"

#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "master/core/suggest.h"
#include "master/io/ssp.h"

namespace stride::io {
namespace {

using core::Causality;
using core::ValueType;

std::optional<Causality> read_kind(const xml::Element& connector) {
  const std::string kind = connector.required("kind");
  for (const Causality causality :
       {Causality::Input, Causality::Output, Causality::Parameter, Causality::CalculatedParameter,
        Causality::StructuralParameter, Causality::Local}) {
    if (kind == core::name(causality)) return causality;
  }
  if (kind == "constant" || kind == "unspecified") return std::nullopt;
  if (kind == "inout") {
    connector.fail("no variable of an FMU is of the kind 'inout'", "write input or output");
  }
  const std::vector<std::string> known{
      "input",    "output", "parameter", "calculatedParameter", "structuralParameter",
      "constant", "local",  "inout",     "unspecified"};
  connector.fail(fmt::format("the kind '{}' is not known", kind), core::suggestion(kind, known));
}

std::optional<ValueType> read_type(const xml::Element& type, const std::string& ssp_version) {
  const std::string_view name = type.name().local;
  const bool has_width = ssp_version != "1.0";
  if (name == "Real") return has_width ? std::optional(ValueType::Float64) : std::nullopt;
  if (name == "Integer") return has_width ? std::optional(ValueType::Int32) : std::nullopt;
  std::vector<std::string> known{"Real", "Integer"};
  for (std::size_t i = 0; i < core::kValueTypeCount; ++i) {
    const auto candidate = static_cast<ValueType>(i);
    if (name == core::name(candidate)) return candidate;
    known.emplace_back(core::name(candidate));
  }
  type.fail(fmt::format("{} is no type of a connector", type.tag()),
            core::suggestion(std::string(name), known));
}

void read_child(const xml::Element& child, const std::string& ssp_version,
                core::ConnectorDeclaration& connector, bool& has_type) {
  const xml::Name name = child.name();
  // a unit's own dimensions and clocks hold; geometry and annotations change nothing
  if (name == xml::Name{kSsc, "Dimension"} || name == xml::Name{kSsd, "Clock"} ||
      name == xml::Name{kSsd, "ConnectorGeometry"} || name == xml::Name{kSsd, "Annotations"}) {
    return;
  }
  if (name.name_space != kSsc) {
    child.fail(fmt::format("{} is not known in a connector", child.tag()),
               fmt::format("a type stands in the namespace '{}': <ssc:Float64/>", kSsc));
  }
  if (has_type) child.fail(fmt::format("{} is a second type of this connector", child.tag()));
  has_type = true;
  connector.type = read_type(child, ssp_version);
  connector.unit = child.attribute("unit").value_or("");
}

core::ConnectorDeclaration read_connector(const xml::Element& element,
                                          const std::string& ssp_version) {
  element.allow_attributes({"name", "kind"});
  core::ConnectorDeclaration connector;
  connector.name = element.required("name");
  connector.causality = read_kind(element);
  connector.where = element.where();
  bool has_type = false;
  for (const xml::Element& child : element.children()) {
    read_child(child, ssp_version, connector, has_type);
  }
  return connector;
}

}  // namespace

std::vector<core::ConnectorDeclaration> read_connectors(const xml::Element& component,
                                                        const std::string& ssp_version) {
  std::vector<core::ConnectorDeclaration> declared;
  const auto connectors = component.child({kSsd, "Connectors"});
  if (!connectors) return declared;
  connectors->allow_children({{kSsd, "Connector"}});
  std::map<std::string, int> lines;
  for (const xml::Element& element : connectors->children()) {
    core::ConnectorDeclaration connector = read_connector(element, ssp_version);
    const auto [first, is_new] = lines.emplace(connector.name, connector.where.line);
    if (!is_new) {
      element.fail(fmt::format("two connectors are named '{}'; the first is in line {}",
                               connector.name, first->second));
    }
    declared.push_back(std::move(connector));
  }
  return declared;
}

}  // namespace stride::io
