#include "master/base/text/counted.h"

#include <catch2/catch.hpp>

using stride::core::counted;

TEST_CASE("one of a kind is in the singular, and none is not") {
  CHECK(counted(0, "case") == "0 cases");
  CHECK(counted(1, "case") == "1 case");
  CHECK(counted(2u, "case") == "2 cases");
  CHECK(counted(1, "box", "boxes") == "1 box");
  CHECK(counted(2, "box", "boxes") == "2 boxes");
}
