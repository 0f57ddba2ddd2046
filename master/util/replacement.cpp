#include "master/util/replacement.h"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/util/error.h"
#include "master/util/input_file.h"

namespace stride::core {
namespace {

namespace fs = std::filesystem;

constexpr OutputFile::Hints kHints = {
    "choose a file in a folder in which you may write",
    "make room on the disk that this file is on, or check it; nothing is left of it"};

/// The file that is to be replaced.
fs::path target_of(const fs::path& path) {
  if (path.empty()) fail_input({}, "no file is named to write to");
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
  fresh_ = target_.string() + ".new";
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
