#ifndef STRIDE_TESTS_CLI_LANDLOCK_H
#define STRIDE_TESTS_CLI_LANDLOCK_H

#include <cstdlib>
#include <exception>

#include <catch2/catch.hpp>

#include "master/base/child_process/landlock.h"

namespace stride::tests {

/// Whether a test cannot run on this kernel, which is a failure in CI.
inline bool lacks_landlock() {
  try {
    isolation::landlock_version();
    return false;
  } catch (const std::exception& error) {
    WARN("SKIPPED: " << error.what());
    REQUIRE(std::getenv("CI") == nullptr);
    return true;
  }
}

}  // namespace stride::tests

#endif
