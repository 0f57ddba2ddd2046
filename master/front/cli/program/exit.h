// How the program ends.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_EXIT_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_EXIT_H

namespace stride::cli {

inline constexpr int kRunFailed = 1;
inline constexpr int kWrongInput = 2;

/// As a signal does that is not handled, so that others see that. For signal handlers, too.
[[noreturn]] void end_by(int signal) noexcept;

}  // namespace stride::cli

#endif
