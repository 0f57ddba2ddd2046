// The masses and inertias of a URDF's links, made such that a body can have them.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_INERTIA_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_INERTIA_H

#include <filesystem>

#include <tinyxml2.h>

namespace mujoco_world {

/// Repairs the links that MuJoCo refuses, or whose negative values it would silently take for 0.
/// All others keep what they have, to the bit.
///
/// - A mass that is negative, or, of a link that moves against its parent, below MuJoCo's least
///   (mjMINVAL) or absent: 0.001 kg.
/// - A principal moment of inertia likewise (with MuJoCo 3 also of a link that does not move,
/// unless
///   all elements are 0): that of a ball with the density of water and the link's mass, or 0.001 kg
///   if that is more, but not above the greatest of the link's own moments, if there is one.
/// - A principal moment C above the sum of the others, A + B: the nearest three that fit, so A and
/// B
///   are raised, and C lowered, by a third of what is missing. The principal axes remain.
///
/// A link that moves needs no mass of its own where a link fixed to it has one, nor where it has
/// collision geometry and no <inertial>, from which MuJoCo computes them. What is not a number is
/// left to MuJoCo's error. Nothing is repaired where the URDF's own <mujoco><compiler> has one of
/// boundmass, boundinertia, balanceinertia and inertiafromgeom.
///
/// A warning (hooks.h) for each repaired link has file and line, its name, and its values before
/// and after. `file` is where the URDF was read from.
void repair_inertias(tinyxml2::XMLElement& robot, const std::filesystem::path& file);

}  // namespace mujoco_world

#endif
