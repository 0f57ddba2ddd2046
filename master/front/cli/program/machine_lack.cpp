#include "master/front/cli/program/machine_lack.h"

#include <exception>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

#include "master/base/child_process/child.h"
#include "master/front/cli/program/memory_limits.h"

namespace stride::cli {
namespace {

constexpr rlim_t kUsualFiles = 1024;
constexpr int kThreads = 16;

bool is_memory_limited() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

bool can_have_processes() {
  const auto start_threads = [] {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i) threads.emplace_back([] {});
    return std::string();
  };
  try {
    return isolation::run_in_child(start_threads).end == isolation::ChildOutcome::End::Answered;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::optional<MachineLack> find_machine_lack() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur < kUsualFiles) {
    return MachineLack{fmt::format("a process may have {} open files here", files.rlim_cur),
                       fmt::format("raise the limit (ulimit -n {})", kUsualFiles)};
  }
  if (can_have_processes()) return std::nullopt;
  if (is_memory_limited()) {
    return MachineLack{"there is not enough memory for a process with some threads", memory_hint()};
  }
  return MachineLack{"there can be no more processes or threads",
                     "raise the limit (ulimit -u), or end other programs"};
}

}  // namespace stride::cli
