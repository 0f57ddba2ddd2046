// --film and --scene: switch on what components can record of their worlds.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_RECORDINGS_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_RECORDINGS_H

#include <string>
#include <string_view>

#include "master/engine/model/system/system.h"

namespace stride::scenario {

/// Something that units (units/mujoco_world) write if a parameter [s] has an interval for it.
struct RecordingKind {
  std::string_view option;     ///< of the command line
  std::string_view parameter;  ///< of a component
  std::string_view what;       ///< a component that has the parameter does
};

inline constexpr RecordingKind kFilm{"--film", "film.interval", "makes pictures"};
inline constexpr RecordingKind kScene{"--scene", "scene.interval", "writes a scene"};

/// The value of the option without an interval: the one that the system gives, or else 0.1 s.
inline constexpr const char* kUnspecifiedInterval = "true";

/// Sets the parameter for each component that has it; `interval` is in seconds, or
/// kUnspecifiedInterval; where it is empty, nothing is done. The components have their
/// descriptions. Throws core::Error (Input) for an interval that is not a positive number, and if
/// no component has the parameter.
void switch_on(const RecordingKind& kind, core::SystemDeclaration& system,
               const std::string& interval);

}  // namespace stride::scenario

#endif
