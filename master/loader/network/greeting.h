// The first line that each side sends, in plain text, so that versions of any kind understand it.
#ifndef STRIDE_MASTER_LOADER_NETWORK_GREETING_H
#define STRIDE_MASTER_LOADER_NETWORK_GREETING_H

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace stride::remote {

/// Of the messages (message.h). Raised with each change of them, and of the table of calls
/// (wire/calls.h).
inline constexpr unsigned kProtocol = 3;

enum class Side { Server, Master };

struct Greeting {
  unsigned protocol = kProtocol;
  std::string build;  ///< the version of stride: letters, digits, '.', '-', '+', '~'
};

/// The version of stride that this is.
Greeting own_greeting();

/// "\x01STRIDE-SERVE protocol 1, build 1.2.0\n"
std::string greeting_line(Side side, const Greeting& greeting);

/// What has arrived cannot be the beginning of a session. what() says why.
class BadGreeting : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Finds the peer's greeting in what arrives, and what was printed before it: the banner of a
/// login, or what a file such as .bashrc prints.
class GreetingScanner {
 public:
  static constexpr std::size_t kMostNoise = std::size_t{1} << 16;
  static constexpr std::size_t kLongest = 200;  ///< of a greeting

  explicit GreetingScanner(Side peer);

  /// Takes bytes as they come. Returns the greeting once it is complete; nothing may be given then.
  /// Throws BadGreeting for more noise than there may be, and for a greeting that is none.
  std::optional<Greeting> take(std::string_view bytes);
  /// What came before the greeting, or has come so far.
  std::string_view noise() const { return std::string_view(bytes_).substr(0, begin_); }
  /// What has come behind the greeting.
  std::string_view rest() const { return std::string_view(bytes_).substr(end_); }

 private:
  std::string mark_;
  std::string bytes_;
  std::size_t begin_ = 0;  ///< of the greeting, or of where it may begin
  std::size_t end_ = 0;
};

}  // namespace stride::remote

#endif
