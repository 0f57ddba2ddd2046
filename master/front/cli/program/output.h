// What is printed: texts of units, files and scenarios cannot control the terminal.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_OUTPUT_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_OUTPUT_H

#include <cstdio>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace stride::cli {

/// Writes core::terminal_text() of it. Returns whether the stream has taken it.
bool put(std::FILE* stream, std::string_view text);

/// To the standard output.
template <class... Values>
void print_text(fmt::format_string<Values...> format, Values&&... values) {
  put(stdout, fmt::format(format, std::forward<Values>(values)...));
}

/// What an error begins with.
inline constexpr std::string_view kErrorMark = "stride: error: ";

/// kErrorMark and the text, with core::message_text() of the text, to where the standard error
/// stream was at the beginning, also of a process whose streams are damaged. Returns whether it
/// could be written: code of a unit may have put another file there, which stays as it is.
bool print_error(std::string_view text);
/// The last error in what a process has printed, which ends with it; nothing if there is none.
std::optional<std::string> last_error_in(const std::string& printed);

/// Its text; for exceptions of the standard library, whose own text is for programmers, another
/// one.
std::string in_words(const std::exception& error);

/// For work whose failure must not hide how the run ended.
template <class Work>
void warn_of_failure(Work&& work) {
  try {
    work();
  } catch (const std::exception& failure) {
    spdlog::warn("{}", in_words(failure));
  }
}

/// core::message_text() of each.
void print_warnings(std::span<const std::string> warnings);

/// To be called before anything is printed. The log goes to the standard error stream, likewise.
void set_up_output();

/// Puts the standard streams of C and C++ back, where code of a unit has replaced them or given
/// them a buffer, which may be in a library that is about to be unloaded. What the buffer holds is
/// written.
void restore_streams();

/// Whether another thread has the lock of a standard stream (flockfile), so that this one could
/// print nothing. For signal handlers, too.
bool is_output_locked();

/// From here on locks of the standard streams do not count: for a fork, which has none of the
/// threads that may have had them.
void ignore_output_locks();

}  // namespace stride::cli

#endif
