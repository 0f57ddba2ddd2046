// --film: switches on the films of components that can make them.
#ifndef STRIDE_MASTER_SCENARIO_FILM_H
#define STRIDE_MASTER_SCENARIO_FILM_H

#include <string>

#include "master/model/system.h"

namespace stride::scenario {

/// The parameter [s] that makes a unit write a film (units/mujoco_world).
inline constexpr const char* kFilmInterval = "film.interval";

/// The value of --film without an interval: the one that the system gives, or else 0.1 s.
inline constexpr const char* kUnspecifiedFilmInterval = "true";

/// Sets it for each component that has it; `interval` is in seconds, or kUnspecifiedFilmInterval.
/// The components have their descriptions. Throws core::Error (Input) for an interval that is not a
/// positive number, and if no component has the parameter.
void switch_film_on(core::SystemDeclaration& system, const std::string& interval);

}  // namespace stride::scenario

#endif
