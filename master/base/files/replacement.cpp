#include "master/base/files/replacement.h"

#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"

namespace stride::core {
namespace {

namespace fs = std::filesystem;

constexpr OutputFile::Hints kHints = {
    "choose a file in a folder in which you may write",
    "make room on the disk that this file is on, or check it; nothing is left of it"};

/// The file that is to be replaced.
fs::path target_of(const fs::path& path) {
  if (path.empty()) fail_input({}, "no file is named to write to");
  if (is_link_loop(path)) {
    fail_input({.where = {path.string(), 0}},
               fmt::format("cannot write the file: {}", why_unreachable(path)), kLinkLoopHint);
  }
  std::error_code error;
  if (Replacement::is_at_once(path)) return path;
  if (fs::is_symlink(path, error)) {
    const fs::path target = fs::weakly_canonical(path, error);
    if (!error) return target;
  }
  return path;
}

void check(const fs::path& path) {
  const Context where{.where = {path.string(), 0}};
  if (is_folder(path)) {
    fail_input(where, "this is a folder; expected a file to write to");
  }
  const fs::path folder = path.parent_path();
  if (folder.empty() || is_folder(folder)) return;
  const std::string reason = why_unreachable(folder);
  fail_input(where,
             reason.empty() ? "the folder of this file does not exist"
                            : fmt::format("cannot reach the folder of this file: {}", reason),
             "make the folder, or choose another output file");
}

/// Beside the file; cut off, in whole characters, where the name with the suffix would be too long.
fs::path fresh_name(const fs::path& target) {
  constexpr std::string_view kSuffix = ".stride-new";
  constexpr std::size_t kLongest = 255;  // of a name in a file system
  std::string name = target.filename().string();
  if (name.size() + kSuffix.size() > kLongest) {
    std::size_t kept = kLongest - kSuffix.size();
    while (kept > 0 && (static_cast<unsigned char>(name[kept]) & 0xC0U) == 0x80U) --kept;
    name.resize(kept);
  }
  return target.parent_path() / name.append(kSuffix);
}

}  // namespace

bool Replacement::is_at_once(const fs::path& path) {
  const std::string folder = fs::absolute(path).lexically_normal().parent_path();
  return folder == "/dev" || folder == "/dev/fd" || folder.starts_with("/proc/") ||
         (path_exists(path) && !is_file(path));
}

Replacement::Replacement(const fs::path& path) : target_(target_of(path)) {
  check(target_);
  if (is_at_once(target_)) {
    file_.emplace(target_, kHints);
    return;
  }
  fresh_ = fresh_name(target_);
  std::error_code ignored;  // what stays fails below
  fs::remove(fresh_, ignored);
  file_.emplace(fresh_, kHints, OutputFile::Existing::Refused);
}

Replacement::~Replacement() {
  file_.reset();
  std::error_code ignored;
  if (!fresh_.empty()) fs::remove(fresh_, ignored);
}

void Replacement::commit() {
  file_->close();
  if (fresh_.empty()) return;
  std::error_code error;
  fs::rename(fresh_, target_, error);
  if (error) {
    fail_run({.where = {target_.string(), 0}},
             fmt::format("cannot replace the file: {}", error.message()));
  }
  fresh_.clear();
}

}  // namespace stride::core
