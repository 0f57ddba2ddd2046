// Where a unit runs: <stride:Host at="…"/>.
#ifndef STRIDE_MASTER_LOADER_NETWORK_PLACE_H
#define STRIDE_MASTER_LOADER_NETWORK_PLACE_H

#include <string>
#include <string_view>
#include <vector>

namespace stride::remote {

/// A way to start `stride serve` elsewhere.
struct Place {
  std::string text;                  ///< as it was given
  std::string machine;               ///< "user@machine", or the command, for messages
  std::vector<std::string> command;  ///< the program and its arguments

  bool operator==(const Place&) const = default;
};

/// "ssh://[user@]machine[:port]": OpenSSH's client, with what its user has configured; it asks for
/// nothing. There, `program serve` is run, by the user's shell.
/// "exec:COMMAND": COMMAND, run by /bin/sh here; its standard input and output have to be those of
/// a `stride serve`, wherever that is. Then `program` has to be empty.
///
/// Throws std::invalid_argument whose text contains what was expected.
Place parse_place(std::string_view text, const std::string& program = "");

}  // namespace stride::remote

#endif
