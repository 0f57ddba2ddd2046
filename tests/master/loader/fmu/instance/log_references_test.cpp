#include "master/loader/fmu/instance/log_references.h"

#include <catch2/catch.hpp>

using namespace stride;

namespace {

std::string named(const std::string& message) {
  return importer::name_variables(message, [](char type, std::uint32_t reference) -> std::string {
    if (type == 'r' && reference == 1365) return "body.m";
    if (type == 'b' && reference == 0) return "is on";
    if (type == 's' && reference == 4294967295u) return "#r1365#";
    return "";
  });
}

}  // namespace

TEST_CASE("references to variables become their names") {
  CHECK(named("#r1365# must be larger than zero (used in IO channel ##4)") ==
        "body.m must be larger than zero (used in IO channel #4)");
  CHECK(named("#b0##r1365#") == "is onbody.m");
  CHECK(named("#s4294967295#") == "#r1365#");
}

TEST_CASE("what refers to no variable stays") {
  for (const std::string text : {"#", "#r", "#r1#", "#i1365#", "#x1365#", "#r#", "#r-1#", "#r1365",
                                 "#r 1365#", "#r4294967296#", "a # b", ""}) {
    CAPTURE(text);
    CHECK(named(text) == text);
  }
}
