// Command lines as people type them.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_REPEATED_OPTIONS_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_REPEATED_OPTIONS_H

#include <string>
#include <vector>

namespace stride::cli {

/// The words with the option written before each of its values: "--set a=1 b=2" is
/// "--set a=1 --set b=2", likewise for --swap. A word behind the first value is one if it begins
/// with a name and '=', and is no file.
std::vector<std::string> with_repeated_options(const std::vector<std::string>& words);

}  // namespace stride::cli

#endif
