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

bool Element::flag(const char* attribute) const {
  const std::string value = text_or(attribute, "false");
  if (value == "true" || value == "1") return true;
  if (value == "false" || value == "0") return false;
  fail(fmt::format("{}=\"{}\" of <{}>: expected true or false", attribute, value, name()));
}

void Element::fail_number(const char* attribute, std::string_view value, bool is_integer) const {
  fail(fmt::format("{}=\"{}\" of <{}>: expected {} within the range of its type", attribute, value,
                   name(), is_integer ? "an integer" : "a number"));
}

}  // namespace stride::fmi
