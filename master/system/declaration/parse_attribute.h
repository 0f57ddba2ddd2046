#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_PARSE_ATTRIBUTE_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_PARSE_ATTRIBUTE_H

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "master/base/xml/element.h"

namespace stride::scenario {

/// What `parse` makes of the attribute, which is there. Throws core::Error (Input) at the element
/// where that throws std::invalid_argument.
template <class Parse>
auto parse_attribute(const xml::Element& element, const char* name, Parse&& parse) {
  try {
    return parse(element.required(name));
  } catch (const std::invalid_argument& mistake) {
    element.fail(fmt::format("{}: {}", name, mistake.what()));
  }
}

/// Likewise; nothing where it is not there.
template <class Parse>
auto parse_optional_attribute(const xml::Element& element, const char* name, Parse&& parse)
    -> std::optional<decltype(parse(std::string()))> {
  if (!element.attribute(name)) return std::nullopt;
  return parse_attribute(element, name, parse);
}

}  // namespace stride::scenario

#endif
