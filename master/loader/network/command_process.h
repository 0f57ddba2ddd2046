// A program with pipes to its standard files.
#ifndef STRIDE_MASTER_LOADER_NETWORK_COMMAND_PROCESS_H
#define STRIDE_MASTER_LOADER_NETWORK_COMMAND_PROCESS_H

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "master/base/child_process/descriptor.h"

namespace stride::remote {

/// The program has a session of its own: it cannot ask at the terminal, and Ctrl-C is not for it.
/// It gets SIGTERM when the thread that made this object ends. No write and no read of the pipes
/// waits.
class CommandProcess {
 public:
  /// `command`: the program, searched in PATH, and its arguments. One that cannot be run ends with
  /// the code 127, and says why on its standard error. Throws std::system_error.
  explicit CommandProcess(const std::vector<std::string>& command);
  /// Ends it.
  ~CommandProcess();
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;

  isolation::Descriptor in, out, err;  ///< of the program: written, read, read

  /// Whether it has ended by itself; waits so long for that.
  bool has_ended(std::chrono::milliseconds patience = {});
  /// Closes the pipes and waits for its end; what takes too long is killed, with its session.
  void end(std::chrono::milliseconds patience);
  /// "ended with the code 255"; empty while it has not.
  std::string how_it_ended() const;
  std::optional<int> exit_code() const;

 private:
  void kill(int signal) const;

  pid_t process_ = 0;
  pid_t owner_ = 0;  ///< a fork of this process must not end it
  std::optional<int> status_;
};

}  // namespace stride::remote

#endif
