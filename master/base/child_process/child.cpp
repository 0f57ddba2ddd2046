#include "master/base/child_process/child.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/child_process/children.h"
#include "master/base/child_process/descriptor.h"
#include "master/base/child_process/keeper.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/outliving_memory.h"
#include "master/base/process/own_exit.h"

namespace stride::isolation {
namespace {

using Clock = std::chrono::steady_clock;
using End = ChildOutcome::End;

constexpr std::size_t kPrintedKept = 4096;
/// How often a child is looked at whose pipes another process may hold open.
constexpr std::chrono::milliseconds kGlance{20};
/// How long a keeper may take to end what it keeps.
constexpr std::chrono::seconds kKeeperPatience{2};
constexpr useconds_t kKeeperGlance = 200;

/// What precedes the child's text.
constexpr char kAnswer = 'A';
constexpr char kException = 'E';

/// The child's surroundings: a library may have the habits of a program of its own.
void settle(pid_t parent, int output) {
  ::setpgid(0, 0);
  end_with(parent);
  core::OutlivingMemory::leave();
  reset_signal_handlers();
  redirect_standard_files(output);
}

/// Behind the exit functions of what the work has loaded, and before those of this program. If one
/// of these has called exit(0), that is no good end.
void end_at_once(int status, void*) {
  std::fflush(nullptr);
  archive::TemporaryFolder::remove_all(::getpid());
  const bool is_own = core::OwnExit::is_caller_of(__builtin_frame_address(0));
  ::_exit(is_own || status != 0 ? status : 1);
}

[[noreturn]] void be_child(const std::function<std::string()>& work, pid_t parent, bool has_keeper,
                           int answer, int output) {
  ::on_exit(end_at_once, nullptr);
  char kind = kAnswer;
  std::string text;
  try {
    settle(has_keeper ? go_on_kept(parent, answer) : parent, output);
    text = work();
  } catch (const std::exception& error) {
    kind = kException;
    text = error.what();
  } catch (...) {
    kind = kException;
    text = "something was thrown that is not a std::exception";
  }
  write_all(answer, &kind, 1);
  write_all(answer, text.data(), text.size());
  core::OwnExit::begin();
  std::exit(0);
}

/// Nothing is known of its end if the work of this process ignores that of children.
bool has_ended(pid_t child) {
  siginfo_t info{};
  const int options = WEXITED | WNOWAIT | WNOHANG;
  if (::waitid(P_PID, static_cast<id_t>(child), &info, options) != 0) return errno == ECHILD;
  return info.si_pid == child;
}

/// If somebody has stopped it.
void let_go_on(pid_t child) {
  siginfo_t info{};
  const int options = WSTOPPED | WNOHANG;
  const bool is_stopped =
      ::waitid(P_PID, static_cast<id_t>(child), &info, options) == 0 && info.si_pid == child;
  if (is_stopped) ::kill(child, SIGCONT);
}

/// Ends all of the child's group and takes the child's status away.
int reap(pid_t child) {
  ::kill(-child, SIGKILL);
  ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

class Child::Watch {
 public:
  Watch(pid_t child, Descriptor answer, Descriptor output, const ChildOptions& options)
      : child_(child),
        answer_(std::move(answer)),
        output_(std::move(output)),
        options_(options),
        begin_(Clock::now()) {}
  ~Watch() {
    if (!is_over_ && owner_ == ::getpid()) finish();
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  std::optional<ChildOutcome> wait(std::chrono::milliseconds patience) {
    const auto end = Clock::now() + patience;
    std::optional<End> cut_off;
    while (!has_ended(child_)) {
      if (options_.has_keeper) let_go_on(child_);
      read();
      cut_off = reason_to_stop();
      if (cut_off) break;
      const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
      if (rest.count() <= 0) return std::nullopt;
      const Watch* const self = this;
      await_any({&self, 1}, std::min(rest, kGlance));
    }
    const int status = finish();
    is_over_ = true;
    read();
    ChildOutcome outcome = cut_off ? ChildOutcome{*cut_off, 0, {}, {}} : judge(status);
    outcome.printed = std::move(printed_);
    return outcome;
  }

  bool is_of(pid_t process) const { return process == child_; }

  static void await_any(std::span<const Watch* const> watches, std::chrono::milliseconds patience) {
    std::vector<pollfd> files;
    bool is_over = false;  // when its pipes are closed it is about to end
    for (const Watch* const watch : watches) {
      files.push_back({watch->answer_.number(), POLLIN, 0});
      files.push_back({watch->output_.number(), POLLIN, 0});
      is_over = is_over || (!watch->answer_.is_open() && !watch->output_.is_open());
    }
    ::poll(files.data(), files.size(), is_over ? 1 : static_cast<int>(patience.count()));
  }

 private:
  void read() {
    drain(answer_, text_);
    drain(output_, printed_);
    if (printed_.size() > kPrintedKept) printed_.erase(0, printed_.size() - kPrintedKept);
  }

  std::optional<End> reason_to_stop() {
    const bool is_interrupted = options_.interrupted != nullptr && *options_.interrupted != 0;
    if (is_interrupted && !asked_to_end_ && options_.grace.count() > 0) {
      asked_to_end_ = Clock::now();
      ::kill(child_, SIGTERM);
    }
    if (is_interrupted && (!asked_to_end_ || Clock::now() - *asked_to_end_ > options_.grace)) {
      return End::Interrupted;
    }
    if (options_.limit && Clock::now() - begin_ > *options_.limit) return End::TimedOut;
    return std::nullopt;
  }

  int finish() const {
    if (options_.has_keeper) {
      ::kill(child_, SIGTERM);
      ::kill(child_, SIGCONT);
      const auto enough = Clock::now() + kKeeperPatience;
      while (!has_ended(child_) && Clock::now() < enough) ::usleep(kKeeperGlance);
    }
    return reap(child_);
  }

  ChildOutcome judge(int status) {
    if (options_.has_keeper) {
      const auto kept = take_report(text_);
      if (!kept) return {End::Unkept, 0, {}, {}};
      status = *kept;
    }
    if (WIFSIGNALED(status)) return {End::Killed, WTERMSIG(status), {}, {}};
    if (WEXITSTATUS(status) != 0 || text_.empty()) {
      return {End::Exited, WEXITSTATUS(status), {}, {}};
    }
    const End end = text_.front() == kAnswer ? End::Answered : End::Threw;
    return {end, 0, text_.substr(1), {}};
  }

  pid_t child_;
  Descriptor answer_, output_;
  ChildOptions options_;
  Clock::time_point begin_;
  std::string text_, printed_;
  std::optional<Clock::time_point> asked_to_end_;
  bool is_over_ = false;
  pid_t owner_ = ::getpid();  ///< another child must not end this one
};

Child::Child(const std::function<std::string()>& work, const ChildOptions& options) {
  Pipe answer;
  Pipe output;
  const pid_t parent = ::getpid();
  std::fflush(nullptr);  // what is in memory yet is not to be printed by the child, too
  const pid_t child = ::fork();
  if (child < 0) fail("fork");
  if (child == 0) {
    be_child(work, parent, options.has_keeper, answer.write.number(), output.write.number());
  }
  ::setpgid(child, child);  // in both processes, in whichever order
  answer.write.close();
  output.write.close();
  watch_ = std::make_unique<Watch>(child, std::move(answer.read), std::move(output.read), options);
}

Child::~Child() = default;
Child::Child(Child&&) noexcept = default;

std::optional<ChildOutcome> Child::wait(std::chrono::milliseconds patience) {
  return watch_->wait(patience);
}

void Child::await_any(std::span<const Child* const> children, std::chrono::milliseconds patience) {
  std::vector<const Watch*> watches;
  for (const Child* const child : children) watches.push_back(child->watch_.get());
  Watch::await_any(watches, std::min(patience, kGlance));
}

void Child::end_others(std::span<const Child* const> children) {
  const auto is_own = [&](pid_t process) {
    return std::ranges::any_of(children,
                               [&](const Child* child) { return child->watch_->is_of(process); });
  };
  for (bool is_one_left = true; is_one_left;) {
    std::vector<pid_t> others = children_of(::getpid()).value_or(std::vector<pid_t>{});
    std::erase_if(others, is_own);
    is_one_left = !others.empty();
    for (const pid_t other : others) reap(other);
  }
}

void adopt_orphans() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

ChildOutcome run_in_child(const std::function<std::string()>& work, const ChildOptions& options) {
  constexpr std::chrono::hours kLong{1};
  Child child(work, options);
  while (true) {
    if (std::optional<ChildOutcome> outcome = child.wait(kLong)) return std::move(*outcome);
  }
}

std::string signal_name(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  if (name != nullptr) return std::string("SIG") + name;
  const int place = signal - SIGRTMIN;  // below 0 for those that the C library keeps for itself
  return "SIGRTMIN" + (place < 0 ? std::to_string(place) : "+" + std::to_string(place));
}

}  // namespace stride::isolation
