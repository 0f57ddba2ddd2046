// Which commands bring a site of a robot to a place: inverse kinematics, and what holds it there.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_ROBOT_REACH_H
#define STRIDE_UNITS_MUJOCO_WORLD_ROBOT_REACH_H

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "units/mujoco_world/mjcf.h"

namespace mujoco_world {

/// A pose of the whole world, at rest.
struct Pose {
  std::vector<double> positions;      ///< qpos
  std::vector<double> commands;       ///< ctrl, so that the drives hold that pose against gravity
  std::vector<std::string> contacts;  ///< "'a' and 'b'": what touches there, by geom or body
  std::vector<std::string> overload;  ///< joints whose drives are too weak to hold it
};

/// Finds poses in which one site lies on the axis of another, face to face: at a distance along the
/// target's z, its own z the other way. The turn about that axis is free.
///
/// The joints that move are the hinges and slides that a position servo with gear ±1 drives, within
/// their ranges and those of the commands; all else stays as it is at the start (World). Damped
/// least squares (C. W. Wampler, "Manipulator Inverse Kinematic Solutions Based on Vector
/// Formulations and Damped Least-Squares Methods", IEEE Trans. SMC 16, 1986), from the pose before
/// and from a fixed sequence of others, so that the same question has the same answer.
class Reach {
 public:
  /// Reads the world as World does. Throws std::runtime_error as find_scene() and load_model() do,
  /// and for a site that is not there or a world without such a servo.
  Reach(const std::filesystem::path& folder, const std::string& site, const std::string& target);

  const Catalogue& catalogue() const { return catalogue_; }

  /// One pose for each distance [m], in this order. Of the ways from the start through all of them
  /// that were found, it is one without contacts if there is any, and the shortest of these: the
  /// sum over its legs of what the joint that moves most moves. Throws std::runtime_error that
  /// contains how near it came.
  std::vector<Pose> solve(const std::vector<double>& distances);

 private:
  struct Servo {
    int actuator;  // in the model
    int control, joint, position, velocity;
    double low, high;  // of the joint [rad] or [m]
  };
  struct Miss {
    double place, turn;  // [m], [rad]
  };
  struct Way {
    std::vector<std::vector<double>> poses;  // angles of the servos' joints
    double length = 0;
    int contacts = 0;
  };
  struct DeleteData {
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  int find_site(const std::string& name) const;
  void list_servos();
  void start();
  void put(const std::vector<double>& angles);
  std::array<double, 6> residual(double distance) const;
  Miss miss(double distance) const;
  std::vector<double> jacobian() const;
  std::vector<double> step(const std::array<double, 6>& left) const;
  void improve(double distance, std::vector<double>& angles);
  bool follow(const std::vector<double>& distances, std::vector<double> angles, Way& way);
  void note_miss(double distance, const Miss& miss, std::size_t reached);
  Pose pose();
  std::vector<std::string> contacts() const;

  ModelPointer model_;
  Catalogue catalogue_;
  std::unique_ptr<mjData, DeleteData> data_;
  int site_, target_;
  std::vector<Servo> servos_;
  std::vector<double> start_;  // angles of the servos' joints
  std::string nearest_;        // of the ways that failed: how near it came
  int farthest_ = 0;           // minus the number of poses that were reached before
  double least_miss_ = 0;
};

}  // namespace mujoco_world

#endif
