#include "master/io/parameters.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "master/io/ssp.h"
#include "master/io/uri.h"
#include "master/xml/document.h"

namespace stride::io {
namespace {

constexpr const char* kParameterSetType = "application/x-ssp-parameter-set";

/// Several elements, each in a <Value> of its own, as the text form of an array.
std::string listed_value(const xml::Element& type, const std::vector<xml::Element>& values) {
  std::string joined;
  for (const xml::Element& value : values) {
    value.allow_attributes({"value"});
    const auto text = value.attribute("value");
    if (!text) value.fail(fmt::format("{} needs the attribute 'value'", value.tag()));
    if (values.size() > 1 && (text->empty() || text->find_first_of(" \t\r\n") != text->npos)) {
      type.fail_unsupported(
          fmt::format("an array with an element that is empty or has blanks: \"{}\"", *text));
    }
    joined += (joined.empty() ? "" : " ") + *text;
  }
  return joined;
}

ParameterValue read_value(const xml::Element& type) {
  constexpr std::array<std::string_view, 16> kTypes{
      "Real",  "Float64", "Float32", "Integer", "Int8",    "UInt8",  "Int16",       "UInt16",
      "Int32", "UInt32",  "Int64",   "UInt64",  "Boolean", "String", "Enumeration", "Binary"};
  const std::string_view name = type.name().local;
  if (type.name().name_space != kSsv ||
      std::find(kTypes.begin(), kTypes.end(), name) == kTypes.end()) {
    type.fail(fmt::format("{} is no type of a parameter", type.tag()),
              "write one such as <ssv:Float64 value=\"…\"/>, <ssv:Int32 …/> or <ssv:Boolean …/>");
  }
  type.allow_attributes({"value", "unit", "name", "mime-type"});
  type.allow_children({{kSsv, "Value"}});
  ParameterValue parameter;
  parameter.where = type.where();
  parameter.unit = type.attribute("unit").value_or("");
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

ParameterValue read_parameter(const xml::Element& parameter, const std::string& prefix) {
  parameter.allow_attributes({"name"});
  std::optional<ParameterValue> result;
  for (const xml::Element& child : parameter.children()) {
    if (child.is(kSsc, "Annotations") || child.is(kSsv, "Annotations")) continue;
    if (child.is(kSsc, "Dimension")) continue;  // the unit's own dimensions hold
    if (result) child.fail(fmt::format("{} has two values", parameter.tag()));
    result = read_value(child);
  }
  if (!result) {
    parameter.fail(fmt::format("{} holds no value", parameter.tag()),
                   "write one such as <ssv:Float64 value=\"…\"/> into it");
  }
  result->name = prefix + parameter.required("name");
  return *result;
}

std::vector<ParameterValue> read_set(const xml::Element& set, const std::string& prefix) {
  if (!set.is(kSsv, "ParameterSet")) {
    set.fail(fmt::format("{} is no parameter set", set.tag()),
             fmt::format("expected <ParameterSet> of the namespace '{}'", kSsv));
  }
  set.allow_attributes({"version", "name", "author", "fileversion", "copyright", "license",
                        "generationTool", "generationDateAndTime"});
  const std::string version = set.required("version");
  if (version != "1.0" && version != "2.0") {
    set.fail(fmt::format("the version '{}' of parameter sets is not known", version),
             "stride reads 1.0 and 2.0");
  }
  set.allow_children({{kSsv, "Parameters"},
                      {kSsv, "Enumerations"},
                      {kSsv, "Units"},
                      {kSsc, "MetaData"},
                      {kSsc, "Signature"},
                      {kSsv, "Annotations"}});
  const auto parameters = set.child({kSsv, "Parameters"});
  if (!parameters) set.fail(fmt::format("{} holds no <Parameters>", set.tag()));
  parameters->allow_children({{kSsv, "Parameter"}});
  std::vector<ParameterValue> values;
  for (const xml::Element& parameter : parameters->children()) {
    values.push_back(read_parameter(parameter, prefix));
  }
  return values;
}

std::vector<ParameterValue> read_file(const xml::Element& binding, const std::string& prefix,
                                      const std::filesystem::path& folder) {
  if (binding.attribute("sourceBase").value_or("SSD") != "SSD") {
    binding.fail_unsupported("parameter sets inside a component (sourceBase=\"component\")",
                             "copy the .ssv beside the .ssd");
  }
  const std::filesystem::path path = source_path(binding, folder);
  if (std::error_code error; !std::filesystem::exists(path, error)) {
    binding.fail(fmt::format("the parameter set '{}' does not exist", path.string()),
                 "its path is relative to this file");
  }
  const xml::Document document(path);
  return read_set(document.root(), prefix);
}

std::vector<ParameterValue> read_binding(const xml::Element& binding,
                                         const std::filesystem::path& folder) {
  binding.allow_attributes({"type", "source", "sourceBase", "prefix"});
  binding.allow_children({{kSsd, "ParameterValues"},
                          {kSsd, "ParameterMapping"},
                          {kSsc, "MetaData"},
                          {kSsc, "Signature"},
                          {kSsd, "Annotations"}});
  if (const auto mapping = binding.child({kSsd, "ParameterMapping"})) {
    mapping->fail_unsupported("parameter mappings (.ssm)",
                              "give the parameters the names of the unit's variables");
  }
  const std::string type = binding.attribute("type").value_or(kParameterSetType);
  if (type != kParameterSetType) {
    binding.fail_unsupported(fmt::format("parameters of the type '{}'", type),
                             fmt::format("the type '{}' is read", kParameterSetType));
  }
  const std::string prefix = binding.attribute("prefix").value_or("");
  const auto inline_values = binding.child({kSsd, "ParameterValues"});
  if (binding.attribute("source")) {
    if (inline_values) {
      inline_values->fail("a binding with a source cannot have values of its own, too",
                          "split it into two bindings");
    }
    return read_file(binding, prefix, folder);
  }
  if (!inline_values) {
    binding.fail(fmt::format("{} has neither a source nor <ParameterValues>", binding.tag()));
  }
  inline_values->allow_children({{kSsv, "ParameterSet"}});
  const auto set = inline_values->child({kSsv, "ParameterSet"});
  if (!set) inline_values->fail(fmt::format("{} holds no <ParameterSet>", inline_values->tag()));
  return read_set(*set, prefix);
}

}  // namespace

std::vector<ParameterValue> read_parameters(const xml::Element& owner,
                                            const std::filesystem::path& folder) {
  std::vector<ParameterValue> values;
  const auto bindings = owner.child({kSsd, "ParameterBindings"});
  if (!bindings) return values;
  bindings->allow_children({{kSsd, "ParameterBinding"}});
  for (const xml::Element& binding : bindings->children()) {
    std::vector<ParameterValue> read = read_binding(binding, folder);
    values.insert(values.end(), std::make_move_iterator(read.begin()),
                  std::make_move_iterator(read.end()));
  }
  return values;
}

}  // namespace stride::io
