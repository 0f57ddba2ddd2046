// The one exception type of the master.
#ifndef STRIDE_MASTER_BASE_ERROR_H
#define STRIDE_MASTER_BASE_ERROR_H

#include <cstddef>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <stride/time.h>

namespace stride::core {

/// A position in a file that a person wrote. line 0 = the file as a whole.
struct Location {
  std::string file;
  int line = 0;
};

/// Where something went wrong; what is not known is left empty.
struct Context {
  Location where{};
  std::string unit{};      ///< the component's name
  std::string variable{};  ///< the variable's or connector's name
  std::optional<Time> time{};
};

/// Its text, what(), reads "FILE:LINE: unit 'U', variable 'V', at T s: MESSAGE", followed by the
/// hint on a line of its own. It is message_text() of that, whatever the message quotes.
class Error : public std::runtime_error {
 public:
  enum class Kind {
    Input,  ///< what the user gave is wrong: exit code 2
    Run,    ///< a unit or the simulation failed: exit code 1
  };

  Error(Kind kind, Context context, const std::string& message, const std::string& hint = "");

  Kind kind() const { return kind_; }
  const Context& context() const { return context_; }
  /// Without the context, and without the hint.
  const std::string& message() const { return message_; }
  const std::string& hint() const { return hint_; }

 private:
  Kind kind_;
  Context context_;
  std::string message_, hint_;
};

/// A unit cannot be called, because another one has failed before. Where units step at the same
/// time the other's failure is the one to report.
class ConsequentError : public Error {
 public:
  using Error::Error;
};

/// Neither is the input wrong nor has the simulation failed: the machine lacks something, such as
/// room on a disk, or other code has moved a file that is in use.
class EnvironmentError : public Error {
 public:
  EnvironmentError(Context context, const std::string& message, const std::string& hint = "")
      : Error(Kind::Run, std::move(context), message, hint) {}
};

/// Shorthands for the two kinds.
[[noreturn]] void fail_input(Context context, const std::string& message,
                             const std::string& hint = "");
[[noreturn]] void fail_run(Context context, const std::string& message,
                           const std::string& hint = "");

/// Of what the system does not let be made where the user wants it: "message: No such file". Throws
/// an EnvironmentError if it lacks something, else fails as the input does, with the hint.
[[noreturn]] void fail_output(const std::error_code& reason, Context context,
                              const std::string& message, const std::string& hint);

/// Whether this errno says that the system lacks something, such as room on a disk or numbers for
/// open files: no file that the user names instead would help.
bool is_shortage(int error);

/// Whether it is an EnvironmentError, or one that the standard library has thrown for such an errno
/// or for want of processes, threads or memory.
bool is_of_environment(const std::exception& error);

/// "FILE:LINE: unit 'U', variable 'V', at T s: ", as far as it is known.
std::string to_text(const Context& context);

/// "'a', 'b'"
std::string quoted(std::span<const std::string> names);

/// "a, b and 3 more": the first `most` ones, and one more rather than "and 1 more".
std::string abridged(std::span<const std::string> names, std::size_t most);

}  // namespace stride::core

#endif
