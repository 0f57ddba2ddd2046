#include "master/base/robust_flag.h"

#include <cstring>

#include <catch2/catch.hpp>

using stride::core::RobustFlag;

TEST_CASE("a robust flag is set by its own function only") {
  RobustFlag flag;
  CHECK_FALSE(flag);
  flag.set();
  CHECK(flag);
  flag.set(false);
  CHECK_FALSE(flag);
  for (int byte = 0; byte < 256; ++byte) {
    flag.set();
    std::memset(static_cast<void*>(&flag), byte, sizeof flag);
    CHECK_FALSE(flag);
  }
}
