#include "master/base/text/composed_letters.h"

#include <catch2/catch.hpp>

using stride::core::composed;

TEST_CASE("a letter and its mark become one character") {
  CHECK(composed("Gro\u0308\u00DFe.fmu") == "Gr\u00F6\u00DFe.fmu");
  CHECK(composed("c\u030C\u0301 S\u0326 a\u030A") == "\u010D\u0301 \u0218 \u00E5");
  CHECK(composed("\u00E9 plain") == "\u00E9 plain");
}

TEST_CASE("a mark without such a letter stays") {
  CHECK(composed("\u0308x\u0308 \xFF") == "\u0308x\u0308 \xFF");
  CHECK(composed("").empty());
}
