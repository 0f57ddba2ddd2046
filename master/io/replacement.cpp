#include "master/io/replacement.h"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/core/error.h"

namespace stride::io {
namespace {

namespace fs = std::filesystem;

constexpr OutputFile::Hints kHints = {
    "choose a file in a folder in which you may write",
    "check the disk that this file is on, and that there is room on it; nothing is left of it"};

/// The file that is to be replaced.
fs::path target_of(const fs::path& path) {
  std::error_code error;
  if (fs::is_symlink(path, error)) {
    const fs::path target = fs::weakly_canonical(path, error);
    if (!error) return target;
  }
  return path;
}

void check(const fs::path& path) {
  const core::Context where{.where = {path.string(), 0}};
  if (path.empty()) core::fail_input({}, "no file is named to write to");
  if (fs::is_directory(path)) {
    core::fail_input(where, "this is a folder; expected a file to write to");
  }
  if (!path.parent_path().empty() && !fs::is_directory(path.parent_path())) {
    core::fail_input(where, "the folder of this file does not exist",
                     "make the folder, or choose another output file");
  }
}

}  // namespace

Replacement::Replacement(const fs::path& path) : target_(target_of(path)) {
  check(target_);
  const bool has_own_place = fs::exists(target_) && !fs::is_regular_file(target_);
  if (!has_own_place) fresh_ = target_.string() + ".new";
  file_.emplace(has_own_place ? target_ : fresh_, kHints);
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
    core::fail_run({.where = {target_.string(), 0}},
                   fmt::format("cannot replace the file: {}", error.message()));
  }
  fresh_.clear();
}

}  // namespace stride::io
