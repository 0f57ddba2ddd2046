#include "master/fmi/xml.h"

#include <cctype>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

namespace stride::fmi {
namespace {

/// tinyxml2's name of the error in plain words: XML_ERROR_MISMATCHED_ELEMENT, "mismatched element".
std::string reason(const tinyxml2::XMLDocument& document) {
  std::string words = document.ErrorName();
  for (const std::string_view prefix : {"XML_ERROR_", "XML_"}) {
    if (words.starts_with(prefix)) words.erase(0, prefix.size());
  }
  for (char& c : words) c = c == '_' ? ' ' : static_cast<char>(std::tolower(c));
  return words;
}

struct QualifiedName {
  std::string_view prefix;  ///< empty if there is none
  std::string_view local;
};

QualifiedName split_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return {{}, name};
  return {name.substr(0, colon), name.substr(colon + 1)};
}

}  // namespace

std::vector<std::string_view> split(std::string_view list) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t first = list.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return words;
    list.remove_prefix(first);
    const std::size_t size = std::min(list.find_first_of(kBlanks), list.size());
    words.push_back(list.substr(0, size));
    list.remove_prefix(size);
  }
}

bool Element::is(std::string_view name_space, std::string_view local_name) const {
  const auto [prefix, local] = split_name(element_->Name());
  return local == local_name && name_space_of(prefix) == name_space;
}

std::string_view Element::name_space_of(std::string_view prefix) const {
  const std::string declaration = prefix.empty() ? "xmlns" : fmt::format("xmlns:{}", prefix);
  for (const tinyxml2::XMLNode* node = element_; node != nullptr; node = node->Parent()) {
    const tinyxml2::XMLElement* element = node->ToElement();
    const char* uri = element != nullptr ? element->Attribute(declaration.c_str()) : nullptr;
    if (uri != nullptr) return uri;
  }
  return {};
}

void Element::fail(const std::string& message, const std::string& hint) const {
  core::fail_input({.where = where()}, message, hint);
}

std::optional<Element> Element::child(const char* name) const {
  const tinyxml2::XMLElement* found = element_->FirstChildElement(name);
  return found != nullptr ? std::optional(Element(*found, *file_)) : std::nullopt;
}

std::vector<Element> Element::children(const char* name) const {
  std::vector<Element> found;
  for (const auto* e = element_->FirstChildElement(name); e != nullptr;
       e = e->NextSiblingElement(name)) {
    found.emplace_back(*e, *file_);
  }
  return found;
}

std::optional<std::string> Element::text(const char* attribute) const {
  const char* value = element_->Attribute(attribute);
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

std::optional<std::string> Element::text(std::string_view name_space,
                                         std::string_view local_name) const {
  for (const auto* a = element_->FirstAttribute(); a != nullptr; a = a->Next()) {
    const auto [prefix, local] = split_name(a->Name());
    const bool is_found = local == local_name && !prefix.empty();  // the default is for elements
    if (is_found && name_space_of(prefix) == name_space) return a->Value();
  }
  return std::nullopt;
}

std::string Element::text_or(const char* attribute, const std::string& otherwise) const {
  return text(attribute).value_or(otherwise);
}

std::string Element::required_text(const char* attribute) const {
  const auto value = text(attribute);
  if (!value) fail(fmt::format("<{}> has no attribute '{}', which it needs", name(), attribute));
  return *value;
}

bool Element::flag(const char* attribute, bool otherwise) const {
  const std::string value = text_or(attribute, otherwise ? "true" : "false");
  if (value == "true" || value == "1") return true;
  if (value == "false" || value == "0") return false;
  fail(fmt::format("{}=\"{}\" of <{}>: expected true or false", attribute, value, name()));
}

void Element::fail_number(const char* attribute, std::string_view value, bool is_integer) const {
  fail(fmt::format("{}=\"{}\" of <{}>: expected {} within the range of its type", attribute, value,
                   name(), is_integer ? "an integer" : "a number"));
}

Document::Document(const std::string& text, std::string shown_as) : shown_as_(std::move(shown_as)) {
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    core::fail_input({.where = {shown_as_, document_.ErrorLineNum()}},
                     fmt::format("the XML is not well-formed: {}", reason(document_)));
  }
  if (document_.RootElement() == nullptr) {
    core::fail_input({.where = {shown_as_}}, "the document is empty");
  }
}

std::string read_text(const std::filesystem::path& file, const std::string& what,
                      const std::string& shown_as) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    core::fail_input({.where = {shown_as}}, fmt::format("the {} cannot be read", what),
                     "check that the file exists, is not empty and may be read");
  }
  return text.str();
}

}  // namespace stride::fmi
