// An MJCF model from a file, and the catalogue of what of it can be wired.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_MJCF_H
#define STRIDE_UNITS_MUJOCO_WORLD_MJCF_H

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "units/mujoco_world/mujoco_api.h"

namespace mujoco_world {

struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using ModelPointer = std::unique_ptr<mjModel, DeleteModel>;

/// A drive does not pull evenly: `amplitude` sin(`cycles` q) is added to its command, q the joint's
/// angle. For a position servo of the stiffness kp this is a torque of kp times the amplitude. The
/// cogging torque of a motor has as many periods in a turn as the least common multiple of its
/// slots and poles (Zhu, Howe, "Influence of design parameters on cogging torque in permanent
/// magnet machines", IEEE Trans. Energy Conversion 15(4), 2000), times the gear's ratio in one of
/// the joint; a harmonic drive's transmission error has two in a turn of its wave generator
/// (Tuttle, Seering, "A nonlinear model of a harmonic drive gear transmission", IEEE Trans.
/// Robotics and Automation 12(3), 1996).
struct DriveRipple {
  double amplitude;  ///< [rad] or [m]
  double cycles;     ///< in 2 pi of the joint's position: in a turn of a hinge
  int position;      ///< of the joint, index into qpos
};

/// One scalar control. An actuator with several controls (MuJoCo 3 only) is listed once for each.
struct Actuator {
  std::string name;
  std::string unit;  ///< "rad", "m", "rad/s", "m/s", "N.m", "N", or "" where it is not known
  int id;            ///< of the actuator in the model
  int control;       ///< index into ctrl
  int element;       ///< 1, 2 ... if the actuator has several controls, else 0
  std::optional<std::pair<double, double>> range;  ///< to which MuJoCo clamps the control
  std::optional<DriveRipple> ripple;               ///< that is added to the control
};

/// A hinge or slide joint.
struct Joint {
  std::string name;
  std::string unit;  ///< of the position: "rad" or "m"; of the velocity: the same per second
  int position;      ///< index into qpos
  int velocity;      ///< index into qvel
};

struct Site {
  std::string name;
  int id;
};

struct Sensor {
  std::string name;
  std::string unit;  ///< "" where it has none or it is not known
  int address;       ///< of its first number in sensordata
  int dimension;
};

/// A geom that can shine.
struct Lamp {
  std::string name;  ///< of the geom
  int geom;          ///< its id
};

/// A coil whose field can be drawn: along the z axis of a site.
struct Field {
  std::string name;  ///< of the site
  int site;          ///< its id
};

/// What can be wired, each kind in the model's order. An unnamed actuator, joint or sensor is
/// called unnamed_<index within its kind>. Unnamed sites, and free and ball joints, are left out:
/// put a named site on such a body.
struct Catalogue {
  std::vector<Actuator> actuators;
  std::vector<Joint> joints;
  std::vector<Site> sites;
  std::vector<Sensor> sensors;
  std::vector<Lamp> lamps;
  std::vector<Field> fields;
};

/// The MJCF of a folder: scene.xml, or else its only .xml file.
/// Throws std::runtime_error if the folder, or such a file in it, is missing.
std::filesystem::path find_scene(const std::filesystem::path& folder);

/// An MJCF may list, in a <custom><text name="required_sites" data="..."/>, the sites that it is
/// useless without, separated by blanks.
inline constexpr const char* kRequiredSites = "required_sites";

/// The geoms that can shine, in a <custom><text name="lamps" data="..."/>, likewise.
inline constexpr const char* kLamps = "lamps";

/// The sites whose fields can be drawn, in a <custom><text name="fields" data="..."/>, likewise.
inline constexpr const char* kFields = "fields";

/// The ripple of the actuator NAME: <custom><numeric name="drive_ripple.NAME"
/// data="amplitude cycles"/></custom>. It has a single control and a hinge or slide joint.
inline constexpr const char* kDriveRipple = "drive_ripple.";

/// Compiles an MJCF file. Throws std::runtime_error with the file and MuJoCo's message, or with the
/// site that is required and missing, and those that there are, or likewise with the lamp that is
/// no geom or the field that is at no site, or with one that is listed twice, or the transmission
/// error that has no such actuator or not two numbers. Features that would make the world
/// irreproducible are switched off: noise on sensors (MuJoCo 2), sleeping bodies (MuJoCo 3). A
/// warning reports that (hooks.h).
ModelPointer load_model(const std::filesystem::path& file);

Catalogue list(const mjModel& model);

/// The name of an object, or unnamed_<id>. `type` is an mjtObj.
std::string name_of(const mjModel& model, int type, int id);

}  // namespace mujoco_world

#endif
