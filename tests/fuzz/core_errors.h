// Refusals by the master, and files of seeds that are archives.
#ifndef STRIDE_TESTS_FUZZ_CORE_ERRORS_H
#define STRIDE_TESTS_FUZZ_CORE_ERRORS_H

#include <string>

#include "master/base/error.h"
#include "tests/fuzz/parser.h"

namespace stride::tests {

/// Calls read(). Its errors are refusals if they are mistakes in the input, in this file unless it
/// is empty.
template <class Read>
void refusing_input(const std::string& file, Read&& read) {
  try {
    read();
  } catch (const core::Error& error) {
    const std::string text = error.what();
    ensure(error.kind() == core::Error::Kind::Input, "'" + text + "' is a mistake in the input");
    ensure(file.empty() || error.context().where.file == file, "'" + text + "' names " + file);
    throw Refusal(text);
  }
}

}  // namespace stride::tests

#endif
