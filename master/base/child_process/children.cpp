#include "master/base/child_process/children.h"

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include <sys/ptrace.h>
#include <sys/wait.h>

namespace stride::isolation {
namespace {

namespace fs = std::filesystem;

/// It is a zombie afterwards until its parent has waited for it, or, the first thread of a process,
/// until the others have ended.
bool has_died(pid_t thread) {
  std::ifstream file("/proc/" + std::to_string(thread) + "/stat");
  std::string text;
  std::getline(file, text, '\0');
  const std::size_t name_end = text.rfind(')');  // a name may contain anything
  if (name_end == std::string::npos || name_end + 2 >= text.size()) return true;
  const char state = text[name_end + 2];
  return state == 'Z' || state == 'X';
}

}  // namespace

std::optional<pid_t> living_thread(pid_t process) {
  if (!has_died(process)) return process;
  std::error_code gone;
  fs::directory_iterator thread("/proc/" + std::to_string(process) + "/task", gone);
  for (const fs::directory_iterator end; !gone && thread != end; thread.increment(gone)) {
    const pid_t number = std::stoi(thread->path().filename().string());
    if (!has_died(number)) return number;
  }
  return std::nullopt;
}

std::optional<std::vector<pid_t>> children_of(pid_t process) {
  std::error_code gone;
  fs::directory_iterator thread("/proc/" + std::to_string(process) + "/task", gone);
  std::vector<pid_t> found;
  bool is_listed = false;
  for (const fs::directory_iterator end; !gone && thread != end; thread.increment(gone)) {
    std::ifstream file(thread->path() / "children");
    is_listed |= file.is_open();
    for (pid_t child = 0; file >> child;) found.push_back(child);
  }
  return is_listed ? std::optional(std::move(found)) : std::nullopt;
}

std::vector<pid_t> descendants_of(pid_t process) {
  std::vector<pid_t> found = children_of(process).value_or(std::vector<pid_t>{});
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto further = children_of(found[i]);
    if (further) found.insert(found.end(), further->begin(), further->end());
  }
  return found;
}

bool kill_children_of(pid_t process) {
  bool is_one_left = false;
  for (const pid_t child : children_of(process).value_or(std::vector<pid_t>{})) {
    if (!living_thread(child)) continue;
    ::kill(child, SIGKILL);
    is_one_left = true;
  }
  return is_one_left;
}

void let_go(pid_t child, int status) noexcept {
  const auto signal = static_cast<std::intptr_t>(WSTOPSIG(status));
  ::ptrace(PTRACE_DETACH, child, nullptr, reinterpret_cast<void*>(signal));
}

}  // namespace stride::isolation
