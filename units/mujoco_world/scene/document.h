// A world as a glTF 2.0 file (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html).
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_DOCUMENT_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_DOCUMENT_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "units/mujoco_world/mjcf.h"
#include "units/mujoco_world/scene/track.h"

namespace mujoco_world::scene {

/// What of a world can move or be switched, and so has tracks, in this order: a Point and a
/// Rotation for each body, then camera, then light; a Switch for each lamp and for each field,
/// whose value is its reach; for each contact its place, its orientation and whether there is one,
/// all of them Switches.
struct Animated {
  std::vector<int> bodies;   ///< that are not fixed to their parent, in its frame
  std::vector<int> cameras;  ///< that follow something, in the world's frame
  std::vector<int> lights;   ///< likewise
  std::vector<int> lamps;    ///< geoms
  std::vector<int> fields;   ///< sites
  std::size_t contacts = 0;  ///< how many can be shown at once

  std::vector<TrackType> tracks() const;
  std::size_t first_lamp() const { return 2 * (bodies.size() + cameras.size() + lights.size()); }
  std::size_t first_field() const { return first_lamp() + lamps.size(); }
  std::size_t first_contact() const { return first_field() + fields.size(); }
};

Animated animated_of(const mjModel& model, const Catalogue& catalogue);

/// A quaternion (w first) whose -z is a direction, as a light's node has it.
void light_orientation(const double* direction, double* quaternion);

/// What the file says of the run, beside what it shows.
struct RunNotes {
  std::string start_time, stop_time;  ///< [s], exactly
  double interval = 0;                ///< [s]
  double tolerance = 0;               ///< [m, rad]
  double resolution = 0;              ///< [s]
  std::uint64_t samples = 0;
  float duration = 0;  ///< [s], as keyframes have it
};

/// The world without its motion, made once.
class Document {
 public:
  /// Throws std::runtime_error if a texture cannot be encoded.
  Document(const mjModel& model, Animated animated);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const Animated& animated() const { return animated_; }

  /// The file, a GLB, with the keyframes of each track. The same gives the same bytes.
  std::string bytes(const std::vector<std::vector<TimedValue>>& tracks,
                    const RunNotes& notes) const;

 private:
  struct Still;  ///< what never changes

  Animated animated_;
  std::unique_ptr<Still> still_;
};

}  // namespace mujoco_world::scene

#endif
