// The orderly end of a process that a unit in it ends.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_CRASH_GUARD_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_CRASH_GUARD_H

#include <csignal>
#include <functional>
#include <string>

namespace stride::cli {

/// While it lives, a crash of this process (a signal such as SIGSEGV, abort(), std::terminate()),
/// exit() and signals whose default action ends a process end it in order: the lines that files
/// still hold in memory are written, the error is printed, with the unit whose function was being
/// called, and the exit code is 1; after a signal from outside the process ends by that signal.
/// From its end until that of the process the same is so, without the conclusion: a thread of a
/// unit may go on. There is one at a time, and one in a process. What it cannot see, such as
/// SIGKILL, or does not survive is left to the process that watches this one (go_on_watched()),
/// which has less to say.
///
/// Signals for which there is a handler already are left to it. SIGINT, SIGTERM, SIGHUP and SIGPIPE
/// end the process as usual.
class CrashGuard {
 public:
  /// Writes the files that describe the end, such as run.json. It is called in a fork of the
  /// process, where only the thread that crashed goes on, and which is ended if it takes more than
  /// some seconds: a unit may have damaged anything. It must not call units.
  using Conclusion = std::function<void(const std::string& error)>;

  /// Only the error is written.
  CrashGuard() : CrashGuard([](const std::string&) {}) {}
  explicit CrashGuard(Conclusion conclusion);
  ~CrashGuard();
  CrashGuard(const CrashGuard&) = delete;
  CrashGuard& operator=(const CrashGuard&) = delete;

  /// Another conclusion, for as long as it lives.
  class Scope {
   public:
    Scope(CrashGuard& guard, Conclusion conclusion);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    CrashGuard& guard_;
    Conclusion before_;
  };

 private:
  void set_conclusion(Conclusion conclusion);

  Conclusion conclusion_;
};

/// To be called when all units are freed, and again when their libraries are about to be unloaded:
/// if one of these takes longer than kLongestEnd, or a thread of a unit has the lock of a standard
/// stream for so long, that is an error which ends the process. Holds until the guard's end; does
/// nothing without one. The standard streams are put back (restore_streams()).
void limit_end();

/// Ends a guarded process as a crash does, with the text of this error: where threads of units may
/// hinder what is left to be done, which they cannot do in a fork.
[[noreturn]] void end_with(const std::string& error);

/// For handlers of other signals: ends a guarded process as a crash does, unless the signal is from
/// outside.
void end_if_own(int signal, const siginfo_t& info);

/// Calls limit_end() at its end: declared behind what holds the libraries.
struct LimitedEnd {
  ~LimitedEnd() { limit_end(); }
};

/// For a fork of the process with guards of its own, when these and its units are gone: it may end
/// as it likes.
void end_guarding();

/// What main() returns after the last CrashGuard: from here on libraries of units that are still
/// loaded call their destructors and exit functions. A crash, exit() or _exit() there is an error
/// with the exit code 1, as is an end that takes longer than kLongestEnd.
int leave_with(int code);

}  // namespace stride::cli

#endif
