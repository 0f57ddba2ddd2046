#ifndef STRIDE_MASTER_CLI_END_NOTE_H
#define STRIDE_MASTER_CLI_END_NOTE_H

#include <atomic>
#include <climits>
#include <cstddef>
#include <cstdint>

#include "master/cli/crash_error.h"
#include "master/util/fixed_text.h"

namespace stride::cli {

/// What the process notes for the one that watches it (go_on_watched()).
struct EndNote {
  static constexpr std::size_t kMostOutliving = 1;

  /// Means "yes", which no damage to the memory is likely to leave.
  static constexpr std::uint64_t kComplete = 0x5ba1'c0de'7e57'0e4d;

  /// What is to be told of the end is told; the exit code, or that signal as a negative number.
  std::atomic<std::uint64_t> is_complete{0};
  std::atomic<int> code{0};
  std::atomic<bool> is_leaving{false};  ///< the command is over

  /// If something ends the process on the way.
  std::atomic<bool> has_end{false};
  std::atomic<std::uint64_t> is_printed{0};  ///< the error
  ProcessEnd end;

  /// The files that state how the run ends, absolute; empty if there are none.
  core::FixedText<PATH_MAX> run_file{};
  core::FixedText<PATH_MAX> test_report{};
  core::FixedText<PATH_MAX> scenario{};
};

/// That of this process.
EndNote& end_note();

}  // namespace stride::cli

#endif
