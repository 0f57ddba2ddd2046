#include "master/base/files/file_uri.h"

#include <catch2/catch.hpp>

using namespace stride::core;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

TEST_CASE("a path within a URI is escaped") {
  CHECK(uri_path("resources/a b#%ä.fmu") == "resources/a%20b%23%25%C3%A4.fmu");
  CHECK(uri_path("plain-1_2~3.ssv") == "plain-1_2~3.ssv");
}

TEST_CASE("a file's URI has the scheme file, and is absolute and escaped") {
  CHECK(file_uri("/tmp/unit/resources") == "file:///tmp/unit/resources");
  CHECK(file_uri("/tmp/x/../unit/resources") == "file:///tmp/unit/resources");
  CHECK(file_uri("/a b/50%/ü#?/-._~") == "file:///a%20b/50%25/%C3%BC%23%3F/-._~");
  CHECK_THAT(file_uri("resources"), StartsWith("file:///") && EndsWith("/resources"));
}
