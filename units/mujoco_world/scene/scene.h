// A world's scene: the world and its motion as a glTF file.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_SCENE_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_SCENE_H

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

#include <stride/time.h>
#include <stride/unit/state.h>

#include "units/mujoco_world/model.h"
#include "units/mujoco_world/recording.h"
#include "units/mujoco_world/scene/animation.h"
#include "units/mujoco_world/scene/document.h"

namespace mujoco_world::scene {

/// A state of a scene, that of its world beside it.
struct SceneState {
  bool has_begun = false;
  stride::Time start{};
  AnimationState animation;  ///< where it has begun

  void write(stride::StateWriter& writer) const;
  void read(stride::StateReader& reader);
};

/// Samples the world at the multiples of the interval and where a watched contact or a lamp
/// changes, or a field comes or goes. The file is written when it begins and ends, and now and then
/// in between, so that this takes about a twentieth of the time; it is always whole.
class Scene : public Recording {
 public:
  /// `world` must outlive it. Throws std::invalid_argument for an interval that is not positive,
  /// and std::system_error with the file if it cannot be written.
  Scene(World& world, stride::Duration interval, const std::filesystem::path& file,
        AnimationLimits limits = {});
  /// Writes what has not been written, as after a run that has failed; what cannot be is lost.
  ~Scene() override;

  stride::Duration interval() const { return interval_; }

  void begin() override;
  void show_display() override;
  stride::Time next() const override { return next_; }
  void take() override;
  void see_contact_change() override { sample(); }
  bool wants_contact_changes() const override { return true; }

  /// Writes the file with the world's present as its end.
  void write();

  const Animation& animation() const { return animation_; }

  SceneState state();
  /// The world was set to a state, that of another process perhaps: goes on from what the scene was
  /// then; false if that is not known any more.
  bool go_on(const SceneState& state);

 private:
  void sample();
  void write_to_file(stride::Time end, const std::vector<Value>& values);
  std::vector<Value> values();
  std::vector<Value> unknown_values() const;
  void put_poses(const mjData& data);
  void put_contacts(const mjData& data);
  double seconds(stride::Time time) const { return stride::to_seconds(time - start_); }

  World& world_;
  stride::Duration interval_;
  std::filesystem::path file_;
  Document document_;
  Animation animation_;
  bool has_begun_ = false;
  stride::Time start_{};
  stride::Time next_{};
  std::vector<Value> values_;
  Display shown_;            ///< in the last sample
  stride::Time sampled_{};   ///< when that was
  bool is_written_ = false;  ///< as it is
  stride::Time written_end_{};
  std::chrono::steady_clock::time_point last_write_{};
  std::chrono::steady_clock::duration write_duration_{};
};

}  // namespace mujoco_world::scene

#endif
