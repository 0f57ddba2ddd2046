#ifndef STRIDE_MASTER_SCENARIO_PARSE_ATTRIBUTE_H
#define STRIDE_MASTER_SCENARIO_PARSE_ATTRIBUTE_H

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/util/xml/element.h"

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

}  // namespace stride::scenario

#endif
