// The error of a process that something in it ends, in words.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_CRASH_ERROR_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_CRASH_ERROR_H

#include <optional>
#include <vector>

#include "master/base/error.h"
#include "master/base/text/fixed_text.h"
#include "master/front/cli/program/signal_origin.h"
#include "master/loader/fmu/instance/unit_call.h"
#include "master/loader/fmu/library/shared_library.h"

namespace stride::cli {

/// How long the process may take to end when all units are freed [s].
inline constexpr unsigned kLongestEnd = 10;

/// How a process ends.
struct ProcessEnd {
  enum class Kind { Signal, ExitCall, ExitCode, Program, TimeOut, Error };
  Kind kind = Kind::Signal;
  int number = 0;  ///< of the signal, or the exit code
  SignalOrigin origin = SignalOrigin::Call;
  /// Which ends it: its address of importer::this_thread; null if that is not known.
  const char* thread = nullptr;
  /// Of kind Error, that of the one that was thrown; of kind Program, what replaces the process.
  core::FixedText<4096> text{};
};

/// What units were doing then.
struct UnitWork {
  std::vector<importer::UnitCall> calls;  ///< those that have not returned
  importer::LibraryWork library;
  std::optional<importer::UnitCall> last{};  ///< of the thread, and returned
  std::vector<core::Context> users{};  ///< of the libraries that are loaded, as far as is known
  bool is_leaving = false;             ///< the command is over
  bool is_overwritten = false;         ///< this, so that it says nothing
  bool has_locked_output = false;      ///< another thread has the lock of a standard stream
};

/// If the thread that ends the process makes none of the calls, a unit has started it.
core::Error error_of(const ProcessEnd& end, const UnitWork& work);

}  // namespace stride::cli

#endif
