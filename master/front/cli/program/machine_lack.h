// What a process needs of the machine, whatever it does.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_MACHINE_LACK_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_MACHINE_LACK_H

#include <optional>
#include <string>

namespace stride::cli {

struct MachineLack {
  std::string what;
  std::string hint;  ///< what to do about it
};

/// Which of these the machine, or a limit of this user, does not give: as many open files as Linux
/// gives a process where nobody has said otherwise, another process, and some threads in it.
std::optional<MachineLack> find_machine_lack();

}  // namespace stride::cli

#endif
