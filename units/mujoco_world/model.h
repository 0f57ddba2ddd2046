// A MuJoCo world which any communication step may cut anywhere without changing the motion.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_MODEL_H
#define STRIDE_UNITS_MUJOCO_WORLD_MODEL_H

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "units/mujoco_world/clearance.h"
#include "units/mujoco_world/contacts.h"
#include "units/mujoco_world/display.h"
#include "units/mujoco_world/mjcf.h"
#include "units/mujoco_world/rest.h"
#include "units/mujoco_world/start_pose.h"

namespace mujoco_world {

using Vector = std::array<double, 3>;

/// How far what is seen of a world may be from where the resting one shows it, in the unit of each.
struct RestTolerances {
  std::vector<double> joint_positions, joint_velocities;  ///< of the joints in the catalogue
  std::vector<Vector> site_positions, site_axes;          ///< of its sites
  std::vector<double> sensors;                            ///< of all numbers of its sensors
};

struct RestSettings {
  RestLimits limits;
  RestTolerances tolerances;
  stride::Duration longest = stride::Duration::max();  ///< no rest is longer
};

/// Integrates the model on its own grid: instants start + k * timestep, whatever the communication
/// points are. An actuator's input is taken at a grid point and holds for the grid step that begins
/// there; one set in between waits for the next. Between grid points the outputs follow the last
/// one: pose along the velocity, velocity held. So outputs depend on the instant and on past inputs
/// alone, and an input never shows in an output of the same instant.
///
/// A drive's ripple (DriveRipple) is added to an actuator's input where it is taken, by the joint's
/// position there.
///
/// The model's timestep is rounded to whole picoseconds. The world begins in default_start(), if
/// nothing else is said; its keyframe's ctrl are the inputs' start values.
///
/// Watched contacts are looked at where grid points are reached, and hold until the next one.
///
/// With allow_rest(), a world that has come to rest (RestDetector) is not integrated any more: at a
/// grid point it is stopped, its velocities set to zero, and does not move until an input changes,
/// but at most for as long as what is seen of the moving one could not leave the tolerances, by the
/// bounds of its speeds and accelerations. Then it is let go for another half of a window at least.
/// When that happens is a matter of the grid and the inputs alone, too.
///
/// Not thread-safe, const functions included: they evaluate outputs on demand.
class World {
 public:
  /// Loads the MJCF that find_scene() finds. Throws std::runtime_error as find_scene() and
  /// load_model() do, and for a timestep below a picosecond.
  explicit World(const std::filesystem::path& folder);

  const mjModel& model() const { return *model_; }
  const Catalogue& catalogue() const { return catalogue_; }
  const std::vector<WatchedContact>& contacts() const { return contacts_; }
  stride::Duration timestep() const { return timestep_; }
  stride::Time now() const { return now_; }

  /// Lets it rest, or not any more; reset() or restore() must follow. Throws std::invalid_argument
  /// for a limit that is not positive.
  void allow_rest(const RestSettings& settings);
  void forbid_rest();

  /// To the initial state, with the grid's first point at `start`. Throws as put_at_start() does.
  void reset(stride::Time start, const StartPose& pose);
  void reset(stride::Time start) { reset(start, default_start(*model_)); }

  /// What is wrong with the present pose, see flaws_of_pose().
  std::vector<std::string> flaws() const;

  /// `actuator` indexes catalogue().actuators, the value is in its unit. Limits of the model apply
  /// inside MuJoCo. Throws std::invalid_argument if the value is not finite.
  void set_input(std::size_t actuator, double value);
  double input(std::size_t actuator) const { return inputs_.at(actuator); }

  /// Whether a lamp, by its index in catalogue().lamps, shines. It is seen in pictures only.
  void set_lamp(std::size_t lamp, bool on) { lamps_.at(lamp) = on ? 1.0 : 0.0; }
  /// How far a field, by its index in catalogue().fields, reaches along its axis [m], likewise.
  /// None is drawn unless that is positive and finite.
  void set_field(std::size_t field, double reach);
  Display display() const;
  bool has_display() const { return !lamps_.empty() || !fields_.empty(); }

  /// Until when nothing that is seen changes, unless an input is set to another value; now() if the
  /// world is not at rest.
  stride::Time rests_until() const { return resting_ && keeps_inputs() ? rest_end_ : now_; }

  /// Moves to `to`, not before now(). Where `stops_at_contacts`, the way ends before that, at the
  /// first grid point where a watched contact has begun or ended. Whether it ends at such a point
  /// is returned; always false without `stops_at_contacts`. Throws std::runtime_error with the
  /// joint and the time if the motion diverges, or with MuJoCo's message on an internal error;
  /// after that only reset() and restore() may follow.
  bool advance(stride::Time to, bool stops_at_contacts = false);

  /// The outputs at now(); indices are those of the catalogue, else std::out_of_range.
  double joint_position(std::size_t joint) const;  ///< [rad] or [m]
  double joint_velocity(std::size_t joint) const;  ///< [rad/s] or [m/s]
  Vector site_position(std::size_t site) const;    ///< [m], in the world's frame
  Vector site_axis(std::size_t site) const;        ///< the site's z as a unit vector, likewise
  Vector site_velocity(std::size_t site) const;    ///< [m/s], the rate of site_position()
  Vector site_axis_rate(std::size_t site) const;   ///< [1/s], the rate of site_axis()
  std::size_t sensor_numbers() const { return static_cast<std::size_t>(model_->nsensordata); }
  double sensor(std::size_t sensor, int element = 0) const;  ///< in the sensor's unit
  /// Whether a contact, by its index in contacts(), is closed.
  bool touches(std::size_t contact) const { return touching_.at(contact) != 0; }

  /// With the poses of all that can be drawn, at now(); valid until the next call of anything else.
  mjData& drawn() const;
  /// With MuJoCo's contacts at now(), likewise.
  const mjData& collided() const;

  /// Whether an error of advance() has left it without a present.
  bool has_failed() const { return failed_; }

  /// All that the future depends on, as one block of state_size() doubles. After restore() the same
  /// inputs give the same bits as after save(). The block fits the same model and MuJoCo only.
  std::size_t state_size() const;
  void save(double* block) const;
  void restore(const double* block);

 private:
  struct DeleteData {
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  using DataPointer = std::unique_ptr<mjData, DeleteData>;

  DataPointer make_data() const;
  void integrate();
  bool look_for_contacts();  // returns whether one has begun or ended
  void check_motion() const;
  [[noreturn]] void report_divergence(const char* quantity, int joint) const;
  void take_inputs();
  bool keeps_inputs() const;  // those that were taken last
  void look_for_rest();
  void rest(stride::Time to);
  stride::Duration rest_holds_for() const;
  stride::Duration joints_hold_for() const;
  stride::Duration site_holds_for(std::size_t site) const;
  stride::Duration sensors_hold_for() const;
  void move(stride::Time grid, stride::Time now);
  const mjData& posed() const;                                     // with poses and velocities
  const mjData& sensed() const;                                    // with the sensors, too
  bool has_contact() const;                                        // at the pose of posed()
  std::array<double, 6> spatial_velocity(std::size_t site) const;  // angular, linear

  ModelPointer model_;
  Catalogue catalogue_;
  std::vector<WatchedContact> contacts_;
  stride::Duration timestep_{};
  bool only_touches_;  // none but touch sensors
  Clearance clearance_;
  DataPointer grid_data_;     // the state at the grid point grid_
  DataPointer instant_data_;  // scratch: what is seen at now_
  std::vector<double> inputs_;
  std::vector<double> taken_;     // of these, at the last grid point
  std::vector<double> lamps_;     // 1 for one that shines
  std::vector<double> fields_;    // [m]; 0: none
  std::vector<double> touching_;  // 1 for a contact that is closed
  stride::Time grid_{};
  stride::Time now_{};
  bool failed_ = false;
  std::optional<RestSettings> rest_settings_;
  RestDetector rest_detector_;
  bool resting_ = false;
  stride::Time rest_end_{};
  mutable std::vector<double> scratch_;
  mutable bool pose_known_ = false;
  mutable bool sensors_known_ = false;
};

}  // namespace mujoco_world

#endif
