// Lines to and from a program, within limits.
#ifndef STRIDE_UNITS_PROCESS_PROGRAM_LINES_H
#define STRIDE_UNITS_PROCESS_PROGRAM_LINES_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "units/process/child.h"

namespace process {

struct Limits {
  std::chrono::milliseconds silence{60'000};  ///< the longest time without a line; 0: no limit
  std::uint64_t answer = std::uint64_t{256}
                         << 20;  ///< [byte] what it may write until it has answered
};

/// A program that has been started, and the lines on its pipes. All functions throw
/// std::runtime_error that names the program, contains what was expected, and quotes what it wrote.
class ProgramLines {
 public:
  /// Receives each line that the program writes to its standard error.
  using Listener = std::function<void(const std::string& line)>;

  /// `command` and `variables` are those of Child.
  ProgramLines(const std::vector<std::string>& command, const Limits& limits, Listener listener,
               const std::vector<std::string>& variables = {});

  /// What send() will write: whole lines are appended here.
  std::string& commands() { return commands_; }
  /// Writes the commands, and begins to count the answer. `awaited` names for errors what the
  /// program is to do: "start".
  void send(std::string_view awaited);
  /// The next line that the program writes, without its line feed; blank ones are left out. Stays
  /// until the next call.
  std::string_view next_line();
  /// An error in the line that next_line() gave last: names its number, and quotes it.
  [[noreturn]] void fail_line(const std::string& message) const;
  /// Any other; with the last lines of its standard error.
  [[noreturn]] void fail(const std::string& message) const;

  /// Closes the program's standard input, and waits for its end. Throws if it does not end
  /// within the limit of its silence.
  void finish();
  /// Behind finish(): the next of the lines that the program has written on its way to the end;
  /// none where there is no more. Stays until the next call.
  std::optional<std::string_view> next_last_line();
  /// Behind finish(): throws if the program has ended with another exit code than 0.
  void require_success() const;

 private:
  using Clock = std::chrono::steady_clock;

  bool write_some();
  void exchange();
  bool take_line(std::string_view& line);
  void make_room();
  void read_output();
  ssize_t read_some();
  void read_rest();
  bool read_error();
  bool wait_for_end(std::chrono::milliseconds limit);
  void hear(std::string_view text);
  void note_error(std::string line);
  void count(std::size_t bytes);
  int poll_timeout() const;
  [[noreturn]] void fail_at_end();

  std::string name_;
  Limits limits_;
  Listener listener_;
  std::unique_ptr<Child> child_;

  std::string commands_;
  std::size_t written_ = 0;
  std::string awaited_;

  std::vector<char> buffer_;
  std::size_t begin_ = 0;  ///< of what has been read and not yet given out
  std::size_t seen_ = 0;   ///< up to here there is no line feed
  std::size_t end_ = 0;
  std::string_view line_;
  std::uint64_t line_number_ = 0;
  std::uint64_t answered_ = 0;  ///< [byte] of this answer
  Clock::time_point heard_ = Clock::now();

  std::string error_line_;
  std::deque<std::string> last_errors_;
};

}  // namespace process

#endif
