// What the process of a command notes for the one that watches it.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_END_NOTE_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_END_NOTE_H

#include <atomic>
#include <climits>
#include <cstddef>
#include <filesystem>

#include "master/base/robust_flag.h"
#include "master/base/text/fixed_text.h"
#include "master/front/cli/program/crash_error.h"

namespace stride::cli {

/// How the process ends.
struct EndNote {
  static constexpr std::size_t kMostOutliving = 1;

  EndNote() { is_whole.set(); }

  core::RobustFlag is_whole;  ///< not so if other code has overwritten it
  /// What is to be told of the end is told; the exit code, or that signal as a negative number.
  core::RobustFlag is_complete;
  std::atomic<int> code{0};
  core::RobustFlag is_leaving;    ///< the command is over
  core::FixedText<4096> error{};  ///< that it ends with, if any
  core::RobustFlag is_printed;    ///< the error, where the program's own were to be

  /// If something ends the process on the way.
  core::RobustFlag has_end;
  ProcessEnd end;
};

/// The files that state how a run ends, absolute; empty if there are none.
struct RunFiles {
  core::FixedText<PATH_MAX> run_file;
  core::FixedText<PATH_MAX> test_report;
  core::FixedText<PATH_MAX> scenario;  ///< which the test report is of
};

/// In memory that processes have in common which are forked from here on.
void share_end_note();

/// That of this process.
EndNote& end_note();

/// Otherwise than by these functions it cannot be written: a unit that tries crashes.
const RunFiles& run_files();
void note_run_file(const std::filesystem::path& file);
void note_test_report(const std::filesystem::path& file, const std::filesystem::path& scenario);

}  // namespace stride::cli

#endif
