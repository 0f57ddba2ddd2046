#include "master/system/ssp/parameters.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/limited_warnings.h"
#include "master/base/xml/document.h"
#include "master/system/ssp/connectors.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/transformation.h"
#include "master/system/ssp/unique_names.h"
#include "master/system/ssp/uri.h"
#include "master/system/ssp/version.h"

namespace stride::ssp {
namespace {

constexpr const char* kParameterSetType = "application/x-ssp-parameter-set";
constexpr const char* kMappingType = "application/x-ssp-parameter-mapping";

/// Whether a value of the type of that name is a whole number.
bool is_integer_type(std::string_view name) {
  return name == "Integer" || name.starts_with("Int") || name.starts_with("UInt");
}

/// Several elements, each in a <Value> of its own, as the text form of an array.
std::string listed_value(const xml::Element& type, const std::vector<xml::Element>& values) {
  std::string joined;
  for (const xml::Element& value : values) {
    value.allow_attributes({"value"});
    const auto text = value.attribute("value");
    if (!text) value.fail(fmt::format("{} needs the attribute 'value'", value.tag()));
    const bool may_have_blanks = type.name().local == "Enumeration";  // its items are known by name
    const bool has_blanks = text->find_first_of(" \t\r\n") != text->npos;
    if (values.size() > 1 && (text->empty() || (has_blanks && !may_have_blanks))) {
      type.fail_unsupported(
          fmt::format("an array with an element that is empty or has blanks: \"{}\"", *text));
    }
    joined += (joined.empty() ? "" : " ") + *text;
  }
  return joined;
}

ParameterValue read_value(const xml::Element& type, const Definitions& inside,
                          const Definitions& around) {
  constexpr std::array<std::string_view, 16> kTypes{
      "Real",  "Float64", "Float32", "Integer", "Int8",    "UInt8",  "Int16",       "UInt16",
      "Int32", "UInt32",  "Int64",   "UInt64",  "Boolean", "String", "Enumeration", "Binary"};
  const std::string_view name = type.name().local;
  if (type.name().name_space != kSsv ||
      std::find(kTypes.begin(), kTypes.end(), name) == kTypes.end()) {
    type.fail(fmt::format("{} is not a type of a parameter", type.tag()),
              "write one such as <ssv:Float64 value=\"…\"/>, <ssv:Int32 …/> or <ssv:Boolean …/>");
  }
  type.allow_attributes({"value", "unit", "name", "mime-type"});
  type.allow_children({{kSsv, "Value"}});
  ParameterValue parameter;
  parameter.where = type.where();
  parameter.is_integer = is_integer_type(name);
  parameter.unit = inside.unit(type.attribute_or("unit"), around);
  const std::vector<xml::Element> values = type.children({kSsv, "Value"});
  const auto value = type.attribute("value");
  if (value && !values.empty()) {
    type.fail(fmt::format("{} has both an attribute 'value' and elements <Value>", type.tag()),
              "keep one of the two");
  }
  if (!value && values.empty())
    type.fail(fmt::format("{} needs the attribute 'value'", type.tag()));
  parameter.value = value ? *value : listed_value(type, values);
  return parameter;
}

ParameterValue read_parameter(const xml::Element& parameter, const Definitions& inside,
                              const Definitions& around) {
  if (const auto type = parameter.attribute("type")) {
    parameter.fail(fmt::format("{} has no attribute 'type'", parameter.tag()),
                   fmt::format("its value is an element in it: <ssv:{} value=\"…\"/>", *type));
  }
  parameter.allow_attributes({"name"});
  std::optional<ParameterValue> result;
  std::vector<core::DimensionDeclaration> dimensions;
  for (const xml::Element& child : parameter.children()) {
    if (child.is(kSsc, "Annotations") || child.is(kSsv, "Annotations")) continue;
    if (child.is(kSsc, "MetaData") || child.is(kSsc, "Signature")) continue;
    if (child.is(kSsc, "Dimension")) {
      dimensions.push_back(read_dimension(child));
      continue;
    }
    if (result) child.fail(fmt::format("{} has two values", parameter.tag()));
    result = read_value(child, inside, around);
  }
  if (!result) {
    parameter.fail(fmt::format("{} holds no value", parameter.tag()),
                   "write one such as <ssv:Float64 value=\"…\"/> into it");
  }
  result->name = parameter.required("name");
  result->dimensions = std::move(dimensions);
  return *result;
}

bool is_same(const ParameterValue& a, const ParameterValue& b) {
  return a.value == b.value && a.unit.name == b.unit.name;
}

std::vector<ParameterValue> read_set(const xml::Element& set, const Definitions& around,
                                     std::vector<std::string>& warnings) {
  if (!set.is(kSsv, "ParameterSet")) {
    set.fail(fmt::format("{} is not a parameter set", set.tag()),
             fmt::format("expected <ParameterSet> of the namespace '{}'", kSsv));
  }
  set.allow_attributes({"version", "name", "author", "fileversion", "copyright", "license",
                        "generationTool", "generationDateAndTime"});
  read_version(set, warnings);
  set.allow_children({{kSsv, "Parameters"},
                      {kSsv, "Enumerations"},
                      {kSsv, "Units"},
                      {kSsc, "MetaData"},
                      {kSsc, "Signature"},
                      {kSsv, "Annotations"}});
  const auto parameters = set.child({kSsv, "Parameters"});
  if (!parameters) set.fail(fmt::format("{} holds no <Parameters>", set.tag()));
  parameters->allow_children({{kSsv, "Parameter"}});
  const Definitions inside = read_definitions(set, kSsv, warnings);
  std::vector<ParameterValue> values;
  std::map<std::string, std::size_t> places;
  UniqueNames names("parameters", warnings);
  for (const xml::Element& parameter : parameters->children()) {
    ParameterValue value = read_parameter(parameter, inside, around);
    const std::size_t place = places.emplace(value.name, values.size()).first->second;
    if (names.add(parameter, value.name, [&] { return is_same(values[place], value); })) {
      values.push_back(std::move(value));
    }
  }
  return values;
}

/// The folders that sources with sourceBase="component" are relative to.
std::vector<std::filesystem::path> component_folders(const xml::Element& owner,
                                                     const BindingContext& context) {
  if (!context.component_folders.empty()) return context.component_folders;
  if (context.component.empty()) {
    owner.fail("only a component can hold its own parameters",
               "name a file relative to this one, without sourceBase");
  }
  return {context.files.unit_folder(context.component, owner.where())};
}

/// What a binding or its mapping names, in a file or in a component.
xml::Document open(const xml::Element& owner, const BindingContext& context, const char* what) {
  const std::string base = owner.attribute_or("sourceBase", "SSD");
  if (base != "SSD" && base != "component") {
    owner.fail(fmt::format("the sourceBase '{}' is not known", base),
               "it is SSD, or component for what is inside the component's FMU");
  }
  const std::vector<std::filesystem::path> folders =
      base == "component" ? component_folders(owner, context) : context.folders;
  const std::filesystem::path path = source_path(owner, folders, context.warnings);
  if (context.files.is_ahead(path)) return context.files.document(path);
  if (const std::string reason = core::why_unreachable(path); !reason.empty()) {
    owner.fail(fmt::format("cannot reach the {} '{}': {}", what, context.files.shown(path), reason),
               "check its path");
  }
  if (!core::path_exists(path)) {
    owner.fail(fmt::format("the {} '{}' does not exist", what, context.files.shown(path)),
               base == "SSD" ? "its path is relative to this file"
                             : "its path is relative to the top of the component's FMU or package");
  }
  return context.files.document(path);
}

/// Likewise, what the command line names.
xml::Document open(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  xml::Document document(file, "", kPrefixes);
  warnings.insert(warnings.end(), document.warnings().begin(), document.warnings().end());
  return document;
}

std::vector<ParameterValue> read_values(const xml::Element& binding,
                                        const BindingContext& context) {
  const auto inline_values = binding.child({kSsd, "ParameterValues"});
  if (has_source(binding)) {
    if (inline_values) {
      inline_values->fail("a binding with a source cannot have values of its own, too",
                          "split it into two bindings");
    }
    return read_set(open(binding, context, "parameter set").root(), {}, context.warnings);
  }
  if (!inline_values) {
    binding.fail(fmt::format("{} has neither a source nor <ParameterValues>", binding.tag()));
  }
  inline_values->allow_children({{kSsv, "ParameterSet"}});
  const auto set = inline_values->child({kSsv, "ParameterSet"});
  if (!set) inline_values->fail(fmt::format("{} holds no <ParameterSet>", inline_values->tag()));
  return read_set(*set, context.definitions, context.warnings);
}

void check_mapping(const xml::Element& mapping, std::vector<std::string>& warnings) {
  if (!mapping.is(kSsm, "ParameterMapping")) {
    mapping.fail(fmt::format("{} is not a parameter mapping", mapping.tag()),
                 fmt::format("expected <ParameterMapping> of the namespace '{}'", kSsm));
  }
  mapping.allow_attributes({"version", "author", "fileversion", "copyright", "license",
                            "generationTool", "generationDateAndTime"});
  read_version(mapping, warnings);
  mapping.allow_children(
      {{kSsm, "MappingEntry"}, {kSsc, "MetaData"}, {kSsc, "Signature"}, {kSsm, "Annotations"}});
}

void check_entry(const xml::Element& entry) {
  entry.allow_attributes({"source", "target", "suppressUnitConversion"});
  entry.allow_children({{kSsc, "LinearTransformation"},
                        {kSsc, "BooleanMappingTransformation"},
                        {kSsc, "IntegerMappingTransformation"},
                        {kSsc, "EnumerationMappingTransformation"},
                        {kSsm, "Annotations"}});
}

/// Appends the values that the entry maps, with their new name; returns whether there are any.
bool map_values_of(const xml::Element& entry, const std::vector<ParameterValue>& values,
                   std::vector<std::string>& warnings, std::vector<ParameterValue>& mapped) {
  const std::size_t before = mapped.size();
  for (const ParameterValue& value : values) {
    if (value.name != entry.given("source")) continue;
    mapped.push_back(value);
    mapped.back().name = entry.required("target");
    mapped.back().segment = read_path_segment(entry, warnings);
  }
  return mapped.size() > before;
}

/// SSP 2.0, "ParameterMapping": what is not mapped is not applied, a parameter may get several
/// names, and no name two parameters.
std::vector<ParameterValue> map_values(const xml::Element& mapping,
                                       const std::vector<ParameterValue>& values,
                                       std::vector<std::string>& warnings) {
  check_mapping(mapping, warnings);
  std::vector<ParameterValue> mapped;
  std::set<std::string> targets;
  core::LimitedWarnings missing(warnings, "entries whose parameter the set does not have");
  for (const xml::Element& entry : mapping.children({kSsm, "MappingEntry"})) {
    check_entry(entry);
    const std::string source = entry.given("source");
    const std::string target = entry.required("target");
    if (!targets.insert(target).second) {
      entry.fail(fmt::format("two parameters are mapped to '{}'", target),
                 "keep one of the two entries");
    }
    if (map_values_of(entry, values, warnings, mapped)) continue;
    if (!missing.count()) continue;
    missing.add(core::to_text({.where = entry.where()}) +
                fmt::format("the parameter set has no '{}' to be mapped to '{}'", source, target));
  }
  missing.finish();
  return mapped;
}

std::vector<ParameterValue> read_mapped(const xml::Element& mapping,
                                        const std::vector<ParameterValue>& values,
                                        const BindingContext& context) {
  mapping.allow_attributes({"type", "source", "sourceBase"});
  mapping.allow_children({{kSsm, "ParameterMapping"}});
  const std::string type = mapping.attribute_or("type", kMappingType);
  if (type != kMappingType) {
    mapping.fail_unsupported(fmt::format("parameter mappings of the type '{}'", type),
                             fmt::format("the type '{}' is read", kMappingType));
  }
  const auto inside = mapping.child({kSsm, "ParameterMapping"});
  if (has_source(mapping)) {
    if (inside) inside->fail("a mapping with a source cannot have entries of its own, too");
    return map_values(open(mapping, context, "parameter mapping").root(), values, context.warnings);
  }
  if (!inside) {
    mapping.fail(fmt::format("{} has neither a source nor <ssm:ParameterMapping>", mapping.tag()));
  }
  return map_values(*inside, values, context.warnings);
}

std::vector<ParameterValue> read_binding(const xml::Element& binding,
                                         const BindingContext& context) {
  binding.allow_attributes({"type", "source", "sourceBase", "prefix"});
  binding.allow_children({{kSsd, "ParameterValues"},
                          {kSsd, "ParameterMapping"},
                          {kSsc, "MetaData"},
                          {kSsc, "Signature"},
                          {kSsd, "Annotations"}});
  const std::string type = binding.attribute_or("type", kParameterSetType);
  if (type != kParameterSetType) {
    binding.fail_unsupported(fmt::format("parameters of the type '{}'", type),
                             fmt::format("the type '{}' is read", kParameterSetType));
  }
  std::vector<ParameterValue> values = read_values(binding, context);
  const std::string prefix = binding.attribute_or("prefix");
  for (ParameterValue& value : values) value.name.insert(0, prefix);
  const auto mapping = binding.child({kSsd, "ParameterMapping"});
  return mapping ? read_mapped(*mapping, values, context) : values;
}

}  // namespace

std::vector<ParameterValue> read_parameters(const xml::Element& owner,
                                            const BindingContext& context) {
  std::vector<ParameterValue> values;
  const std::vector<xml::Element> lists = owner.children({kSsd, "ParameterBindings"});
  std::size_t count = 0;
  for (const xml::Element& bindings : lists) {
    bindings.allow_children({{kSsd, "ParameterBinding"}});
    for (const xml::Element& binding : bindings.children()) {
      std::vector<ParameterValue> read = read_binding(binding, context);
      ++count;
      for (ParameterValue& value : read) value.binding = count;
      values.insert(values.end(), std::make_move_iterator(read.begin()),
                    std::make_move_iterator(read.end()));
    }
  }
  if (lists.size() > 1) {
    context.warnings.push_back(
        core::to_text({.where = lists[1].where()}) +
        fmt::format("a second {} in {}: both are used, though SSP allows one only", lists[1].tag(),
                    owner.tag()));
  }
  return values;
}

std::vector<ParameterValue> read_parameter_set(const std::filesystem::path& file,
                                               std::vector<std::string>& warnings) {
  return read_set(open(file, warnings).root(), {}, warnings);
}

std::vector<ParameterValue> map_parameters(const std::filesystem::path& mapping,
                                           const std::vector<ParameterValue>& values,
                                           std::vector<std::string>& warnings) {
  return map_values(open(mapping, warnings).root(), values, warnings);
}

}  // namespace stride::ssp
