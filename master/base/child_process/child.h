// Work in a process of its own: what goes wrong there, goes wrong there only.
#ifndef STRIDE_MASTER_BASE_CHILD_PROCESS_CHILD_H
#define STRIDE_MASTER_BASE_CHILD_PROCESS_CHILD_H

#include <chrono>
#include <csignal>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace stride::isolation {

/// How a child ended.
struct ChildOutcome {
  enum class End {
    Answered,     ///< `text` is what the work returned
    Threw,        ///< `text` is the message of the exception that left it
    Exited,       ///< something in it ended the process; `code` is the exit code
    Killed,       ///< by the signal `code`
    Unkept,       ///< its keeper was killed or limited, by the child itself or by somebody else
    TimedOut,     ///< it was killed, because its time was over
    Interrupted,  ///< likewise, because the user wanted so
  };
  End end = End::Answered;
  int code = 0;
  std::string text;
  std::string printed;  ///< the last 4 KiB that it wrote to its standard output and error
};

struct ChildOptions {
  std::optional<std::chrono::milliseconds> limit{};  ///< nothing = it may run for ever
  /// Looked at while the child runs; a signal handler sets it to end the child.
  const volatile std::sig_atomic_t* interrupted = nullptr;
  /// So long it has then, behind a SIGTERM, to end by itself.
  std::chrono::milliseconds grace{};
  /// There is a process between this one and the work, whose parent it is: what the work does to
  /// its parent does not reach this process, and no process of its own outlives it, a daemon
  /// neither; if the keeper itself was killed, end_others() ends
  /// them in a process that has called adopt_orphans(). Then there is no grace.
  bool has_keeper = false;
};

/// Work in a fork of this process, which goes on beside it. The child has its own process group,
/// which is killed as a whole when the child has ended, and it is killed when the thread that made
/// this object ends; nothing of it stays. Its standard input is empty, it leaves no core dump, and
/// no destructor of its runs after the work. It may itself have children.
class Child {
 public:
  /// Throws std::system_error if there can be no child.
  explicit Child(const std::function<std::string()>& work, const ChildOptions& options = {});
  /// Kills the child, unless its outcome is known.
  ~Child();
  Child(Child&&) noexcept;
  Child& operator=(Child&&) = delete;

  /// Its outcome, once it has ended; nothing if it goes on for longer than the patience.
  std::optional<ChildOutcome> wait(std::chrono::milliseconds patience);

  /// Until one of them has printed or ended, or the patience is over: what to do before wait() is
  /// asked, without patience, whether each of them has ended.
  static void await_any(std::span<const Child* const> children, std::chrono::milliseconds patience);

  /// Ends all children of this process but these: those that it has adopted.
  static void end_others(std::span<const Child* const> children);

 private:
  class Watch;
  std::unique_ptr<Watch> watch_;
};

/// Runs the work in a Child and waits for its end.
ChildOutcome run_in_child(const std::function<std::string()>& work,
                          const ChildOptions& options = {});

/// From here on this process adopts what loses its parent below it: see Child::end_others().
void adopt_orphans();

/// "SIGSEGV"
std::string signal_name(int signal);

}  // namespace stride::isolation

#endif
