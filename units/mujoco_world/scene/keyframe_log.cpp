#include "units/mujoco_world/scene/keyframe_log.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <system_error>
#include <type_traits>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "units/mujoco_world/write_error.h"

namespace mujoco_world::scene {
namespace {

namespace fs = std::filesystem;

static_assert(std::has_unique_object_representations_v<LogPosition>);
static_assert(sizeof(Keyframe) == 32, "it is written as it is");

constexpr std::uint64_t kHashOfNothing = 0xcbf29ce484222325U;

/// FNV-1a (Fowler, Noll, Vo), word by word.
std::uint64_t hash_of(std::uint64_t before, const Keyframe& keyframe) {
  std::array<std::uint32_t, 6> words{};
  static_assert(offsetof(Keyframe, hash) == sizeof words);
  std::memcpy(words.data(), &keyframe, sizeof words);
  for (const std::uint32_t word : words) before = (before ^ word) * 0x100000001b3U;
  return before;
}

/// The first ones of a file; fewer if it has no more, or from where they are not as they should be.
std::vector<Keyframe> read(const fs::path& file, std::uint64_t count) {
  std::vector<Keyframe> keyframes;
  std::ifstream stream(file, std::ios::binary);
  std::uint64_t hash = kHashOfNothing;
  Keyframe keyframe;
  while (keyframes.size() < count &&
         stream.read(reinterpret_cast<char*>(&keyframe), sizeof keyframe)) {
    hash = hash_of(hash, keyframe);
    if (keyframe.hash != hash) break;
    keyframes.push_back(keyframe);
  }
  return keyframes;
}

}  // namespace

KeyframeLog::KeyframeLog(fs::path file) : file_(std::move(file)) {}

KeyframeLog::~KeyframeLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

fs::path KeyframeLog::previous_file() const { return file_.string() + ".old"; }

LogPosition KeyframeLog::position() const {
  return {keyframes_.size(), keyframes_.empty() ? kHashOfNothing : keyframes_.back().hash};
}

bool KeyframeLog::has(const LogPosition& position) const {
  if (position.size > keyframes_.size()) return false;
  if (position.size == 0) return position.hash == kHashOfNothing;
  return keyframes_[position.size - 1].hash == position.hash;
}

void KeyframeLog::clear() {
  keyframes_.clear();
  kept_ = 0;
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  std::error_code ignored;  // one that stays is not that of a state of this run
  fs::remove(file_, ignored);
  fs::remove(previous_file(), ignored);
}

void KeyframeLog::add(std::uint32_t track, float time, const Value& value) {
  Keyframe keyframe{track, time, value, 0};
  keyframe.hash = hash_of(position().hash, keyframe);
  keyframes_.push_back(keyframe);
}

void KeyframeLog::replace(const std::vector<Keyframe>& keyframes) {
  if (descriptor_ >= 0) {  // otherwise no state knows its positions
    keep();
    ::close(std::exchange(descriptor_, -1));
    if (::rename(file_.c_str(), previous_file().c_str()) != 0) fail_to_write(previous_file());
  }
  keyframes_.clear();
  kept_ = 0;
  for (const Keyframe& keyframe : keyframes) add(keyframe.track, keyframe.time, keyframe.value);
}

void KeyframeLog::keep() {
  if (descriptor_ < 0) {
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail_to_write(file_);
  }
  if (kept_ == keyframes_.size()) return;
  write(kept_);
  kept_ = keyframes_.size();
}

void KeyframeLog::write(std::size_t from) {
  const auto* bytes = reinterpret_cast<const char*>(keyframes_.data());
  std::size_t at = from * sizeof(Keyframe);
  const std::size_t end = keyframes_.size() * sizeof(Keyframe);
  while (at < end) {
    const ssize_t written = ::pwrite(descriptor_, bytes + at, end - at, static_cast<off_t>(at));
    if (written < 0) fail_to_write(file_);
    at += static_cast<std::size_t>(written);
  }
}

bool KeyframeLog::go_back(const LogPosition& position) {
  if (has(position)) {
    keyframes_.resize(position.size);
    kept_ = std::min(kept_, keyframes_.size());
    return true;
  }
  for (const fs::path& file : {file_, previous_file()}) {
    std::vector<Keyframe> found = read(file, position.size);
    if (found.size() != position.size || found.empty()) continue;
    if (found.back().hash != position.hash) continue;
    keyframes_ = std::move(found);
    kept_ = 0;
    return true;
  }
  return false;
}

}  // namespace mujoco_world::scene
