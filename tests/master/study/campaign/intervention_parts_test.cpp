#include "master/study/campaign/intervention_parts.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride;
using namespace stride::campaign;
using scenario::InterventionDeclaration;
using scenario::parse_corrupt;
using scenario::parse_delay;
using scenario::parse_drop;
using scenario::parse_force;
using scenario::parse_set_at;

namespace {

/// What the option makes of an intervention that was changed in this part.
std::string changed(InterventionDeclaration declared, const std::string& part,
                    const std::string& text) {
  set_part(declared, part, text);
  const auto [option, value] = option_of(declared);
  return option + " " + value;
}

}  // namespace

TEST_CASE("each part of an intervention can be set, and the option says so") {
  CHECK(changed(parse_set_at("a.x=1@2"), "value", "3") == "--set-at a.x=3@2");
  CHECK(changed(parse_set_at("a.x=1@2"), "at", "0.5") == "--set-at a.x=1@0.5");
  CHECK(changed(parse_force("a.x=1@2..3"), "from", "0.25") == "--force a.x=1@0.25..3");
  CHECK(changed(parse_force("a.x=1@2.."), "until", "4") == "--force a.x=1@2..4");
  CHECK(changed(parse_force("a.x@2..3"), "until", "4") == "--force a.x@2..4");
  CHECK(changed(parse_drop("a.x@2.."), "from", "1") == "--drop a.x@1..");
  CHECK(changed(parse_delay("a.x=0.1@2.."), "time", "0.2") == "--delay a.x=0.2@2..");
  CHECK(changed(parse_corrupt("a.x=3,4@2.."), "bits", "7") == "--corrupt a.x=7,4,1@2..");
  CHECK(changed(parse_corrupt("a.x=3,4@2.."), "header", "0") == "--corrupt a.x=3,0,1@2..");
  CHECK(changed(parse_corrupt("a.x=3,4@2.."), "seed", "9") == "--corrupt a.x=3,4,9@2..");
}

TEST_CASE("an option reads back as what it was made of") {
  for (const char* text : {"a.x=1@2..3", "a.x@0.5.."}) {
    CHECK(option_of(parse_force(text)).second == text);
  }
  const auto corrupt = parse_corrupt(option_of(parse_corrupt("a.x=3,4,5@1..2")).second);
  CHECK(corrupt.value == "3,4");
  CHECK(corrupt.seed == 5);
}

TEST_CASE("an intervention has the parts of its kind") {
  using Kind = core::Intervention::Kind;
  using Parts = std::vector<std::string>;
  CHECK(parts_of(Kind::Set) == Parts{"value", "at", "enabled"});
  CHECK(parts_of(Kind::Hold) == Parts{"from", "until", "enabled"});
  CHECK(parts_of(Kind::Drop) == Parts{"from", "until", "enabled"});
  CHECK(parts_of(Kind::Delay) == Parts{"time", "from", "until", "enabled"});
  CHECK(parts_of(Kind::Corrupt).size() == 6);
}

TEST_CASE("texts that are no instants and no seeds are refused") {
  CHECK_THAT(tests::error_of([] { changed(parse_drop("a.x@2.."), "from", "soon"); }),
             Catch::Contains("'soon' is not a number"));
  CHECK_THAT(tests::error_of([] { changed(parse_corrupt("a.x@2.."), "seed", "-1"); }),
             Catch::Contains("'-1' is not a seed"));
}
