#include "master/fmi/xml.h"

#include <fmt/format.h>

namespace stride::fmi {

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
  const std::string_view qualified = element_->Name();
  const std::size_t colon = qualified.find(':');
  const bool has_prefix = colon != std::string_view::npos;
  if (qualified.substr(has_prefix ? colon + 1 : 0) != local_name) return false;
  const std::string declaration =
      has_prefix ? fmt::format("xmlns:{}", qualified.substr(0, colon)) : "xmlns";
  for (const tinyxml2::XMLNode* node = element_; node != nullptr; node = node->Parent()) {
    const tinyxml2::XMLElement* element = node->ToElement();
    const char* uri = element != nullptr ? element->Attribute(declaration.c_str()) : nullptr;
    if (uri != nullptr) return uri == name_space;
  }
  return name_space.empty();
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

}  // namespace stride::fmi
