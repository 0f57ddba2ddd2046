#include "master/study/campaign/intervention_parts.h"

#include <stdexcept>

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/base/time_text.h"
#include "master/base/xml/element.h"

namespace stride::campaign {
namespace {

using InterventionKind = core::Intervention::Kind;

/// Of Corrupt the value is "BITS,HEADER".
void set_corruption(scenario::InterventionDeclaration& declared, const std::string& part,
                    const std::string& text) {
  const std::string value = declared.value.value_or("1,0");
  const std::size_t comma = value.find(',');
  if (part == "bits") {
    declared.value = text + value.substr(comma);
  } else {
    declared.value = value.substr(0, comma + 1) + text;
  }
}

std::string interval_text(const scenario::InterventionDeclaration& declared) {
  return fmt::format("@{}..{}", core::to_text(declared.from),
                     declared.until ? core::to_text(*declared.until) : "");
}

}  // namespace

std::vector<std::string> parts_of(InterventionKind kind) {
  switch (kind) {
    case InterventionKind::Set:
      return {"value", "at", kEnabledPart};
    case InterventionKind::Force:
      return {"value", "from", "until", kEnabledPart};
    case InterventionKind::Delay:
      return {"time", "from", "until", kEnabledPart};
    case InterventionKind::Corrupt:
      return {"bits", "header", "seed", "from", "until", kEnabledPart};
    default:
      return {"from", "until", kEnabledPart};
  }
}

void set_part(scenario::InterventionDeclaration& declared, const std::string& part,
              const std::string& text) {
  if (part == "value" || part == "time") {
    declared.value = text;
  } else if (part == "at" || part == "from") {
    declared.from = core::parse_time(text);
  } else if (part == "until") {
    declared.until = core::parse_time(text);
  } else if (part == "seed") {
    const auto seed = xml::to_number<std::uint64_t>(text);
    if (!seed) {
      throw std::invalid_argument(fmt::format(
          "'{}' is not a seed: expected a whole number from 0 to 2^64 - 1", core::name_text(text)));
    }
    declared.seed = *seed;
  } else {
    set_corruption(declared, part, text);
  }
}

std::optional<std::string> part_text(const scenario::InterventionDeclaration& declared,
                                     const std::string& part) {
  if (part == "value" || part == "time") return declared.value;
  if (part == "at" || part == "from") return core::to_text(declared.from);
  if (part == "until" && declared.until) return core::to_text(*declared.until);
  return std::nullopt;
}

std::pair<std::string, std::string> option_of(const scenario::InterventionDeclaration& declared) {
  const std::string& variable = declared.variable;
  const std::string interval = interval_text(declared);
  switch (declared.kind) {
    case InterventionKind::Set:
      return {"--set-at", fmt::format("{}={}@{}", variable, declared.value.value_or(""),
                                      core::to_text(declared.from))};
    case InterventionKind::Force:
      return {"--force", fmt::format("{}={}{}", variable, declared.value.value_or(""), interval)};
    case InterventionKind::Hold:
      return {"--force", variable + interval};
    case InterventionKind::Drop:
      return {"--drop", variable + interval};
    case InterventionKind::Delay:
      return {"--delay", fmt::format("{}={}{}", variable, declared.value.value_or(""), interval)};
    case InterventionKind::Corrupt:
      break;
  }
  return {"--corrupt", fmt::format("{}={},{}{}", variable, declared.value.value_or("1,0"),
                                   declared.seed, interval)};
}

}  // namespace stride::campaign
