#include "master/io/system_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/core/suggest.h"
#include "master/io/connectors.h"
#include "master/io/parameters.h"
#include "master/io/ssp.h"
#include "master/io/uri.h"

namespace stride::io {
namespace {

constexpr const char* kFmuType = "application/x-fmu-sharedlibrary";

void check_implementation(const xml::Element& component) {
  const std::string type = component.attribute("type").value_or(kFmuType);
  if (type == "application/x-ssp-definition" || type == "application/x-ssp-package") {
    component.fail_unsupported("a system (.ssd, .ssp) as a component of another",
                               "put its components into this file");
  }
  if (type != kFmuType) {
    component.fail_unsupported(fmt::format("components of the type '{}'", type),
                               fmt::format("the type '{}' is read", kFmuType));
  }
  const std::string implementation = component.attribute("implementation").value_or("any");
  if (implementation != "any" && implementation != "CoSimulation") {
    component.fail_unsupported(fmt::format("FMUs for '{}'", implementation),
                               "only FMUs for Co-Simulation are run");
  }
}

core::ComponentDeclaration read_component(const xml::Element& component,
                                          const std::string& version) {
  component.allow_attributes({"name", "type", "source", "implementation"});
  component.allow_children({{kSsd, "Connectors"},
                            {kSsd, "ElementGeometry"},
                            {kSsd, "ParameterBindings"},
                            {kSsc, "MetaData"},
                            {kSsc, "Signature"},
                            {kSsd, "Annotations"}});
  check_implementation(component);
  return {component.required("name"), nullptr, read_connectors(component, version),
          component.where()};
}

void add_component(const xml::Element& element, const std::string& version,
                   const std::filesystem::path& folder, SystemContent& content) {
  core::ComponentDeclaration component = read_component(element, version);
  const auto& others = content.declaration.components;
  const auto twin = std::find_if(others.begin(), others.end(),
                                 [&](const auto& other) { return other.name == component.name; });
  if (twin != others.end()) {
    element.fail(fmt::format("two components are named '{}'; the first is in line {}",
                             component.name, twin->where.line),
                 "give one of them another name");
  }
  if (!element.attribute("source")) {
    element.fail(fmt::format("the component '{}' has no source", component.name),
                 "name its FMU: source=\"unit.fmu\"");
  }
  for (ParameterValue& value : read_parameters(element, folder)) {
    content.declaration.start_values.push_back({component.name, std::move(value.name),
                                                std::move(value.value), std::move(value.unit),
                                                value.where});
  }
  content.sources.push_back(source_path(element, folder));
  content.declaration.components.push_back(std::move(component));
}

void read_elements(const xml::Element& system, const std::string& version,
                   const std::filesystem::path& folder, SystemContent& content) {
  const auto elements = system.child({kSsd, "Elements"});
  if (!elements) {
    system.fail(fmt::format("{} has no <Elements>, so there is nothing to simulate", system.tag()));
  }
  elements->allow_children(
      {{kSsd, "Component"}, {kSsd, "SignalDictionaryReference"}, {kSsd, "System"}});
  for (const xml::Element& element : elements->children()) {
    if (element.is(kSsd, "System")) {
      element.fail_unsupported("systems inside a system",
                               "put its components and connections into the outer system");
    }
    if (element.is(kSsd, "SignalDictionaryReference")) {
      element.fail_unsupported("signal dictionaries", "connect the components directly");
    }
    add_component(element, version, folder, content);
  }
  if (content.declaration.components.empty()) {
    elements->fail("the system has no component, so there is nothing to simulate");
  }
}

bool declares(const core::SystemDeclaration& system, const std::string& component,
              const std::string& connector, core::Causality causality) {
  for (const core::ComponentDeclaration& candidate : system.components) {
    if (candidate.name != component) continue;
    for (const core::ConnectorDeclaration& declared : candidate.connectors) {
      if (declared.name == connector) return declared.causality == causality;
    }
  }
  return false;
}

/// In SSP, start and end do not say which way a value flows: the kinds of the connectors do. Where
/// they are left out, the start is the output.
void orient(core::ConnectionDeclaration& connection, const core::SystemDeclaration& system) {
  const bool is_reversed =
      declares(system, connection.from_component, connection.from_connector,
               core::Causality::Input) &&
      declares(system, connection.to_component, connection.to_connector, core::Causality::Output);
  if (!is_reversed) return;
  std::swap(connection.from_component, connection.to_component);
  std::swap(connection.from_connector, connection.to_connector);
}

core::ConnectionDeclaration read_connection(const xml::Element& element) {
  element.allow_attributes({"startElement", "startConnector", "startIndices", "endElement",
                            "endConnector", "endIndices", "suppressUnitConversion"});
  element.allow_children({{kSsc, "LinearTransformation"},
                          {kSsc, "BooleanMappingTransformation"},
                          {kSsc, "IntegerMappingTransformation"},
                          {kSsc, "EnumerationMappingTransformation"},
                          {kSsd, "ConnectionGeometry"},
                          {kSsd, "Annotations"}});
  for (const xml::Element& child : element.children()) {
    if (child.name().name_space == kSsc) {
      child.fail_unsupported("transformations at a connection",
                             "let one of the two units transform the value");
    }
  }
  if (element.attribute("startIndices") || element.attribute("endIndices")) {
    element.fail_unsupported("connections of parts of an array (startIndices, endIndices)",
                             "connect the whole array");
  }
  if (!element.attribute("startElement") || !element.attribute("endElement")) {
    element.fail_unsupported("connections to a connector of the system itself",
                             "name both components: startElement and endElement");
  }
  return {element.required("startElement"),
          element.required("startConnector"),
          element.required("endElement"),
          element.required("endConnector"),
          element.flag("suppressUnitConversion", false),
          element.where()};
}

void read_connections(const xml::Element& system, core::SystemDeclaration& declaration) {
  const auto connections = system.child({kSsd, "Connections"});
  if (!connections) return;
  connections->allow_children({{kSsd, "Connection"}});
  for (const xml::Element& element : connections->children()) {
    declaration.connections.push_back(read_connection(element));
    orient(declaration.connections.back(), declaration);
  }
}

/// Splits "component.variable" at the longest name of a component that fits.
core::StartDeclaration split_name(ParameterValue value, const core::SystemDeclaration& system) {
  const std::string* found = nullptr;
  std::vector<std::string> names;
  for (const core::ComponentDeclaration& component : system.components) {
    names.push_back(component.name);
    const bool fits = value.name.starts_with(component.name + ".");
    if (fits && (found == nullptr || component.name.size() > found->size())) {
      found = &component.name;
    }
  }
  if (found == nullptr) {
    const std::string head = value.name.substr(0, value.name.find('.'));
    core::fail_input({.where = value.where},
                     fmt::format("the parameter '{}' belongs to no component; at the system, names "
                                 "read component.variable",
                                 value.name),
                     core::suggestion(head, names));
  }
  return {*found, value.name.substr(found->size() + 1), std::move(value.value),
          std::move(value.unit), value.where};
}

}  // namespace

SystemContent read_system(const xml::Element& system, const std::string& ssp_version,
                          const std::filesystem::path& folder) {
  system.allow_attributes({"name"});
  system.allow_children({{kSsd, "Connectors"},
                         {kSsd, "ElementGeometry"},
                         {kSsd, "ParameterBindings"},
                         {kSsc, "MetaData"},
                         {kSsc, "Signature"},
                         {kSsd, "Elements"},
                         {kSsd, "Connections"},
                         {kSsd, "SignalDictionaries"},
                         {kSsd, "SystemGeometry"},
                         {kSsd, "GraphicalElements"},
                         {kSsd, "Annotations"}});
  SystemContent content;
  content.declaration.name = system.required("name");
  if (const auto connectors = system.child({kSsd, "Connectors"})) {
    connectors->fail_unsupported("connectors of the system itself",
                                 "connect the components with each other");
  }
  if (const auto dictionaries = system.child({kSsd, "SignalDictionaries"})) {
    dictionaries->fail_unsupported("signal dictionaries", "connect the components directly");
  }
  read_elements(system, ssp_version, folder, content);
  read_connections(system, content.declaration);
  for (ParameterValue& value : read_parameters(system, folder)) {
    content.declaration.start_values.push_back(split_name(std::move(value), content.declaration));
  }
  return content;
}

}  // namespace stride::io
