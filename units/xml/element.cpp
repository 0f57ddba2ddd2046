#include "units/xml/element.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <tinyxml2.h>

#include "units/xml/text.h"

namespace xml {

std::string Element::name() const { return element_->Name(); }

std::vector<Element> Element::children() const {
  std::vector<Element> children;
  for (const auto* child = element_->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    children.emplace_back(*child, *file_);
  }
  return children;
}

std::optional<std::string> Element::find(const char* attribute) const {
  const char* value = element_->Attribute(attribute);
  return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
}

std::string Element::text(const char* attribute) const {
  if (const auto value = find(attribute)) return *value;
  fail("expected the attribute '" + std::string(attribute) + "'");
}

double Element::number(const char* attribute) const {
  return to_number(attribute, text(attribute));
}

double Element::number(const char* attribute, double fallback) const {
  const auto value = find(attribute);
  return value ? to_number(attribute, *value) : fallback;
}

// not tinyxml2's own conversion, which takes the decimal point from the process's locale
double Element::to_number(const char* attribute, const std::string& value) const {
  double number = 0.0;
  const char* end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) {
    fail(std::string(attribute) + "=\"" + value + "\" is not a number: expected one such as 14.2");
  }
  return number;
}

stride::Time Element::time(const char* attribute) const {
  const double seconds = number(attribute);
  if (seconds < 0.0 || seconds > stride::kMaxSeconds) {
    fail(std::string(attribute) + "=\"" + text(attribute) + "\": expected 0 to 1e15 seconds");
  }
  return stride::time_from_seconds(seconds);
}

double Element::number_within(const char* attribute, double least, double most) const {
  const double value = number(attribute);
  if (value >= least && value <= most) return value;
  fail(std::string(attribute) + "=\"" + text(attribute) + "\": expected " + shortest(least) +
       " to " + shortest(most));
}

std::uint64_t Element::whole_number(const char* attribute, std::uint64_t least,
                                    std::uint64_t most) const {
  const std::string value = text(attribute);
  const bool hexadecimal = value.rfind("0x", 0) == 0;
  std::uint64_t number = 0;
  const char* end = value.data() + value.size();
  const auto [stop, error] =
      std::from_chars(value.data() + (hexadecimal ? 2 : 0), end, number, hexadecimal ? 16 : 10);
  if (error == std::errc() && stop == end && number >= least && number <= most) return number;
  fail(std::string(attribute) + "=\"" + value + "\": expected a whole number from " +
       std::to_string(least) + " to " + std::to_string(most));
}

void Element::allow_only(const std::vector<std::string>& attributes) const {
  for (const auto* attribute = element_->FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    if (std::find(attributes.begin(), attributes.end(), attribute->Name()) != attributes.end()) {
      continue;
    }
    const std::string unknown = "unknown attribute '" + std::string(attribute->Name()) + "': ";
    fail(unknown + (attributes.empty() ? "expected none" : "expected " + quoted_list(attributes)));
  }
  for (const auto* node = element_->FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToText() != nullptr) fail("expected no text between the elements");
  }
}

void Element::allow_only_leaf(const std::vector<std::string>& attributes) const {
  allow_only(attributes);
  if (!children().empty()) children().front().fail("expected no element inside <" + name() + ">");
}

void Element::fail(const std::string& message) const {
  throw std::runtime_error(*file_ + ":" + std::to_string(element_->GetLineNum()) + ": <" +
                           element_->Name() + ">: " + message);
}

}  // namespace xml
