// The pictures of a film as files.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_FRAMES_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_FRAMES_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include <stride/time.h>

namespace mujoco_world::film {

/// A folder with the pictures 00000.jpg, 00001.jpg …, and frames.csv, which has a row `time,file`
/// for each, the time in seconds with all its digits. After each call the folder is complete, even
/// if the process ends then. In a process that goes on from a fork, the film goes on from what it
/// was at the fork, whatever others have written since.
///
/// All functions but the destructor throw std::runtime_error with the file if it cannot be written.
class Frames {
 public:
  /// Makes the folder, and leaves the film that may be there as it is until begin() or adopt().
  explicit Frames(const std::filesystem::path& folder);
  ~Frames();
  Frames(const Frames&) = delete;
  Frames& operator=(const Frames&) = delete;

  /// Removes the film that is there. The one that begins has no frame yet.
  void begin();
  /// Goes on with the film that is there, which another process has written, as it was at that
  /// time. What is later, or not in the list, or behind a picture that is missing, is removed.
  void adopt(stride::Time time);

  /// After all that it has.
  void add(stride::Time time, const std::vector<std::uint8_t>& jpeg);
  /// Of its last frame, which must be there.
  void replace_last(const std::vector<std::uint8_t>& jpeg);
  void remove_after(stride::Time time);
  std::size_t size() const { return rows_.size(); }
  /// Whether its last frame is of that time.
  bool ends_at(stride::Time time) const { return !rows_.empty() && rows_.back().time == time; }

 private:
  struct Row {
    stride::Time time;
    off_t end;  ///< of its line in frames.csv
  };

  off_t end() const;
  void read_rows(stride::Time last);
  void cut();
  std::filesystem::path picture(std::size_t number) const;
  void write_line(const std::string& line, off_t at);
  void remove_pictures_from(std::size_t number) const;

  std::filesystem::path folder_;
  int list_ = -1;  ///< the file descriptor of frames.csv
  bool has_begun_ = false;
  std::vector<Row> rows_;
};

}  // namespace mujoco_world::film

#endif
