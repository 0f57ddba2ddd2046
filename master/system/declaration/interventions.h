// The interventions of a scenario and of a command line.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_INTERVENTIONS_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_INTERVENTIONS_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/engine/model/system/known_names.h"
#include "master/engine/model/system/system.h"
#include "master/engine/run/context/intervention.h"

namespace stride::scenario {

/// An intervention with names.
struct InterventionDeclaration {
  core::Intervention::Kind kind = core::Intervention::Kind::Set;
  std::string variable;  ///< "component.variable"
  /// Of Set and Force; of Delay the seconds; of Corrupt the number of bits, and behind a comma the
  /// bytes of the header.
  std::optional<std::string> value{};
  Time from{};
  std::optional<Time> until{};
  std::uint64_t seed = 1;  ///< of Corrupt
  core::Location where{};
};

/// Takes the text of an option that makes an intervention: of --set-at
/// "COMPONENT.VARIABLE=VALUE@TIME", of --force "COMPONENT.VARIABLE[=VALUE]@FROM..[UNTIL]" (held
/// without a value), of --drop "COMPONENT.VARIABLE@FROM..[UNTIL]", of --delay
/// "COMPONENT.VARIABLE=SECONDS@FROM..[UNTIL]", and of --corrupt
/// "COMPONENT.VARIABLE[=BITS[,HEADER[,SEED]]]@FROM..[UNTIL]" (one bit where none is given). `names`
/// tell a '=' in a name from the one behind it. Throws core::Error (Input).
InterventionDeclaration parse_set_at(const std::string& text, const core::KnownNames& names = {});
InterventionDeclaration parse_force(const std::string& text, const core::KnownNames& names = {});
InterventionDeclaration parse_drop(const std::string& text, const core::KnownNames& names = {});
InterventionDeclaration parse_delay(const std::string& text, const core::KnownNames& names = {});
InterventionDeclaration parse_corrupt(const std::string& text, const core::KnownNames& names = {});

/// The run for which interventions are meant.
struct RunTimes {
  Time start{};
  Time stop{};
  std::string stop_hint{};  ///< for times behind its stop; empty: none
};

/// Throws core::Error (Input) if it cannot be set in the middle of a run.
void require_settable(const core::System& system, core::VariableId id);

/// In the order of their instants. Throws core::Error (Input) for unknown names, for variables that
/// cannot be changed so or at all, for values that are none of theirs, for instants outside of the
/// run, and for two interventions that contradict each other.
std::vector<core::Intervention> resolve_interventions(
    const core::System& system, std::span<const InterventionDeclaration> declarations,
    const RunTimes& times);

}  // namespace stride::scenario

#endif
