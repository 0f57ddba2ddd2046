#include "master/system/ssp/signal_dictionary.h"

#include <utility>

#include <fmt/format.h>

#include "master/base/xml/document.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/uri.h"
#include "master/system/ssp/version.h"

namespace stride::ssp {
namespace {

constexpr const char* kDictionaryType = "application/x-ssp-signal-dictionary";

core::ConnectorDeclaration read_entry(const xml::Element& element, const SspFile& file,
                                      std::vector<std::string>& warnings) {
  element.allow_attributes({"name"});
  core::ConnectorDeclaration entry;
  entry.name = element.required("name");
  entry.where = element.where();
  for (const xml::Element& child : element.children()) {
    if (child.is(kSsb, "Annotations")) continue;
    if (child.is(kSsc, "MetaData") || child.is(kSsc, "Signature")) continue;
    if (child.is(kSsc, "Dimension")) {
      entry.dimensions.push_back(read_dimension(child));
      continue;
    }
    if (read_type(child, file, entry, warnings)) continue;
    child.fail(fmt::format("{} is not known in {}", child.tag(), element.tag()));
  }
  return entry;
}

/// SSP has units defined in the file that names them.
void take_unit(core::ConnectorDeclaration& entry, const DictionaryContext& context) {
  if (entry.unit.name.empty() || entry.unit.meaning) return;
  entry.unit = context.definitions.unit(entry.unit.name);
  if (!entry.unit.meaning) return;
  context.warnings.push_back(
      core::to_text({.where = entry.where}) +
      fmt::format("the unit '{}' is not defined in the <Units> of the signal dictionary; that of "
                  "the system that refers to it is taken",
                  entry.unit.name));
}

SignalDictionary read_entries(const xml::Element& root, const DictionaryContext& context) {
  if (!root.is(kSsb, "SignalDictionary")) {
    root.fail(fmt::format("{} is not a signal dictionary", root.tag()),
              fmt::format("expected <SignalDictionary> of the namespace '{}'", kSsb));
  }
  root.allow_children({{kSsb, "DictionaryEntry"},
                       {kSsb, "Enumerations"},
                       {kSsb, "Units"},
                       {kSsc, "MetaData"},
                       {kSsc, "Signature"},
                       {kSsb, "Annotations"}});
  const SspFile file{read_version(root, context.warnings),
                     read_definitions(root, kSsb, context.warnings)};
  SignalDictionary dictionary;
  for (const xml::Element& element : root.children({kSsb, "DictionaryEntry"})) {
    core::ConnectorDeclaration entry = read_entry(element, file, context.warnings);
    take_unit(entry, context);
    const std::string name = entry.name;
    if (dictionary.entries.emplace(name, std::move(entry)).second) continue;
    element.fail(fmt::format("two entries are named '{}'", name));
  }
  return dictionary;
}

SignalDictionary read_dictionary(const xml::Element& element, const DictionaryContext& context) {
  element.allow_attributes({"name", "type", "source"});
  const std::string type = element.attribute_or("type", kDictionaryType);
  if (type != kDictionaryType) {
    element.fail_unsupported(fmt::format("signal dictionaries of the type '{}'", type),
                             fmt::format("the type '{}' is read", kDictionaryType));
  }
  if (has_source(element)) {
    const std::filesystem::path path = source_path(element, context.folders, context.warnings);
    return read_entries(context.files.document(path).root(), context);
  }
  const auto inside = element.child({kSsb, "SignalDictionary"});
  if (!inside) {
    element.fail(fmt::format("{} has neither a source nor <ssb:SignalDictionary>", element.tag()));
  }
  return read_entries(*inside, context);
}

}  // namespace

std::map<std::string, SignalDictionary> read_signal_dictionaries(const xml::Element& dictionaries,
                                                                 const DictionaryContext& context) {
  std::map<std::string, SignalDictionary> all;
  dictionaries.allow_children({{kSsd, "SignalDictionary"}});
  for (const xml::Element& element : dictionaries.children()) {
    const std::string name = element.required("name");
    if (all.emplace(name, read_dictionary(element, context)).second) continue;
    element.fail(fmt::format("two signal dictionaries are named '{}'", name));
  }
  return all;
}

}  // namespace stride::ssp
