#include "master/loader/fmu/description/clock_attributes.h"

#include <cstdint>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace stride::importer {
namespace {

using core::Interval;
using core::IntervalVariability;

class ClockReader {
 public:
  ClockReader(const xml::Element& clock, const std::optional<xml::Element>& type)
      : clock_(clock), type_(type) {}

  core::ClockAttributes read(core::Causality causality, std::vector<std::string>& warnings) const {
    core::ClockAttributes attributes;
    attributes.variability = read_variability(causality);
    attributes.supports_fraction = flag("supportsFraction", warnings);
    attributes.can_be_deactivated = flag("canBeDeactivated", warnings);
    attributes.priority = place("priority").number<std::uint32_t>("priority");
    if (!attributes.is_periodic()) return attributes;
    read_interval(attributes);
    return attributes;
  }

 private:
  bool flag(const char* attribute, std::vector<std::string>& warnings) const {
    return place(attribute).lenient_flag(attribute, warnings);
  }
  /// The element that has the attribute: the clock, or else its type.
  const xml::Element& place(const char* attribute) const {
    return !clock_.attribute(attribute) && type_ ? *type_ : clock_;
  }
  bool has(const char* attribute) const {
    return place(attribute).attribute(attribute).has_value();
  }

  [[noreturn]] void fail(const char* attribute, const std::string& expected) const {
    const xml::Element& element = place(attribute);
    element.fail(fmt::format("{}=\"{}\" of the clock '{}': {}", attribute,
                             element.attribute_or(attribute), clock_.attribute_or("name"),
                             expected));
  }

  IntervalVariability read_variability(core::Causality causality) const {
    const char* const attribute = "intervalVariability";
    if (!has(attribute)) clock_.required(attribute);
    const std::string word = *place(attribute).attribute(attribute);
    for (std::size_t i = 0; i < core::kIntervalVariabilityCount; ++i) {
      const auto variability = static_cast<IntervalVariability>(i);
      if (word != core::name(variability)) continue;
      if (causality == core::Causality::Input || variability == IntervalVariability::Triggered) {
        return variability;
      }
      fail(attribute, fmt::format("only an input can be a time-based clock, the {} must be "
                                  "triggered",
                                  core::name(causality)));
    }
    fail(attribute, "expected one of constant, fixed, tunable, changing, countdown, triggered");
  }

  /// The exact fraction, or else the decimal, or else nothing.
  void read_interval(core::ClockAttributes& attributes) const {
    if (has("intervalCounter")) {
      attributes.interval = fraction("intervalCounter");
      if (has("shiftCounter")) attributes.shift = fraction("shiftCounter");
    } else if (has("intervalDecimal")) {
      attributes.interval = decimal("intervalDecimal");
      if (has("shiftDecimal")) attributes.shift = decimal("shiftDecimal");
    } else if (attributes.variability == IntervalVariability::Constant) {
      clock_.required("intervalDecimal");
    }
    if (attributes.interval && attributes.interval->is_below_picosecond()) {
      fail(has("intervalCounter") ? "intervalCounter" : "intervalDecimal",
           "expected an interval of at least the picosecond that times are counted in");
    }
  }

  Interval decimal(const char* attribute) const {
    try {
      return Interval::from_seconds(place(attribute).required_number<double>(attribute));
    } catch (const std::invalid_argument& mistake) {
      fail(attribute, mistake.what());
    }
  }

  Interval fraction(const char* counter) const {
    const auto count = place(counter).required_number<std::uint64_t>(counter);
    const auto resolution = place("resolution").number<std::uint64_t>("resolution");
    if (!resolution) fail(counter, "it needs the attribute resolution beside it");
    try {
      return Interval::from_fraction(count, *resolution);
    } catch (const std::invalid_argument& mistake) {
      fail("resolution", mistake.what());
    }
  }

  const xml::Element& clock_;
  const std::optional<xml::Element>& type_;
};

}  // namespace

core::ClockAttributes read_clock_attributes(const xml::Element& clock,
                                            const std::optional<xml::Element>& declared_type,
                                            core::Causality causality,
                                            std::vector<std::string>& warnings) {
  return ClockReader(clock, declared_type).read(causality, warnings);
}

}  // namespace stride::importer
