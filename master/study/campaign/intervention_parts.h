// The parts of an intervention that a campaign can vary, by the names of their attributes.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_INTERVENTION_PARTS_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_INTERVENTION_PARTS_H

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "master/system/declaration/interventions.h"

namespace stride::campaign {

/// Whether the case has the intervention at all: "true" or "false".
inline constexpr const char* kEnabledPart = "enabled";

/// "from", "until", "value", "enabled", as the intervention has them.
std::vector<std::string> parts_of(core::Intervention::Kind kind);

/// Sets one of these, but for kEnabledPart. Throws std::invalid_argument whose text contains what
/// was expected.
void set_part(scenario::InterventionDeclaration& declared, const std::string& part,
              const std::string& text);

/// The text of one of these that is a number by itself: not of kEnabledPart, of a corruption, or of
/// a value that is not given.
std::optional<std::string> part_text(const scenario::InterventionDeclaration& declared,
                                     const std::string& part);

/// The option of `stride run` that makes the intervention, and its value.
std::pair<std::string, std::string> option_of(const scenario::InterventionDeclaration& declared);

}  // namespace stride::campaign

#endif
