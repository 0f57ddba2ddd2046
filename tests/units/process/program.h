#ifndef STRIDE_TESTS_UNITS_PROCESS_PROGRAM_H
#define STRIDE_TESTS_UNITS_PROCESS_PROGRAM_H

#include <filesystem>
#include <string>
#include <vector>

#include "tests/build.h"

namespace stride::tests {

/// The cistern in C++, beside the file that declares it.
inline std::filesystem::path cistern_program() {
  return build_folder() / "tests/test_units/cistern/cistern";
}

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
