#include "master/base/text/shell_word.h"

#include <catch2/catch.hpp>

using stride::core::shell_word;

TEST_CASE("a word for a shell is in quotation marks where it needs them") {
  CHECK(shell_word("a.y=0.5") == "a.y=0.5");
  CHECK(shell_word("/units/two-filters_1.ssd") == "/units/two-filters_1.ssd");
  CHECK(shell_word("") == "''");
  CHECK(shell_word("x[1]=$HOME") == "'x[1]=$HOME'");
  CHECK(shell_word("an engineer's") == "'an engineer'\\''s'");
}
