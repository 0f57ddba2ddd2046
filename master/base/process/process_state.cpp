#include "master/base/process/process_state.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ios>
#include <optional>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace stride::core {
namespace {

constexpr std::streamsize kLongestLine = 1 << 20;

/// As Linux tells it; nothing without /proc.
std::optional<mode_t> told_mask() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "Umask:") status.ignore(kLongestLine, '\n');
  mode_t mask = 0;
  if (status >> std::oct >> mask) return mask;
  return std::nullopt;
}

mode_t present_mask() {
  if (const auto told = told_mask()) return *told;
  // Otherwise it can be read by a change only. A file that another thread makes meanwhile is for
  // the user alone.
  constexpr mode_t kPrivate = 077;
  const mode_t mask = ::umask(kPrivate);
  ::umask(mask);
  return mask;
}

constexpr const char* kNotPutBack = ", which cannot be put back";

}  // namespace

ProcessState::ProcessState(Extent extent) {
  if (extent == Extent::Everything) rest_.emplace();
}

std::vector<std::string> ProcessState::restore() const {
  std::vector<std::string> changes;
  const ProcessorMode now = ProcessorMode::present();
  if (now != mode_) {
    mode_.set();
    changes.push_back("the mode of the processor (" + mode_.differences(now) + ")");
  }
  locale_.restore(changes);
  if (rest_) rest_->restore(changes);
  return changes;
}

ProcessState::Rest::Rest()
    : folder(::open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)),
      folder_identity(FileIdentity::of(folder.number())),
      mask(present_mask()) {
  std::error_code error;  // then its path is of no use either
  folder_path = std::filesystem::current_path(error).string();
  for (std::size_t i = 0; i < kLimits.size(); ++i) ::getrlimit(kLimits[i], &limits[i]);
}

void ProcessState::Rest::restore(std::vector<std::string>& changes) const {
  restore_folder(changes);
  if (present_mask() != mask) {
    ::umask(mask);
    changes.emplace_back("the mask of files' modes (umask)");
  }
  environment.restore(changes);
  signals.restore(changes);
  restore_limits(changes);
}

/// By its path where a unit has closed the open folder or put another one in its place.
void ProcessState::Rest::restore_folder(std::vector<std::string>& changes) const {
  const auto is_there = [&] { return FileIdentity::of(".") == folder_identity; };
  if (!folder_identity || is_there()) return;
  bool is_back = FileIdentity::of(folder.number()) == folder_identity;
  is_back = (is_back && ::fchdir(folder.number()) == 0) ||
            (!folder_path.empty() && ::chdir(folder_path.c_str()) == 0);
  is_back = is_back && is_there();
  changes.push_back(std::string("the working folder") + (is_back ? "" : kNotPutBack));
}

void ProcessState::Rest::restore_limits(std::vector<std::string>& changes) const {
  for (std::size_t i = 0; i < kLimits.size(); ++i) {
    const rlimit& before = limits[i];
    rlimit now{};
    ::getrlimit(kLimits[i], &now);
    if (now.rlim_cur >= before.rlim_cur && now.rlim_max >= before.rlim_max) continue;
    const rlimit possible{std::min(before.rlim_cur, now.rlim_max), now.rlim_max};
    const bool is_back = ::setrlimit(kLimits[i], &before) == 0;
    if (!is_back) ::setrlimit(kLimits[i], &possible);
    changes.push_back(std::string("a resource limit") + (is_back ? "" : kNotPutBack));
  }
}

}  // namespace stride::core
