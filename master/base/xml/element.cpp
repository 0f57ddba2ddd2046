#include "master/base/xml/element.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include "master/base/text/boolean_text.h"
#include "master/base/text/lower_case.h"
#include "master/base/text/suggest.h"

namespace stride::xml {
namespace {

std::string_view prefix(std::string_view qualified) {
  const std::size_t colon = qualified.find(':');
  return colon == std::string_view::npos ? std::string_view{} : qualified.substr(0, colon);
}

std::string_view local(std::string_view qualified) {
  const std::size_t colon = qualified.find(':');
  return colon == std::string_view::npos ? qualified : qualified.substr(colon + 1);
}

const tinyxml2::XMLElement* parent_element(const tinyxml2::XMLElement* element) {
  return element->Parent() == nullptr ? nullptr : element->Parent()->ToElement();
}

std::optional<std::string_view> declared_namespace(const tinyxml2::XMLElement* element,
                                                   std::string_view wanted_prefix) {
  const std::string attribute =
      wanted_prefix.empty() ? "xmlns" : fmt::format("xmlns:{}", wanted_prefix);
  for (; element != nullptr; element = parent_element(element)) {
    if (const char* uri = element->Attribute(attribute.c_str())) return uri;
  }
  return std::nullopt;
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

std::string without_blanks(std::string_view text) {
  const auto words = split(text);
  if (words.empty()) return "";
  return {words.front().data(), words.back().data() + words.back().size()};
}

Element::Element(const tinyxml2::XMLElement& element, const std::string& file)
    : element_(&element), file_(&file) {}

Name Element::name() const {
  const std::string_view qualified = element_->Name();
  const auto uri = declared_namespace(element_, prefix(qualified));
  if (!uri && !prefix(qualified).empty()) {
    fail(fmt::format("the prefix '{}' of {} is not declared", prefix(qualified), tag()),
         fmt::format("declare it in the root element: xmlns:{}=\"…\"", prefix(qualified)));
  }
  return {uri.value_or(std::string_view{}), local(qualified)};
}

std::string_view Element::local_name() const { return local(element_->Name()); }

std::string Element::tag() const { return fmt::format("<{}>", element_->Name()); }

std::string Element::text() const {
  const char* const characters = element_->GetText();
  return without_blanks(characters != nullptr ? characters : "");
}

core::Location Element::where() const { return {*file_, element_->GetLineNum()}; }

std::optional<std::string> Element::prefix_of(std::string_view name_space) const {
  for (auto element = element_; element != nullptr; element = parent_element(element)) {
    for (auto it = element->FirstAttribute(); it != nullptr; it = it->Next()) {
      const std::string_view attribute = it->Name();
      const bool declares = attribute == "xmlns" || attribute.starts_with("xmlns:");
      if (!declares || it->Value() != name_space) continue;
      const std::string found(attribute == "xmlns" ? "" : local(attribute));
      if (declared_namespace(element_, found) == name_space) return found;
    }
  }
  return std::nullopt;
}

std::size_t Element::index() const {
  std::size_t before = 0;
  const tinyxml2::XMLNode* node = element_;
  while (node != nullptr) {
    if (node->PreviousSibling() != nullptr) {
      node = node->PreviousSibling();
      while (node->LastChild() != nullptr) node = node->LastChild();
    } else {
      node = node->Parent();
    }
    if (node != nullptr && node->ToElement() != nullptr) ++before;
  }
  return before;
}

std::optional<std::string> Element::attribute(const char* name) const {
  const char* value = element_->Attribute(name);
  if (value == nullptr) return std::nullopt;
  return value;
}

std::optional<std::string> Element::attribute(std::string_view name_space,
                                              std::string_view local_name) const {
  for (auto it = element_->FirstAttribute(); it != nullptr; it = it->Next()) {
    const std::string_view own_prefix = prefix(it->Name());
    const bool is_wanted = local(it->Name()) == local_name && !own_prefix.empty();
    if (is_wanted && declared_namespace(element_, own_prefix) == name_space) return it->Value();
  }
  return std::nullopt;
}

std::string Element::attribute_or(const char* name, const std::string& otherwise) const {
  return attribute(name).value_or(otherwise);
}

std::string Element::given(const char* name) const {
  const auto value = attribute(name);
  if (!value) fail(fmt::format("{} needs the attribute '{}'", tag(), name));
  return *value;
}

std::string Element::required(const char* name) const {
  std::string value = given(name);
  if (value.empty()) fail(fmt::format("the attribute '{}' of {} is empty", name, tag()));
  return value;
}

std::string Element::required_line(const char* name) const {
  std::string value = required(name);
  if (value.find_first_of("\n\r") == std::string::npos) return value;
  fail(fmt::format("the attribute '{}' of {} has more than one line", name, tag()));
}

bool Element::lenient_flag(const char* name, std::vector<std::string>& warnings) const {
  const std::string value = without_blanks(attribute_or(name));
  const std::string lower = core::lower_case(value);
  const auto meant = core::boolean_of(lower);
  if (lower == value || !meant) return flag(name);
  warnings.push_back(core::to_text({.where = where()}) +
                     fmt::format("{}=\"{}\" of {} is taken for {}", name, value, tag(), lower));
  return *meant;
}

std::optional<std::string> Element::lenient_word(const char* name,
                                                 std::span<const std::string> words,
                                                 std::vector<std::string>& warnings) const {
  const auto value = attribute(name);
  if (!value) return std::nullopt;
  if (std::ranges::find(words, *value) != words.end()) return value;
  const std::string lower = core::lower_case(without_blanks(*value));
  for (const std::string& word : words) {
    if (core::lower_case(word) != lower) continue;
    warnings.push_back(core::to_text({.where = where()}) +
                       fmt::format("{}=\"{}\" of {} is taken for {}", name, *value, tag(), word));
    return word;
  }
  fail(fmt::format("{}=\"{}\" of {}: expected one of {}", name, *value, tag(),
                   fmt::join(words, ", ")),
       core::nearest(*value, words).empty() ? "" : core::suggestion(*value, words));
}

bool Element::flag(const char* name, bool otherwise) const {
  const auto value = attribute(name);
  if (!value) return otherwise;
  if (const auto meant = core::boolean_of(without_blanks(*value))) return *meant;
  fail(fmt::format("{}=\"{}\" of {}: expected true or false", name, *value, tag()));
}

std::vector<Element> Element::children() const {
  std::vector<Element> found;
  for (auto it = element_->FirstChildElement(); it != nullptr; it = it->NextSiblingElement()) {
    found.emplace_back(*it, *file_);
  }
  return found;
}

std::vector<Element> Element::children(Name name) const {
  std::vector<Element> found = children();
  std::erase_if(found, [&](const Element& element) { return element.name() != name; });
  return found;
}

std::optional<Element> Element::child(Name name) const {
  const std::vector<Element> found = children(name);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) {
    found[1].fail(fmt::format("a second {} in {}; the first is in line {}", found[1].tag(), tag(),
                              found[0].where().line));
  }
  return found[0];
}

std::optional<Element> Element::lenient_child(std::string_view name,
                                              std::vector<std::string>& warnings) const {
  if (const auto found = child({"", name})) return found;
  const std::string wanted = core::lower_case(std::string(name));
  for (const Element& other : children()) {
    const bool is_it = other.name().name_space.empty() &&
                       core::lower_case(std::string(other.name().local)) == wanted;
    if (!is_it) continue;
    warnings.push_back(core::to_text({.where = other.where()}) +
                       fmt::format("{} is taken for <{}>", other.tag(), name));
    return other;
  }
  return std::nullopt;
}

std::optional<Element> Element::parent() const {
  const tinyxml2::XMLElement* parent = parent_element(element_);
  if (parent == nullptr) return std::nullopt;
  return Element(*parent, *file_);
}

void Element::allow_attributes(std::span<const std::string_view> names) const {
  for (auto it = element_->FirstAttribute(); it != nullptr; it = it->Next()) {
    const std::string attribute = it->Name();
    const bool is_foreign = attribute == "xmlns" || attribute.find(':') != std::string::npos;
    if (is_foreign || attribute == "id" || attribute == "description") continue;
    if (std::find(names.begin(), names.end(), attribute) != names.end()) continue;
    const std::vector<std::string> known(names.begin(), names.end());
    fail(fmt::format("{} has no attribute '{}'", tag(), attribute),
         core::suggestion(attribute, known));
  }
}

void Element::allow_children(std::span<const Name> names) const {
  for (const Element& element : children()) {
    const Name found = element.name();
    if (std::find(names.begin(), names.end(), found) != names.end()) continue;
    std::vector<std::string> known;
    for (const Name& name : names) known.emplace_back(name.local);
    const std::string written(found.local);
    if (std::find(known.begin(), known.end(), written) != known.end()) {
      const auto name = *std::find_if(names.begin(), names.end(),
                                      [&](const Name& n) { return n.local == written; });
      element.fail(fmt::format("{} is in the namespace '{}'", element.tag(), found.name_space),
                   fmt::format("it belongs in '{}'", name.name_space));
    }
    element.fail(fmt::format("{} is not known in {}", element.tag(), tag()),
                 core::suggestion(written, known));
  }
}

void Element::fail_number(const char* attribute, std::string_view value, bool is_integer) const {
  fail(fmt::format("{}=\"{}\" of {}: expected {} within the range of its type", attribute, value,
                   tag(), is_integer ? "an integer" : "a number"));
}

void Element::fail(const std::string& message, const std::string& hint) const {
  core::fail_input({.where = where()}, message, hint);
}

void Element::fail_unsupported(const std::string& what, const std::string& hint) const {
  fail(fmt::format("this version of stride does not support {}", what), hint);
}

}  // namespace stride::xml
