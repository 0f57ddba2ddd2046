#include "master/system/declaration/vendor_step.h"

#include <stdexcept>
#include <string_view>

namespace stride::scenario {
namespace {

struct VendorElement {
  std::string_view local_name;
  const char* attribute;
};

constexpr VendorElement kVendorElements[] = {{"FixedStepAlgorithm", "baseStepSize"},
                                             {"FixedStepMaster", "stepSize"}};

std::optional<VendorStep> step_of(const xml::Element& element) {
  for (const VendorElement& known : kVendorElements) {
    const auto text = element.attribute(known.attribute);
    if (!text || element.local_name() != known.local_name) continue;
    try {
      const core::Interval size = core::Interval::parse(*text);
      if (!size.is_below_picosecond()) return VendorStep{size, element.tag(), element.where()};
    } catch (const std::invalid_argument&) {  // it is another tool's, which may take it
    }
  }
  return std::nullopt;
}

std::optional<VendorStep> find_step(const xml::Element& element, bool is_in_annotation) {
  const bool is_annotation = is_in_annotation || element.local_name() == "Annotation";
  if (is_in_annotation) {
    if (const auto step = step_of(element)) return step;
  }
  for (const xml::Element& child : element.children()) {
    if (const auto step = find_step(child, is_annotation)) return step;
  }
  return std::nullopt;
}

}  // namespace

std::optional<VendorStep> find_vendor_step(const xml::Element& root) {
  return find_step(root, false);
}

}  // namespace stride::scenario
