#include "units/mujoco_world/film/frames.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <stride/time_text.h>

#include "units/mujoco_world/write_error.h"

namespace mujoco_world::film {
namespace {

namespace fs = std::filesystem;

const std::string kHeader = "time,file\n";

void write_file(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail_to_write(path);
  const ssize_t written = ::write(file, bytes.data(), bytes.size());
  // a partial write has not given its reason
  if (written >= 0 && static_cast<std::size_t>(written) < bytes.size()) errno = ENOSPC;
  const bool is_whole = static_cast<std::size_t>(written) == bytes.size();
  const int reason = errno;
  ::close(file);
  errno = reason;
  if (!is_whole) fail_to_write(path);
}

std::string picture_name(std::size_t number) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%05zu.jpg", number);
  return name.data();
}

}  // namespace

Frames::Frames(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::system_error(error, "cannot make the folder '" + folder.string() + "'");
  const fs::path list = folder_ / "frames.csv";
  list_ = ::open(list.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (list_ < 0) fail_to_write(list);
}

/// What is left of what another process wrote, from which this one was forked, is not of this film.
Frames::~Frames() {
  if (has_begun_ && ::ftruncate(list_, end()) == 0) remove_pictures_from(rows_.size());
  ::close(list_);
}

void Frames::begin() {
  has_begun_ = true;
  rows_.clear();
  remove_pictures_from(0);
  write_line(kHeader, 0);
}

void Frames::adopt(stride::Time time) {
  has_begun_ = true;
  rows_.clear();
  read_rows(time);
  if (rows_.empty()) return begin();
  cut();
}

/// Those of the list, up to the first that is not as add() has written it, or is later than `last`.
void Frames::read_rows(stride::Time last) {
  std::ifstream list(folder_ / "frames.csv", std::ios::binary);
  std::string line;
  if (!std::getline(list, line) || line + "\n" != kHeader) return;
  while (std::getline(list, line) && !list.eof()) {
    const std::size_t comma = std::min(line.find(','), line.size());
    const std::string seconds = line.substr(0, comma);
    const auto time = stride::time_of_decimal(seconds);
    const std::string name = picture_name(rows_.size());
    std::error_code ignored;
    if (!time || stride::decimal_seconds(*time) != seconds) return;
    if (*time > last || (!rows_.empty() && *time <= rows_.back().time)) return;
    if (line.substr(comma) != "," + name || !fs::exists(folder_ / name, ignored)) return;
    rows_.push_back({*time, end() + static_cast<off_t>(line.size() + 1)});
  }
}

off_t Frames::end() const {
  return rows_.empty() ? static_cast<off_t>(kHeader.size()) : rows_.back().end;
}

fs::path Frames::picture(std::size_t number) const { return folder_ / picture_name(number); }

void Frames::add(stride::Time time, const std::vector<std::uint8_t>& jpeg) {
  const std::size_t number = rows_.size();
  write_file(picture(number), jpeg);
  const std::string line = stride::decimal_seconds(time) + "," + picture_name(number) + "\n";
  write_line(line, end());
  rows_.push_back({time, end() + static_cast<off_t>(line.size())});
}

/// It leaves the list until its file is whole again.
void Frames::replace_last(const std::vector<std::uint8_t>& jpeg) {
  const stride::Time time = rows_.back().time;
  rows_.pop_back();
  cut();
  add(time, jpeg);
}

/// The last one of the file from then on.
void Frames::write_line(const std::string& line, off_t at) {
  const auto size = static_cast<ssize_t>(line.size());
  if (::ftruncate(list_, at) != 0 || ::pwrite(list_, line.data(), line.size(), at) != size) {
    fail_to_write(folder_ / "frames.csv");
  }
}

void Frames::remove_after(stride::Time time) {
  const auto is_later = [&](const Row& row) { return row.time > time; };
  const auto first = std::find_if(rows_.begin(), rows_.end(), is_later);
  if (first == rows_.end()) return;
  rows_.erase(first, rows_.end());
  cut();
}

/// Removes what is behind the last row.
void Frames::cut() {
  if (::ftruncate(list_, end()) != 0) fail_to_write(folder_ / "frames.csv");
  remove_pictures_from(rows_.size());
}

void Frames::remove_pictures_from(std::size_t number) const {
  std::error_code ignored;  // a picture that is not in the list is not part of the film
  while (fs::remove(picture(number), ignored)) ++number;
}

}  // namespace mujoco_world::film
