#include "master/observe/recorders/results_folder.h"

#include <cerrno>
#include <csignal>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"

namespace stride::recorders {
namespace {

namespace fs = std::filesystem;

/// The process that has locked the open file, if that is known.
std::optional<pid_t> lock_holder(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  const std::string file = fmt::format("{:02x}:{:02x}:{}", gnu_dev_major(status.st_dev),
                                       gnu_dev_minor(status.st_dev), status.st_ino);
  std::ifstream locks("/proc/locks");  // "1: FLOCK  ADVISORY  WRITE 4711 08:01:1234 0 EOF"
  for (std::string line; std::getline(locks, line);) {
    std::istringstream words(line);
    std::string number, type, mode, access, where;
    pid_t process = 0;
    words >> number >> type >> mode >> access >> process >> where;
    if (type == "FLOCK" && where == file && process > 0) return process;
  }
  return std::nullopt;
}

/// A process that a unit of an earlier run has left may still have that run's lock.
bool has_ended(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }

/// "process 4711 ('stride')": a unit in a process of its own has its name there.
std::string words_for(std::optional<pid_t> process) {
  if (!process) return "another process";
  std::string name;
  std::getline(std::ifstream(fmt::format("/proc/{}/comm", *process)), name);
  return fmt::format("process {} ('{}')", *process, name);
}

}  // namespace

bool is_plain_file_name(const std::string& name) {
  return name != "." && name != ".." && name.find('/') == std::string::npos;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

fs::path resolved(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  if (const fs::path absolute = fs::absolute(path, error); !error) path = absolute;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, error); ++i) {
    path = path.parent_path() / fs::read_symlink(path, error);
  }
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? path : target;
}

void make_results_folder(const fs::path& folder) {
  const auto fail = [&](const std::string& reason,
                        const char* hint = "choose another results folder") {
    core::fail_input({.where = {folder.string(), 0}},
                     fmt::format("cannot write results into this folder: {}", reason), hint);
  };
  if (folder.empty()) fail("its name is empty");
  if (core::is_link_loop(folder)) fail(core::why_unreachable(folder), core::kLinkLoopHint);
  std::error_code error;
  if (fs::is_symlink(folder, error) && !core::path_exists(folder)) {
    fail(fmt::format("it is a link to '{}', which does not exist",
                     fs::read_symlink(folder, error).string()),
         "make that folder, or choose another results folder");
  }
  const auto status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    fail("it is a file");
  }
  fs::create_directories(folder, error);
  if (error) {
    core::fail_output(error, {.where = {folder.string(), 0}},
                      "cannot write results into this folder", "choose another results folder");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail(std::generic_category().message(errno));
}

void check_name_lengths(const fs::path& folder, const ResultFiles& files) {
  const long most = ::pathconf(folder.c_str(), _PC_NAME_MAX);
  for (const auto& [what, member] : kResultFiles) {
    const std::string& name = files.*member;
    if (most < 0 || name.size() <= static_cast<std::size_t>(most)) continue;
    core::fail_input({.where = {(folder / name).string(), 0}},
                     fmt::format("the name of this file has {} bytes, and {} at most are possible "
                                 "in this folder",
                                 name.size(), most),
                     fmt::format("choose a shorter name: <stride:Results {}=\"…\"/>", what));
  }
}

ResultsLock::ResultsLock(const fs::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const int open = folder_.number();
  if (open < 0 || ::flock(open, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  const std::optional<pid_t> holder = lock_holder(open);
  if (holder && has_ended(*holder)) return;
  core::fail_input({.where = {folder.string(), 0}},
                   fmt::format("{} has locked this folder, as a run does while it writes its "
                               "results there",
                               words_for(holder)),
                   "wait for its end, or choose another results folder with --out");
}

void remove_results(const fs::path& folder, const ResultFiles& files) {
  for (const auto& [what, member] : kResultFiles) {
    std::error_code ignored;  // what cannot be removed fails where it is to be replaced
    const fs::path file = folder / (files.*member);
    if (fs::is_regular_file(fs::symlink_status(file, ignored))) fs::remove(file, ignored);
  }
}

}  // namespace stride::recorders
