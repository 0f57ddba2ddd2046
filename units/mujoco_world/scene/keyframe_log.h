// The keyframes of an animation in the order in which they have come about.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_SCENE_KEYFRAME_LOG_H
#define STRIDE_UNITS_MUJOCO_WORLD_SCENE_KEYFRAME_LOG_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace mujoco_world::scene {

/// A point x, y, z, a quaternion x, y, z, w, or a number.
using Value = std::array<float, 4>;

struct Keyframe {
  std::uint32_t track = 0;
  float time = 0;  ///< since the beginning [s]
  Value value{};
  std::uint64_t hash = 0;  ///< of all up to this one
};

/// Where a log was: a position in it, and what was before.
struct LogPosition {
  std::uint64_t size = 0;
  std::uint64_t hash = 0;
};

/// It grows at its end and is cut there, so that a state of it is known by a position. For states
/// that are restored in another process it is kept in a file, when asked for; of one that is
/// replaced, the last one before, too.
///
/// Functions throw std::system_error with the file if that cannot be written.
class KeyframeLog {
 public:
  explicit KeyframeLog(std::filesystem::path file);
  ~KeyframeLog();
  KeyframeLog(const KeyframeLog&) = delete;
  KeyframeLog& operator=(const KeyframeLog&) = delete;

  const std::vector<Keyframe>& keyframes() const { return keyframes_; }
  LogPosition position() const;

  /// Removes all, and the files.
  void clear();
  void add(std::uint32_t track, float time, const Value& value);
  /// Instead of what it has; the positions of then stay known to go_back().
  void replace(const std::vector<Keyframe>& keyframes);

  /// Writes what the file does not have.
  void keep();
  /// To a position of this log or, where another one was here, of the one in the files; false if
  /// neither has it, and the log stays as it is.
  bool go_back(const LogPosition& position);

 private:
  bool has(const LogPosition& position) const;
  void write(std::size_t from);
  std::filesystem::path previous_file() const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<Keyframe> keyframes_;
  std::size_t kept_ = 0;  // of them, in the file
};

}  // namespace mujoco_world::scene

#endif
