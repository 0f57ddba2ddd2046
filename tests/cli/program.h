// The program as a user meets it: arguments, exit code, and what it prints.
#ifndef STRIDE_TESTS_CLI_PROGRAM_H
#define STRIDE_TESTS_CLI_PROGRAM_H

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace stride::tests {

/// What a program that has ended leaves.
struct Outcome {
  int exit_code;    ///< -N if it was killed by signal N
  std::string out;  ///< what it wrote to its standard output
  std::string err;  ///< likewise, standard error
};

using Arguments = std::vector<std::string>;

/// A program that runs beside the test. It is killed with the object, unless it has been waited
/// for.
class Process {
 public:
  /// Searches `arguments[0]` in PATH. `folder` is the working folder, unless it is empty.
  Process(const Arguments& arguments, const std::filesystem::path& folder);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool is_running();
  void send(int signal) const;
  Outcome wait();

 private:
  int out_;
  int err_;
  pid_t id_;
  int status_ = 0;
  bool has_ended_ = false;
};

/// The arguments with the built `stride` before them; it finds the units of this repository and
/// those made for tests.
Arguments stride_command(Arguments arguments);

/// Runs `stride` to its end.
Outcome run_program(const Arguments& arguments, const std::filesystem::path& folder = {});

}  // namespace stride::tests

#endif
