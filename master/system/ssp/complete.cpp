#include "master/system/ssp/complete.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <stride/xml_text.h>

#include "master/base/xml/document.h"
#include "master/base/xml/editor.h"
#include "master/engine/model/array_element.h"
#include "master/system/ssp/definitions.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/system_reader.h"
#include "master/system/ssp/uri.h"
#include "master/system/ssp/version.h"

namespace stride::ssp {
namespace {

using core::ValueType;

/// The namespace prefix, ready to be put before a name: "ssc:" or nothing.
std::string head(const std::string& prefix) { return prefix.empty() ? "" : prefix + ":"; }

/// The number of elements that it consists of, itself included.
std::size_t count(const xml::Element& element) {
  std::size_t elements = 1;
  for (const xml::Element& child : element.children()) elements += count(child);
  return elements;
}

/// The index of a child that is there, from that of its parent: Element::index() counts from the
/// beginning of the file, which takes too long for each of many components.
std::size_t index_within(const xml::Element& parent, std::size_t parent_index, const char* name) {
  std::size_t index = parent_index + 1;
  for (const xml::Element& child : parent.children()) {
    if (child.is(kSsd, name)) break;
    index += count(child);
  }
  return index;
}

class Completion {
 public:
  Completion(const xml::Document& document, const Descriptions& descriptions)
      : root_(document.root()),
        descriptions_(descriptions),
        is_first_version_(read_version(root_, said_before_) == "1.0"),
        ssd_(head(root_.prefix_of(kSsd).value_or(""))),
        editor_(document.text()) {
    find_common_prefix();
    const Definitions definitions = read_definitions(root_, kSsd, said_before_);
    units_ = definitions.units_of_measure;
    for (const auto& [name, items] : definitions.enumerations) enumerations_.insert(name);
  }

  /// As they are understood, for tools that do not. `written`: the root as it is in the file.
  void declare_namespaces(const xml::Element& written) {
    for (const xml::Prefix& prefix : kPrefixes) {
      const std::string name = fmt::format("xmlns:{}", prefix.name);
      const auto meant = root_.attribute(name.c_str());
      const auto before = written.attribute(name.c_str());
      if (meant == before) continue;
      if (before) {
        editor_.set_attribute(root_.index(), name, *meant);
      } else {
        editor_.add_attribute(root_.index(), name, *meant);
      }
    }
  }

  std::string result(std::span<const core::ConnectionDeclaration> connections) {
    const xml::Element system = *root_.child({kSsd, "System"});
    collect_uses(system, system.index(), "");
    complete_elements(system, system.index(), "");
    define_named_units(root_);
    add_connections(system, connections);
    add_list("Enumerations", new_enumerations_);
    add_list("Units", new_units_);
    return editor_.result();
  }

 private:
  void find_common_prefix() {
    if (const auto prefix = root_.prefix_of(kSsc)) {
      ssc_ = head(*prefix);
      return;
    }
    ssc_ = root_.attribute("xmlns:ssc") ? "stride_ssc:" : "ssc:";
    needs_common_prefix_ = true;
  }

  /// Declares the prefix once, when something is written that uses it.
  const std::string& ssc() {
    if (needs_common_prefix_) {
      editor_.add_attribute(root_.index(), "xmlns:" + ssc_.substr(0, ssc_.size() - 1), kSsc);
    }
    needs_common_prefix_ = false;
    return ssc_;
  }

  /// A system is one component, and others may be further ones of it: source="#id". `index` is that
  /// of the system.
  void collect_uses(const xml::Element& system, std::size_t index, const std::string& prefix) {
    const auto elements = system.child({kSsd, "Elements"});
    if (!elements) return;
    index = index_within(system, index, "Elements") + 1;
    for (const xml::Element& element : elements->children()) {
      const std::string path = prefix + element.required("name");
      const std::string source = element.is(kSsd, "Component") ? source_text(element) : "";
      if (element.is(kSsd, "System")) {
        collect_uses(element, index, path + ".");
      } else if (source.starts_with('#')) {
        const xml::Element& used = own_systems().at(source.substr(1));
        collect_uses(used, used.index(), path + ".");
      } else if (const auto found = descriptions_.find(path); found != descriptions_.end()) {
        uses_[index].push_back(found->second.get());
      }
      index += count(element);
    }
  }

  const std::map<std::string, xml::Element>& own_systems() {
    if (own_systems_.empty()) own_systems_ = systems_by_id(root_);
    return own_systems_;
  }

  /// `index` is that of the system.
  void complete_elements(const xml::Element& system, std::size_t index, const std::string& prefix) {
    const auto elements = system.child({kSsd, "Elements"});
    if (!elements) return;
    index = index_within(system, index, "Elements") + 1;
    for (const xml::Element& element : elements->children()) {
      const std::string path = prefix + element.required("name");
      if (element.is(kSsd, "System")) {
        complete_elements(element, index, path + ".");
      } else if (const auto found = descriptions_.find(path); found != descriptions_.end()) {
        complete_component(element, index, path, *found->second);
      }
      index += count(element);
    }
  }

  void complete_component(const xml::Element& component, std::size_t index, const std::string& path,
                          const core::UnitDescription& description) {
    const auto connectors = component.child({kSsd, "Connectors"});
    std::set<std::string> declared;
    if (connectors) {
      for (const xml::Element& child : connectors->children()) {
        declared.insert(child.required("name"));
        for (const xml::Element& type : child.children()) {
          declared_unit(description, type.attribute_or("unit"));
        }
      }
    }
    std::vector<std::string> added;
    for (const core::Variable& variable : description.variables) {
      const bool is_connector = variable.causality == core::Causality::Input ||
                                variable.causality == core::Causality::Output;
      if (!is_connector || declared.contains(variable.name)) continue;
      added.push_back(
          connector(component, path, description, variable, is_sized_alike(index, variable)));
    }
    if (added.empty()) return;
    if (connectors) {
      return editor_.append_children(index_within(component, index, "Connectors"), added);
    }
    std::string list = fmt::format("<{}Connectors>", ssd_);
    for (const std::string& piece : added) list += "\n\t" + piece;
    editor_.prepend_children(index, {list + fmt::format("\n</{}Connectors>", ssd_)});
  }

  /// Whether the component at this place of the file has the variable in one size, wherever its
  /// system is used.
  bool is_sized_alike(std::size_t index, const core::Variable& variable) const {
    const auto uses = uses_.find(index);
    return uses == uses_.end() ||
           std::ranges::all_of(uses->second, [&](const core::UnitDescription* used) {
             const auto same =
                 std::ranges::find(used->variables, variable.name, &core::Variable::name);
             return same == used->variables.end() || core::sizes(*same) == core::sizes(variable);
           });
  }

  std::string connector(const xml::Element& component, const std::string& path,
                        const core::UnitDescription& description, const core::Variable& variable,
                        bool has_known_size) {
    std::string content = type(component, path, description, variable);
    if (!is_first_version_) {
      content += (has_known_size ? dimensions(variable) : "") + clocks(description, variable);
    }
    const std::string start = fmt::format("<{}Connector name=\"{}\" kind=\"{}\"", ssd_,
                                          xml_escaped(variable.name), name(variable.causality));
    if (content.empty()) return start + "/>";
    return fmt::format("{}>{}</{}Connector>", start, content, ssd_);
  }

  std::string type(const xml::Element& component, const std::string& path,
                   const core::UnitDescription& description, const core::Variable& variable) {
    switch (variable.type) {
      case ValueType::Float32:
      case ValueType::Float64: {
        const std::string unit = declared_unit(description, variable.unit);
        const char* word = is_first_version_ ? "Real" : core::name(variable.type);
        return unit.empty() ? fmt::format("<{}{}/>", ssc(), word)
                            : fmt::format("<{}{} unit=\"{}\"/>", ssc(), word, xml_escaped(unit));
      }
      case ValueType::Enumeration:
        return enumeration(path + "." + variable.name, variable);
      case ValueType::Clock:
        return clock(component, variable);
      case ValueType::Boolean:
      case ValueType::String:
      case ValueType::Binary:
        return fmt::format("<{}{}/>", ssc(), core::name(variable.type));
      default:
        return fmt::format("<{}{}/>", ssc(),
                           is_first_version_ ? "Integer" : core::name(variable.type));
    }
  }

  std::string clock(const xml::Element& component, const core::Variable& variable) {
    if (is_first_version_) {
      component.fail(fmt::format("SSP 1.0 has no clocks, so '{}.{}' cannot be declared",
                                 component.required("name"), variable.name),
                     "write version=\"2.0\" in the root element");
    }
    return !variable.clock ? fmt::format("<{}Clock/>", ssc())
                           : fmt::format("<{}Clock intervalVariability=\"{}\"/>", ssc(),
                                         name(variable.clock->variability));
  }

  std::string enumeration(const std::string& enumeration_name, const core::Variable& variable) {
    if (variable.items.empty()) return "";
    if (enumerations_.insert(enumeration_name).second) {
      std::string text =
          fmt::format("<{}Enumeration name=\"{}\">", ssc(), xml_escaped(enumeration_name));
      for (const auto& [item, value] : variable.items) {
        text +=
            fmt::format("\n\t<{}Item name=\"{}\" value=\"{}\"/>", ssc(), xml_escaped(item), value);
      }
      new_enumerations_.push_back(text + fmt::format("\n</{}Enumeration>", ssc()));
    }
    return fmt::format("<{}Enumeration name=\"{}\"/>", ssc(), xml_escaped(enumeration_name));
  }

  /// Those that the types of connectors and of signals in the file name already. Parameter sets
  /// have definitions of their own.
  void define_named_units(const xml::Element& element) {
    if (element.name().name_space == kSsc && !element.is(kSsc, "Unit")) {
      const std::string unit = element.attribute_or("unit");
      const auto meaning = unit.empty() ? std::nullopt : find_unit_of_measure(unit);
      if (meaning) define_unit(unit, *meaning);
    }
    for (const xml::Element& child : element.children()) define_named_units(child);
  }

  /// Adds its definition where the file has none. Returns whether it means this in the file.
  bool define_unit(const std::string& unit, const core::BaseUnitOfMeasure& meaning) {
    const auto [known, is_new] = units_.emplace(unit, meaning);
    if (is_new) new_units_.push_back(unit_definition(unit, meaning));
    return core::is_same(known->second, meaning);
  }

  /// The unit's name if the file can define it; otherwise nothing, and the FMU's own unit holds.
  /// What the FMU does not define is what the file or the table of known symbols says.
  std::string declared_unit(const core::UnitDescription& description, const std::string& unit) {
    if (unit.empty()) return "";
    const auto own = description.units_of_measure.find(unit);
    if (own != description.units_of_measure.end()) {
      return define_unit(unit, own->second) ? unit : "";
    }
    if (units_.contains(unit)) return unit;
    const auto known = find_unit_of_measure(unit);
    return known && define_unit(unit, *known) ? unit : "";
  }

  std::string unit_definition(const std::string& unit, const core::BaseUnitOfMeasure& base) {
    std::string attributes;
    for (std::size_t i = 0; i < stride::kUnitOfMeasureBases.size(); ++i) {
      if (base.exponents[i] == 0) continue;
      attributes += fmt::format(" {}=\"{}\"", stride::kUnitOfMeasureBases[i], base.exponents[i]);
    }
    if (base.factor != 1)
      attributes += fmt::format(" factor=\"{}\"", static_cast<double>(base.factor));
    if (base.offset != 0)
      attributes += fmt::format(" offset=\"{}\"", static_cast<double>(base.offset));
    return fmt::format("<{0}Unit name=\"{1}\"><{0}BaseUnit{2}/></{0}Unit>", ssc(),
                       xml_escaped(unit), attributes);
  }

  std::string dimensions(const core::Variable& variable) {
    std::string text;
    for (const core::Dimension& dimension : variable.dimensions) {
      text += fmt::format("<{}Dimension size=\"{}\"/>", ssc(), dimension.size);
    }
    return text;
  }

  std::string clocks(const core::UnitDescription& description, const core::Variable& variable) {
    std::string text;
    for (const core::ValueReference reference : variable.clocks) {
      const core::Variable& clock = description.variables[*description.find(reference)];
      text += fmt::format("<{}Clock name=\"{}\"/>", ssd_, xml_escaped(clock.name));
    }
    return text;
  }

  void add_connections(const xml::Element& system,
                       std::span<const core::ConnectionDeclaration> connections) {
    const auto elements = system.child({kSsd, "Elements"});
    const auto list = system.child({kSsd, "Connections"});
    std::vector<std::string> added;
    for (const core::ConnectionDeclaration& connection : connections) {
      const bool is_outermost = connection.from_component.find('.') == std::string::npos &&
                                connection.to_component.find('.') == std::string::npos;
      if (is_outermost && !(list && holds(*list, connection))) {
        added.push_back(connection_text(connection));
      }
    }
    if (added.empty() || !elements) return;
    if (list) return editor_.append_children(list->index(), added);
    std::string text = fmt::format("<{}Connections>", ssd_);
    for (const std::string& piece : added) text += "\n\t" + piece;
    editor_.insert_behind(elements->index(), text + fmt::format("\n</{}Connections>", ssd_));
  }

  static bool holds(const xml::Element& list, const core::ConnectionDeclaration& wanted) {
    return std::ranges::any_of(list.children(), [&](const xml::Element& connection) {
      return connection.attribute_or("startElement") == wanted.from_component &&
             connection.attribute_or("startConnector") == wanted.from_connector &&
             connection.attribute_or("endElement") == wanted.to_component &&
             connection.attribute_or("endConnector") == wanted.to_connector;
    });
  }

  std::string connection_text(const core::ConnectionDeclaration& connection) const {
    return fmt::format(
        "<{}Connection startElement=\"{}\" startConnector=\"{}\" endElement=\"{}\" "
        "endConnector=\"{}\"/>",
        ssd_, xml_escaped(connection.from_component), xml_escaped(connection.from_connector),
        xml_escaped(connection.to_component), xml_escaped(connection.to_connector));
  }

  /// Adds to a list below the root element, or makes it: behind <System>, and <Units> behind
  /// <Enumerations>, as the schema requires.
  void add_list(const char* list, const std::vector<std::string>& pieces) {
    if (pieces.empty()) return;
    if (const auto found = root_.child({kSsd, list})) {
      return editor_.append_children(found->index(), pieces);
    }
    std::string text = fmt::format("<{}{}>", ssd_, list);
    for (const std::string& piece : pieces) {
      text += "\n\t";
      for (const char c : piece) text += c == '\n' ? "\n\t" : std::string(1, c);
    }
    const auto enumerations = root_.child({kSsd, "Enumerations"});
    const xml::Element before = enumerations ? *enumerations : *root_.child({kSsd, "System"});
    editor_.insert_behind(before.index(), text + fmt::format("\n</{}{}>", ssd_, list));
  }

  xml::Element root_;
  const Descriptions& descriptions_;
  std::vector<std::string> said_before_;  ///< warnings, when the scenario was read
  bool is_first_version_;
  std::string ssd_;
  std::string ssc_;
  bool needs_common_prefix_ = false;
  xml::Editor editor_;
  core::UnitsOfMeasure units_;
  std::set<std::string> enumerations_;
  std::map<std::string, xml::Element> own_systems_;  ///< by id
  /// The descriptions of the components that one place of the file stands for, by its index.
  std::map<std::size_t, std::vector<const core::UnitDescription*>> uses_;
  std::vector<std::string> new_units_;
  std::vector<std::string> new_enumerations_;
};

}  // namespace

std::string complete(const std::filesystem::path& path, const Descriptions& descriptions,
                     const std::string& shown_as,
                     std::span<const core::ConnectionDeclaration> connections) {
  const xml::Document document(path, shown_as, kPrefixes);
  const xml::Element root = document.root();
  check_system_description(root);
  if (!root.child({kSsd, "System"})) root.fail(fmt::format("{} holds no <System>", root.tag()));
  Completion completion(document, descriptions);
  completion.declare_namespaces(xml::Document(path, shown_as).root());
  return completion.result(connections);
}

}  // namespace stride::ssp
