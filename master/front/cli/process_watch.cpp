#include "master/front/cli/process_watch.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/archive/temporary_folder.h"
#include "master/base/child_process/children.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/error.h"
#include "master/base/files/descriptor.h"
#include "master/base/files/file_identity.h"
#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/base/process/signal_state.h"
#include "master/front/cli/program/end_note.h"
#include "master/front/cli/program/exit.h"
#include "master/front/cli/program/output.h"
#include "master/front/cli/run/recorded_run.h"
#include "master/front/cli/run/test_report.h"
#include "master/loader/fmu/instance/unit_call.h"
#include "master/observe/recorders/run_json.h"
#include "master/report/results.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

/// Those that end a process, and can be sent to it [man 7 signal].
bool is_forwarded(int signal) {
  constexpr std::array kOthers{SIGKILL, SIGSTOP, SIGCHLD, SIGCONT, SIGTSTP,
                               SIGTTIN, SIGTTOU, SIGURG,  SIGWINCH};
  const bool is_hidden = 32 <= signal && signal < SIGRTMIN;  // by the C library
  return !is_hidden && std::ranges::find(kOthers, signal) == kOthers.end();
}

// What handlers, which have no arguments, have to know.
volatile pid_t watched = 0;
volatile std::sig_atomic_t last_signal = 0;
pid_t own = 0;  ///< in which the command is run

/// From the terminal, so that its whole foreground group gets it.
bool is_of_terminal(int signal, const siginfo_t& info) {
  return info.si_code == SI_KERNEL && (signal == SIGINT || signal == SIGQUIT || signal == SIGHUP);
}

void forward(int signal, siginfo_t* info, void*) {
  if (core::is_crash(signal) && info->si_code > 0) end_by(signal);  // of this process
  last_signal = signal;
  if (!is_of_terminal(signal, *info)) ::kill(watched, signal);
}

void note_child(int) {}

/// The file of the program that the process runs.
fs::path program_of(pid_t process) { return "/proc/" + std::to_string(process) + "/exe"; }

bool is_traced() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "TracerPid:") return status >> word && word != "0";
  }
  return false;
}

/// What is to be put back in the new process.
class Signals {
 public:
  Signals() {
    sigset_t blocked;
    ::sigfillset(&blocked);
    ::sigprocmask(SIG_BLOCK, &blocked, &mask_);
    struct sigaction action {};
    action.sa_handler = note_child;
    ::sigaction(SIGCHLD, &action, nullptr);
  }
  /// Not that SIGCHLD is ignored: no process could wait for those that it makes.
  void restore() const {
    ::signal(SIGCHLD, SIG_DFL);
    ::sigprocmask(SIG_SETMASK, &mask_, nullptr);
  }
  const sigset_t& mask() const { return mask_; }

 private:
  sigset_t mask_{};
};

void forward_signals() {
  struct sigaction action {};
  action.sa_sigaction = forward;
  action.sa_flags = SA_SIGINFO;
  ::sigfillset(&action.sa_mask);
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (is_forwarded(signal) && before.sa_handler != SIG_IGN) {
      ::sigaction(signal, &action, nullptr);
    }
  }
}

bool is_copy(pid_t process) {
  return core::FileIdentity::of(program_of(process).c_str()) ==
         core::FileIdentity::of(program_of(::getpid()).c_str());
}

/// Whether it may be one: of a process that is ending the program is not known.
bool may_be_copy(pid_t process) {
  return is_copy(process) || !core::FileIdentity::of(program_of(process).c_str());
}

/// Of the process that has ended, which are adopted: they hold its files, and end by themselves.
void await_copies() {
  constexpr int kLongest = 200;  // [10 ms]
  for (int i = 0; i <= kLongest; ++i) {
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    const auto children = isolation::children_of(::getpid()).value_or(std::vector<pid_t>{});
    if (std::ranges::none_of(children, may_be_copy)) return;
    constexpr timespec kPause{0, 10'000'000};
    ::nanosleep(&kPause, nullptr);
    if (i < kLongest) continue;
    for (const pid_t child : children) {
      if (is_copy(child)) ::kill(child, SIGKILL);
    }
  }
}

class Watch {
 public:
  /// `image` can be read when the process has ended, or another program has replaced it.
  Watch(core::Descriptor image, const Signals& signals)
      : image_(std::move(image)), signals_(signals) {}

  [[noreturn]] void run();

 private:
  void complete_records() const;
  void wait();
  void look_at_program();
  void end_watched(const ProcessEnd& end);
  ProcessEnd end() const;
  bool is_ended_from_outside() const;
  bool is_in_run() const;
  void report(const core::Error& error) const;

  core::Descriptor image_;
  const Signals& signals_;
  const EndNote& note_ = end_note();
  int status_ = 0;
  std::optional<ProcessEnd> own_end_;  ///< by which this one has ended the other one
};

void Watch::run() {
  wait();
  const int code = WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  const bool is_told = note_.is_whole && note_.is_complete && note_.code == code && !own_end_;
  if (is_told && code >= 0) {
    if (code != 0) complete_records();
    ::_exit(code);
  }
  core::OutputFile::rescue_left();
  const bool is_ours = !is_ended_from_outside();
  if (!is_told) {
    const UnitWork work{.calls = importer::left_calls(note_.has_end ? note_.end.thread : nullptr),
                        .library = importer::left_library_work(),
                        .is_leaving = bool(note_.is_leaving),
                        .is_overwritten = !note_.is_whole};
    const core::Error error = error_of(end(), work);
    if (is_ours && !note_.is_printed) print_error(error.what());
    report(error);
    await_copies();
    archive::TemporaryFolder::sweep_abandoned();
  }
  if (is_ours) ::_exit(kRunFailed);
  ::prctl(PR_SET_DUMPABLE, 0);  // there is an image of the other process's memory, if any
  end_by(WTERMSIG(status_));
}

/// What a process that has told its error could not write, such as one that has lost its rights.
void Watch::complete_records() const {
  const std::string error(note_.error.view());
  if (!note_.is_printed && !error.empty()) print_error(error);
  if (is_in_run()) {
    report(
        {core::Error::Kind::Run,
         {},
         error.empty() ? "the run has failed, and could not write here for what reason" : error});
    std::error_code none;  // else it stays as it is
    if (is_in_run()) fs::remove(fs::path(run_files().run_file.view()), none);
  }
  archive::TemporaryFolder::sweep_abandoned();
}

/// The process itself waits less long for its end, and can say more about it.
void Watch::wait() {
  constexpr timespec kSecond{1, 0};
  unsigned leaving = 0;  // [s]
  while (::waitpid(watched, &status_, WNOHANG) != watched || WIFSTOPPED(status_)) {
    if (WIFSTOPPED(status_)) isolation::let_go(watched, std::exchange(status_, 0));
    pollfd file{image_.number(), POLLIN, 0};
    const int count = ::ppoll(&file, 1, &kSecond, &signals_.mask());
    if (count > 0) look_at_program();
    if (count == 0 && note_.is_leaving && ++leaving > kLongestEnd + 5) {
      end_watched({.kind = ProcessEnd::Kind::TimeOut});
    }
  }
}

/// Some code may have closed the file, too.
void Watch::look_at_program() {
  image_ = core::Descriptor();
  if (may_be_copy(watched)) return;
  ProcessEnd end{.kind = ProcessEnd::Kind::Program};
  std::error_code none;
  end.text.set(fs::read_symlink(program_of(watched), none).native());
  end_watched(end);
}

void Watch::end_watched(const ProcessEnd& end) {
  own_end_ = end;
  ::kill(watched, SIGKILL);
}

ProcessEnd Watch::end() const {
  if (own_end_) return *own_end_;
  if (note_.has_end) return note_.end;
  if (!WIFSIGNALED(status_)) {
    return {.kind = ProcessEnd::Kind::ExitCode, .number = WEXITSTATUS(status_)};
  }
  return {.number = WTERMSIG(status_),
          .origin = is_ended_from_outside() ? SignalOrigin::Outside : SignalOrigin::Call};
}

bool Watch::is_ended_from_outside() const {
  if (own_end_ || !WIFSIGNALED(status_)) return false;
  const int signal = WTERMSIG(status_);
  const bool is_output_gone = signal == SIGPIPE && importer::left_calls(nullptr).empty();
  return is_output_gone || signal == last_signal || (note_.is_complete && note_.code == -signal);
}

/// Of a file that the run has made, if it has: other code may have put something else there.
bool is_there(const fs::path& file) {
  if (file.empty()) return false;
  if (core::is_file(file)) return true;
  core::fail_run({.where = {file.string(), 0}},
                 "other code has removed or replaced this file, so it does not contain the error");
}

/// It has begun, and was not over.
bool Watch::is_in_run() const {
  try {
    const fs::path run_file(run_files().run_file.view());
    return core::is_file(run_file) && recorders::is_running(run_file);
  } catch (const std::exception&) {  // it cannot be read
    return false;
  }
}

void Watch::report(const core::Error& error) const {
  const fs::path run_file(run_files().run_file.view());
  if (is_ended_from_outside() && !run_file.empty() && !is_in_run()) return;
  warn_of_failure([&] {
    if (!is_there(run_file)) return;
    recorders::ResultFiles files = report::result_files(run_file.parent_path());
    files.statistics = run_file.filename();
    results::add_error({run_file.parent_path(), files}, error.what(), error.context().time);
  });
  const fs::path test_report(run_files().test_report.view());
  warn_of_failure([&] {
    if (!is_there(test_report)) return;
    TestReport(test_report, fs::path(run_files().scenario.view())).write(error.what());
  });
}

/// The last of the exit functions: the code with which one before it has called exit() does not
/// count.
void complete_note(int code, void*) {
  EndNote& note = end_note();
  if (!note.is_leaving || own != ::getpid()) return;
  note.is_complete.set();
  if (code == note.code) return;
  std::fflush(nullptr);
  ::_exit(note.code);
}

/// In memory that the processes have in common.
void share_notes() {
  share_end_note();
  core::OutputFile::share();
  importer::share_calls();
}

/// Returns in the process in which the command is run.
void fork_to_watch() {
  const pid_t self = ::getpid();
  const Signals signals;
  std::array<int, 2> image{};
  const bool has_pipe = ::pipe2(image.data(), O_CLOEXEC) == 0;
  const pid_t process = has_pipe ? ::fork() : -1;
  if (process <= 0) signals.restore();
  if (process < 0) {
    spdlog::warn("no process can be made that would tell of the end of this one: {}",
                 std::generic_category().message(errno));
  } else if (process == 0) {
    isolation::end_with(self);
    ::close(image[0]);
  } else {
    ::close(image[1]);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    watched = process;
    forward_signals();
    Watch(core::Descriptor(image[0]), signals).run();
  }
}

}  // namespace

void go_on_watched() {
  share_notes();
  if (!is_traced()) fork_to_watch();
  own = ::getpid();
  ::on_exit(complete_note, nullptr);
}

}  // namespace stride::cli
