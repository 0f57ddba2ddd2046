#include "master/base/process/remnants.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <string_view>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/process/loaded_object.h"
#include "master/base/text/counted.h"

namespace stride::core {
namespace {

constexpr const char* kTasks = "/proc/self/task";

/// Where there is no /proc, none.
std::set<pid_t> present_threads() {
  std::set<pid_t> threads;
  for (const auto& entry : folder_entries(kTasks)) {
    threads.insert(std::stoi(entry.filename().string()));
  }
  return threads;
}

/// Some have one that says what they do.
std::string thread_name(pid_t thread) {
  std::ifstream file(fmt::format("{}/{}/comm", kTasks, thread));
  std::string name;
  std::getline(file, name);
  return name;
}

std::string words_for(const std::set<pid_t>& threads) {
  if (threads.empty()) return "";
  constexpr std::size_t kMostNames = 4;
  std::set<std::string> names;
  for (const pid_t thread : threads) names.insert(thread_name(thread));
  const std::size_t shown = std::min(names.size(), kMostNames);
  const std::vector<std::string> first(names.begin(),
                                       std::next(names.begin(), std::ptrdiff_t(shown)));
  return fmt::format("{} ({}{})", counted(threads.size(), "thread"), quoted(first),
                     shown < names.size() ? ", …" : "");
}

bool calls_function(const struct sigaction& action) {
  return action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN;
}

struct sigaction present_action(int signal) {
  struct sigaction action {};
  ::sigaction(signal, nullptr,
              &action);  // fails for those of the C library, which stay as they are
  return action;
}

}  // namespace

Remnants::Remnants() : threads_(present_threads()), objects_(loaded_objects()) {
  for (int signal = 1; signal < NSIG; ++signal) {
    actions_[static_cast<std::size_t>(signal)] = present_action(signal);
  }
}

std::string Remnants::find() const {
  std::string found = words_for(threads_that_stay());
  for (int signal = 1; signal < NSIG; ++signal) {
    const struct sigaction now = present_action(signal);
    const struct sigaction& before = actions_[static_cast<std::size_t>(signal)];
    if (!calls_function(now) || now.sa_handler == before.sa_handler) continue;
    if (objects_.contains(loaded_object_at(reinterpret_cast<const void*>(now.sa_handler))))
      continue;
    const char* const name = ::sigabbrev_np(signal);
    found += fmt::format("{}a handler of SIG{}", found.empty() ? "" : ", ",
                         name != nullptr ? name : std::to_string(signal));
  }
  return found;
}

std::set<pid_t> Remnants::new_threads() const {
  const std::set<pid_t> present = present_threads();
  std::set<pid_t> found;
  std::ranges::set_difference(present, threads_, std::inserter(found, found.end()));
  found.erase(::getpid());  // that of a fork, which has none of the threads that were noted
  return found;
}

/// One that has been joined is still listed for some microseconds.
std::set<pid_t> Remnants::threads_that_stay() const {
  constexpr std::chrono::milliseconds kPause{1};
  std::set<pid_t> found = new_threads();
  for (int pauses = 0; !found.empty() && pauses < 100; ++pauses) {
    std::this_thread::sleep_for(kPause);
    found = new_threads();
  }
  return found;
}

}  // namespace stride::core
