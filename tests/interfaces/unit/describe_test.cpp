// A unit's descriptions of its messages, through the C entry point.
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Bytes = std::vector<fmi3Byte>;

namespace {

struct Said {
  fmi3Status status;
  std::string text;
};

Said ask(UnitInstance& unit, const std::string& variable, const Bytes& value,
         std::size_t capacity = 100) {
  std::string text(capacity, '?');
  std::size_t size = 77;
  const fmi3Status status =
      unit.fmi.DescribeMessage(unit.handle, unit.reference(variable), value.data(), value.size(),
                               text.data(), text.size(), &size);
  if (status == fmi3OK || status == fmi3Discard) text.resize(size);
  return {status, text};
}

}  // namespace

TEST_CASE("a unit gives the text of a message") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  const Said said = ask(unit, "receive.frame", {0x26, 0x27});
  CHECK(said.status == fmi3OK);
  CHECK(said.text == "2 bytes in receive.frame");
  CHECK(ask(unit, "blobs.echo", Bytes(1000, 0x30)).text == "1000 bytes in blobs.echo");
}

TEST_CASE("a unit may have no text for a message") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  const Said said = ask(unit, "receive.frame", {});
  CHECK(said.status == fmi3Discard);
  CHECK(said.text.empty());
  CHECK(unit.messages.empty());
}

TEST_CASE("the text of a message is one line, and cut between characters") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  CHECK(ask(unit, "receive.frame", {1}).text == "one, two");
  CHECK(ask(unit, "receive.frame", {2}, 7).text == "ééé");
  CHECK(ask(unit, "receive.frame", {2}, 6).text == "ééé");
  CHECK(ask(unit, "receive.frame", {2}, 1).status == fmi3Discard);
  CHECK(ask(unit, "receive.frame", {2}, 0).status == fmi3Discard);
}

TEST_CASE("an exception becomes a warning, and the unit goes on") {
  const UnitLibrary library(unit_library("types"));
  InstanceChoices choices;
  choices.logging = true;
  UnitInstance unit(library, choices);
  REQUIRE(unit.start_steps() == fmi3OK);
  CHECK(ask(unit, "receive.frame", {0}).status == fmi3Discard);
  CHECK_THAT(unit.last_message(),
             Contains("a value of 'receive.frame' cannot be described: nought"));
  CHECK(unit.step(0, 0.125) == fmi3OK);
}

TEST_CASE("only Binary variables have message texts") {
  const UnitLibrary library(unit_library("types"));
  UnitInstance unit(library);
  CHECK(ask(unit, "string", {1}).status == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("strideDescribeMessage: variable 'string' is of the "
                                           "type String, not Binary"));
  std::size_t size = 0;
  char text = 0;
  const fmi3Byte byte = 1;
  CHECK(unit.fmi.DescribeMessage(unit.handle, 12345, &byte, 1, &text, 1, &size) == fmi3Error);
  CHECK_THAT(unit.last_message(), Contains("no variable with the value reference 12345"));
}

TEST_CASE("a unit without message texts has the function, too") {
  const UnitLibrary library(unit_library("bouncing_ball"));
  CHECK(library.DescribeMessage != nullptr);
}
