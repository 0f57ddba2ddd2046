// What is taken of a world at the multiples of an interval, while it is moved.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_RECORDING_H
#define STRIDE_UNITS_MUJOCO_WORLD_RECORDING_H

#include <array>

#include <stride/time.h>

#include "units/mujoco_world/model.h"

namespace mujoco_world {

/// Takes something of a world at the instants k * interval, k whole, from its beginning on, so that
/// it does not depend on the steps that the world is moved by. Functions throw std::runtime_error
/// where what is taken cannot be written.
class Recording {
 public:
  virtual ~Recording() = default;

  /// Replaces what another run has left, and takes the world's present. Does nothing where it has
  /// begun.
  virtual void begin() = 0;

  /// What devices show is from the world's present on as it is now.
  virtual void show_display() = 0;

  /// The next instant at which it takes something, after the world's present.
  virtual stride::Time next() const = 0;

  /// Takes the world's present, which is next().
  virtual void take() = 0;

  /// At the world's present a watched contact has begun or ended; called before take().
  virtual void see_contact_change() {}
  virtual bool wants_contact_changes() const { return false; }
};

using Recordings = std::array<Recording*, 2>;  ///< null pointers are none

/// Moves the world as World::advance() does, with its display as it is now, and stops on the way
/// where recordings take something.
bool advance(World& world, const Recordings& recordings, stride::Time to,
             bool stops_at_contacts = false);

stride::Time first_multiple_at_or_after(stride::Time time, stride::Duration interval);

}  // namespace mujoco_world

#endif
