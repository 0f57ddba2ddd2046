#include "master/observe/recorders/signal_text.h"

#include <catch2/catch.hpp>

using namespace stride::recorders;

TEST_CASE("Fields are quoted where their text demands it") {
  CHECK(csv_field("plain [m]") == "plain [m]");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("a \"b\"") == "\"a \"\"b\"\"\"");
  CHECK(csv_field("a\nb") == "\"a\nb\"");
}

TEST_CASE("A field is UTF-8, whatever its text is") {
  CHECK(csv_field("caf\xe9") == "caf\uFFFD");
  CHECK(csv_field("\xff,\"") == "\"\uFFFD,\"\"\"");
  CHECK(csv_field("caf\u00e9") == "caf\u00e9");
}
