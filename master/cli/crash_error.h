// The error of a process that a unit in it ends, in words.
#ifndef STRIDE_MASTER_CLI_CRASH_ERROR_H
#define STRIDE_MASTER_CLI_CRASH_ERROR_H

#include <span>
#include <string_view>

#include "master/cli/signal_origin.h"
#include "master/importer/fmu_instance.h"
#include "master/util/error.h"

namespace stride::cli {

/// How long the process may take to end when all units are freed [s].
inline constexpr unsigned kLongestEnd = 10;

/// How a process ends.
struct ProcessEnd {
  enum class Kind { Signal, Call, TimeOut, Error };
  Kind kind = Kind::Signal;
  int signal = 0;                  ///< of kind Signal
  const char* function = nullptr;  ///< that was called, such as exit: of kind Call
  const char* error = nullptr;     ///< the text of one that was thrown: of kind Error
  SignalOrigin origin = SignalOrigin::Call;
};

/// "signal 11 (SIGSEGV) ends stride". Allocates nothing; the result is in `text`.
std::string_view describe_end(const ProcessEnd& end, std::span<char> text);

/// `calls` are those of units that have not returned. If this thread makes none of them, a unit has
/// started it. `is_leaving`: the command is over.
core::Error error_of(const ProcessEnd& end, std::span<const importer::UnitCall> calls,
                     bool is_leaving);

/// In short, where nothing can be allocated; the result is in `text`.
std::string_view describe_briefly(const ProcessEnd& end, std::span<const importer::UnitCall> calls,
                                  std::span<char> text);

}  // namespace stride::cli

#endif
