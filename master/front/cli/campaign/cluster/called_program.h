// Another program, and what it prints.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_CALLED_PROGRAM_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_CLUSTER_CALLED_PROGRAM_H

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "master/base/files/descriptor.h"

namespace stride::cli {

/// A program that runs beside this one, without input. It is not ended with this object, which
/// waits for its end.
class CalledProgram {
 public:
  /// Searches `words[0]` in PATH. Throws std::system_error if it cannot be started: ENOENT where
  /// there is none.
  explicit CalledProgram(std::vector<std::string> words);
  ~CalledProgram();
  CalledProgram(const CalledProgram&) = delete;
  CalledProgram& operator=(const CalledProgram&) = delete;

  /// The next line that it prints, without its end; nothing when there will be none.
  std::optional<std::string> read_line();
  /// Waits for its end and returns its exit code, or 128 and the number of the signal.
  int wait();
  /// What it has printed as errors; once it has ended.
  const std::string& errors() const { return errors_; }

 private:
  core::Descriptor out_, errors_file_;
  pid_t process_ = -1;
  std::string read_;  ///< and not yet asked for
  std::string errors_;
};

/// What a program has printed. `has_failed`: its exit code is not 0.
struct ProgramOutput {
  std::vector<std::string> lines;
  std::string errors;
  bool has_failed = false;
};
/// Runs it to its end. Throws likewise.
ProgramOutput output_of(std::vector<std::string> words);

}  // namespace stride::cli

#endif
