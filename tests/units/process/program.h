#ifndef STRIDE_TESTS_UNITS_PROCESS_PROGRAM_H
#define STRIDE_TESTS_UNITS_PROCESS_PROGRAM_H

#include <string>
#include <vector>

namespace stride::tests {

/// A program of the shell.
inline std::vector<std::string> shell(const std::string& script) {
  return {"/bin/sh", "-c", script};
}

/// Waits for the command of this name, and prints a text.
inline std::string answer(const std::string& command, const std::string& text) {
  return "while read -r line; do case $line in '<" + command +
         "'*) break;; esac; done; printf '%s\\n' '" + text + "'; ";
}

}  // namespace stride::tests

#endif
