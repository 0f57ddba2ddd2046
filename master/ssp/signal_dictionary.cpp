#include "master/ssp/signal_dictionary.h"

#include <span>
#include <utility>

#include <fmt/format.h>

#include "master/ssp/ssp.h"
#include "master/ssp/uri.h"
#include "master/ssp/version.h"
#include "master/util/xml/document.h"

namespace stride::ssp {
namespace {

constexpr const char* kDictionaryType = "application/x-ssp-signal-dictionary";

core::ConnectorDeclaration read_entry(const xml::Element& element, const SspFile& file) {
  element.allow_attributes({"name"});
  core::ConnectorDeclaration entry;
  entry.name = element.required("name");
  entry.where = element.where();
  for (const xml::Element& child : element.children()) {
    if (child.is(kSsc, "Dimension") || child.is(kSsb, "Annotations")) continue;
    if (child.is(kSsc, "MetaData") || child.is(kSsc, "Signature")) continue;
    if (read_type(child, file, entry)) continue;
    child.fail(fmt::format("{} is not known in {}", child.tag(), element.tag()));
  }
  return entry;
}

SignalDictionary read_entries(const xml::Element& root, std::vector<std::string>& warnings) {
  if (!root.is(kSsb, "SignalDictionary")) {
    root.fail(fmt::format("{} is not a signal dictionary", root.tag()),
              fmt::format("expected <SignalDictionary> of the namespace '{}'", kSsb));
  }
  const SspFile file{read_version(root, warnings), read_definitions(root, kSsb)};
  SignalDictionary dictionary;
  for (const xml::Element& element : root.children({kSsb, "DictionaryEntry"})) {
    core::ConnectorDeclaration entry = read_entry(element, file);
    const std::string name = entry.name;
    if (dictionary.entries.emplace(name, std::move(entry)).second) continue;
    element.fail(fmt::format("two entries are named '{}'", name));
  }
  return dictionary;
}

SignalDictionary read_dictionary(const xml::Element& element,
                                 std::span<const std::filesystem::path> folders, Files& files,
                                 std::vector<std::string>& warnings) {
  element.allow_attributes({"name", "type", "source"});
  const std::string type = element.attribute_or("type", kDictionaryType);
  if (type != kDictionaryType) {
    element.fail_unsupported(fmt::format("signal dictionaries of the type '{}'", type),
                             fmt::format("the type '{}' is read", kDictionaryType));
  }
  if (element.attribute("source")) {
    const std::filesystem::path path = source_path(element, folders, warnings);
    return read_entries(files.document(path).root(), warnings);
  }
  const auto inside = element.child({kSsb, "SignalDictionary"});
  if (!inside) {
    element.fail(fmt::format("{} has neither a source nor <ssb:SignalDictionary>", element.tag()));
  }
  return read_entries(*inside, warnings);
}

}  // namespace

std::map<std::string, SignalDictionary> read_signal_dictionaries(
    const xml::Element& dictionaries, std::span<const std::filesystem::path> folders, Files& files,
    std::vector<std::string>& warnings) {
  std::map<std::string, SignalDictionary> all;
  dictionaries.allow_children({{kSsd, "SignalDictionary"}});
  for (const xml::Element& element : dictionaries.children()) {
    const std::string name = element.required("name");
    if (all.emplace(name, read_dictionary(element, folders, files, warnings)).second) continue;
    element.fail(fmt::format("two signal dictionaries are named '{}'", name));
  }
  return all;
}

}  // namespace stride::ssp
