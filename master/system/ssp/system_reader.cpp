#include "master/system/ssp/system_reader.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/files/input_file.h"
#include "master/base/text/lower_case.h"
#include "master/base/text/suggest.h"
#include "master/base/xml/document.h"
#include "master/system/ssp/connectors.h"
#include "master/system/ssp/parameters.h"
#include "master/system/ssp/signal_dictionary.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/transformation.h"
#include "master/system/ssp/uri.h"
#include "master/system/ssp/version.h"

namespace stride::ssp {
namespace {

constexpr const char* kFmuType = "application/x-fmu-sharedlibrary";
constexpr const char* kSystemType = "application/x-ssp-definition";
constexpr const char* kPackageType = "application/x-ssp-package";
constexpr std::size_t kMostNested = 64;
constexpr std::size_t kMostSystems = 10'000;

/// What a file of another kind is, for the error.
std::string kind_of(const xml::Name& root) {
  constexpr std::array<std::pair<xml::Name, const char*>, 4> kKinds{
      {{{kSsv, "ParameterSet"}, "a parameter set (.ssv)"},
       {{kSsm, "ParameterMapping"}, "a parameter mapping (.ssm)"},
       {{kSsb, "SignalDictionary"}, "a signal dictionary (.ssb)"},
       {{"", "fmiModelDescription"}, "the model description of an FMU"}}};
  for (const auto& [name, kind] : kKinds) {
    if (name == root) return kind;
  }
  if (root.local == "SystemStructureDescription") {
    return fmt::format("a <SystemStructureDescription> of the namespace '{}'", root.name_space);
  }
  return fmt::format("an XML file with the root element <{}>", root.local);
}

/// What all files have in common that one .ssd leads to.
struct Reading {
  Files& files;
  std::vector<std::string>& warnings;
  std::vector<core::Location> open{};  ///< the components that are systems, from the root on
  std::size_t systems = 0;
};

/// The systems of one .ssd.
class SystemReader {
 public:
  SystemReader(const xml::Element& root, const std::filesystem::path& path, Reading& reading)
      : root_(root),
        path_(path),
        folders_(source_folders(path)),
        file_{read_version(root, reading.warnings), read_definitions(root, kSsd, reading.warnings)},
        units_of_measure_(
            std::make_shared<const core::UnitsOfMeasure>(file_.definitions.units_of_measure)),
        reading_(reading) {}

  SystemNode read() {
    const auto system = root_.child({kSsd, "System"});
    if (!system) root_.fail(fmt::format("{} holds no <System>", root_.tag()));
    return read_system(*system);
  }

 private:
  SystemNode read_system(const xml::Element& element) {
    if (++reading_.systems > kMostSystems) {
      element.fail(fmt::format("there are more than {} systems", kMostSystems));
    }
    element.allow_attributes({"name"});
    element.allow_children({{kSsd, "Connectors"},
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
    SystemNode system;
    system.name = element.required("name");
    system.where = element.where();
    system.connectors = read_connectors(element, file_, reading_.warnings);
    if (const auto dictionaries = element.child({kSsd, "SignalDictionaries"})) {
      system.dictionaries = read_signal_dictionaries(
          *dictionaries, {reading_.files, folders_, file_.definitions, reading_.warnings});
    }
    if (const auto elements = element.child({kSsd, "Elements"})) read_elements(*elements, system);
    if (const auto connections = element.child({kSsd, "Connections"})) {
      connections->allow_children({{kSsd, "Connection"}});
      for (const xml::Element& connection : connections->children()) {
        system.connections.push_back(read_connection(connection));
      }
    }
    system.parameters = read_parameters(element, binding_context());
    return system;
  }

  BindingContext binding_context() const {
    return {reading_.files, folders_, file_.definitions, reading_.warnings};
  }

  void read_elements(const xml::Element& elements, SystemNode& system) {
    elements.allow_children(
        {{kSsd, "Component"}, {kSsd, "SignalDictionaryReference"}, {kSsd, "System"}});
    std::map<std::string, int> lines;  // by name
    for (const xml::Element& element : elements.children()) {
      ElementNode node = read_element(element);
      const auto [first, is_new] = lines.emplace(node.name, node.where.line);
      if (!is_new) {
        element.fail(fmt::format("two components are named '{}'; the first is in line {}",
                                 node.name, first->second),
                     "give one of them another name");
      }
      system.elements.push_back(std::move(node));
    }
  }

  ElementNode read_element(const xml::Element& element) {
    if (element.is(kSsd, "System")) {
      ElementNode node;
      node.name = element.required("name");
      node.where = element.where();
      node.system = std::make_unique<SystemNode>(read_system(element));
      return node;
    }
    if (element.is(kSsd, "SignalDictionaryReference")) return read_reference(element);
    return read_component(element);
  }

  /// What a component and a reference have in common.
  ElementNode read_leaf(const xml::Element& element) {
    element.allow_children({{kSsd, "Connectors"},
                            {kSsd, "ElementGeometry"},
                            {kSsd, "ParameterBindings"},
                            {kSsc, "MetaData"},
                            {kSsc, "Signature"},
                            {kSsd, "Annotations"}});
    ElementNode node;
    node.name = element.required("name");
    node.where = element.where();
    node.connectors = read_connectors(element, file_, reading_.warnings);
    return node;
  }

  ElementNode read_reference(const xml::Element& element) {
    element.allow_attributes({"name", "dictionary"});
    ElementNode node = read_leaf(element);
    node.dictionary = element.required("dictionary");
    return node;
  }

  ElementNode read_component(const xml::Element& element) {
    element.allow_attributes({"name", "type", "source", "implementation"});
    ElementNode node = read_leaf(element);
    if (!has_source(element)) {
      element.fail(fmt::format("the component '{}' has no source", node.name),
                   "name its FMU: source=\"unit.fmu\"");
    }
    if (is_system(element)) {
      read_component_system(element, node);
      return node;
    }
    check_implementation(element);
    check_kinds(element, node);
    node.source = source_path(element, folders_, reading_.warnings);
    check_package(element, node.source);
    BindingContext context = binding_context();
    context.component = node.source;
    node.parameters = read_parameters(element, context);
    node.units_of_measure = units_of_measure_;
    return node;
  }

  /// There is nothing around the folder that a package is unpacked to.
  void check_package(const xml::Element& element, const std::filesystem::path& source) const {
    const auto package = reading_.files.archive_of(path_);
    const bool leads_out = package && !reading_.files.archive_of(source);
    if (!leads_out || std::filesystem::path(source_text(element)).is_absolute()) return;
    if (core::path_exists(source)) return;
    element.fail(fmt::format("source=\"{}\" leads out of the package '{}'", source_text(element),
                             reading_.files.shown(package->path)),
                 "put the file into the package, and name it relative to this .ssd: 'stride pack "
                 "SYSTEM.ssd -o PACKAGE.ssp' does both");
  }

  /// FMI has no such variables.
  static void check_kinds(const xml::Element& component, const ElementNode& node) {
    if (node.connectors.empty()) return;
    for (const xml::Element& connector : component.child({kSsd, "Connectors"})->children()) {
      if (core::lower_case(connector.required("kind")) != "inout") continue;
      connector.fail("no variable of an FMU is of the kind 'inout'", "write input or output");
    }
  }

  void warn(const xml::Element& element, const std::string& message) {
    reading_.warnings.push_back(core::to_text({.where = element.where()}) + message);
  }

  /// Of a file that is read for each component that it is the source of.
  void warn_once(const xml::Element& element, const std::string& message) {
    warn(element, message);
    auto& warnings = reading_.warnings;
    if (std::ranges::count(warnings, warnings.back()) > 1) warnings.pop_back();
  }

  /// What is written, if that is a type, else what its source says.
  static std::string type_of(const xml::Element& component) {
    const std::string type = core::lower_case(component.attribute_or("type"));
    if (type == kFmuType || type == kSystemType || type == kPackageType) return type;
    const std::string source = core::lower_case(source_text(component));
    if (!type.empty() && !source.ends_with(".fmu")) return type;
    if (source.starts_with('#') || source.ends_with(".ssd")) return kSystemType;
    if (source.ends_with(".ssp")) return kPackageType;
    return kFmuType;
  }

  static bool is_system(const xml::Element& component) {
    const std::string type = type_of(component);
    return type == kSystemType || type == kPackageType;
  }

  void check_implementation(const xml::Element& component) {
    const std::string type = type_of(component);
    if (type != kFmuType) {
      component.fail_unsupported(fmt::format("components of the type '{}'", type),
                                 fmt::format("the types '{}', '{}' and '{}' are read", kFmuType,
                                             kSystemType, kPackageType));
    }
    const std::string written = component.attribute_or("type");
    if (!written.empty() && core::lower_case(written) != type) {
      warn(component, fmt::format("type=\"{}\" of a component is taken for '{}'", written, type));
    }
    const std::string implementation = component.attribute_or("implementation");
    const std::string word = core::lower_case(implementation);
    if (word.empty() || word == "any" || word == "cosimulation") return;
    warn(component,
         fmt::format("the FMU is meant for '{}'; stride uses its Co-Simulation interface, "
                     "if it has one",
                     implementation));
  }

  void read_component_system(const xml::Element& component, ElementNode& node) {
    const bool is_own = source_text(component).starts_with('#');
    const std::filesystem::path file = is_own ? path_ : find_system_file(component);
    node.system = std::make_unique<SystemNode>(read_nested(
        component, [&] { return is_own ? read_own_system(component) : read_file(file); }));
    BindingContext context = binding_context();
    context.component_folders = source_folders(file);
    auto& parameters = node.system->parameters;
    const std::size_t own = parameters.empty() ? 0 : parameters.back().binding;
    for (ParameterValue& value : read_parameters(component, context)) {
      value.binding += own;
      parameters.push_back(std::move(value));
    }
  }

  template <class Read>
  SystemNode read_nested(const xml::Element& component, Read&& read_inside) {
    if (reading_.open.size() >= kMostNested) {
      const core::Location& first = reading_.open.front();
      component.fail(fmt::format("more than {} systems inside each other, begun in {}:{}; one of "
                                 "them is a part of itself",
                                 kMostNested, first.file, first.line),
                     "take the component out that leads back");
    }
    reading_.open.push_back(component.where());
    SystemNode system = read_inside();
    reading_.open.pop_back();
    return system;
  }

  /// A system in this file, used once more: source="#id".
  SystemNode read_own_system(const xml::Element& component) {
    const std::string id = source_text(component).substr(1);
    if (own_systems_.empty()) own_systems_ = systems_by_id(root_);
    const auto found = own_systems_.find(id);
    if (found == own_systems_.end()) {
      component.fail(fmt::format("no <ssd:System> of this file has the id '{}'", id),
                     "write the id of a system behind the '#'");
    }
    return read_system(found->second);
  }

  std::filesystem::path find_system_file(const xml::Element& component) {
    const auto [source, variant, warning] = source_of(component, folders_);
    if (!warning.empty()) reading_.warnings.push_back(warning);
    if (!reading_.files.is_ahead(source) && !core::path_exists(source)) {
      component.fail(fmt::format("the system '{}' does not exist", reading_.files.shown(source)),
                     "its path is relative to this file");
    }
    return variant.empty() ? reading_.files.system_file(source, component.where())
                           : reading_.files.system_file(source, variant, component.where());
  }

  SystemNode read_file(const std::filesystem::path& path) {
    const xml::Document document = reading_.files.document(path);
    const xml::Element root = document.root();
    check_system_description(root);
    warn_of_own_settings(root);
    return SystemReader(root, path, reading_).read();
  }

  /// A system inside another one is no scenario.
  void warn_of_own_settings(const xml::Element& root) {
    for (const xml::Element& child : root.children()) {
      if (!child.is(kSsd, "Annotations")) continue;
      for (const xml::Element& annotation : child.children()) {
        if (annotation.attribute_or("type") != kStrideAnnotation) continue;
        warn_once(
            annotation,
            "the annotation org.stride of a system inside another one is not used: its steps, "
            "checks and recordings are those of the scenario");
      }
    }
  }

  /// With its indices, if the connection is restricted to an element: "m[1,2]".
  std::string connector(const xml::Element& connection, const std::string& end) {
    const std::string name = connection.required((end + "Connector").c_str());
    const std::string indices = end + "Indices";
    if (!connection.attribute(indices.c_str())) return name;
    warn_of_later_version(connection, indices);
    return fmt::format("{}[{}]", name,
                       fmt::join(connection.number_list<std::uint64_t>(indices.c_str()), ","));
  }

  /// Once for all connections of the file.
  void warn_of_later_version(const xml::Element& connection, const std::string& indices) {
    if (file_.version != "1.0" || std::exchange(has_later_indices_, true)) return;
    warn(connection, fmt::format("'{}' is of SSP 2.0, and this file is of SSP {}; it is used, "
                                 "here and in further connections",
                                 indices, file_.version));
  }

  SystemConnection read_connection(const xml::Element& element) {
    element.allow_attributes({"startElement", "startConnector", "startIndices", "endElement",
                              "endConnector", "endIndices", "suppressUnitConversion"});
    element.allow_children({{kSsc, "LinearTransformation"},
                            {kSsc, "BooleanMappingTransformation"},
                            {kSsc, "IntegerMappingTransformation"},
                            {kSsc, "EnumerationMappingTransformation"},
                            {kSsd, "ConnectionGeometry"},
                            {kSsc, "MetaData"},
                            {kSsc, "Signature"},
                            {kSsd, "Annotations"}});
    return {{element.attribute_or("startElement"), connector(element, "start")},
            {element.attribute_or("endElement"), connector(element, "end")},
            read_path_segment(element, reading_.warnings),
            element.where()};
  }

  xml::Element root_;
  std::filesystem::path path_;
  std::vector<std::filesystem::path> folders_;  ///< of sources
  SspFile file_;
  std::shared_ptr<const core::UnitsOfMeasure> units_of_measure_;
  Reading& reading_;
  bool has_later_indices_ = false;
  std::map<std::string, xml::Element> own_systems_;  ///< by id, when one of them was referred to
};

void collect_systems(const xml::Element& below, std::map<std::string, xml::Element>& systems) {
  for (const xml::Element& child : below.children()) {
    const auto id = child.attribute("id");
    if (id && child.is(kSsd, "System")) systems.emplace(*id, child);
    collect_systems(child, systems);
  }
}

}  // namespace

std::map<std::string, xml::Element> systems_by_id(const xml::Element& root) {
  std::map<std::string, xml::Element> systems;
  collect_systems(root, systems);
  return systems;
}

void check_system_description(const xml::Element& root) {
  if (!root.is(kSsd, "SystemStructureDescription")) {
    root.fail(fmt::format("this is {}, expected a system structure description (.ssd)",
                          kind_of(root.name())),
              fmt::format("its root element is <SystemStructureDescription> of the namespace '{}'",
                          kSsd));
  }
  root.allow_attributes({"version", "name", "author", "fileversion", "copyright", "license",
                         "generationTool", "generationDateAndTime"});
  root.allow_children({{kSsd, "System"},
                       {kSsd, "Enumerations"},
                       {kSsd, "Units"},
                       {kSsd, "DefaultExperiment"},
                       {kSsc, "MetaData"},
                       {kSsc, "Signature"},
                       {kSsd, "Annotations"}});
}

SystemNode read_system(const xml::Element& root, const std::filesystem::path& path, Files& files,
                       std::vector<std::string>& warnings) {
  Reading reading{files, warnings};
  return SystemReader(root, path, reading).read();
}

}  // namespace stride::ssp
