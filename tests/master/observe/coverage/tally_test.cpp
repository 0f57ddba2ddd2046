#include "master/observe/coverage/tally.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

TEST_CASE("a tally keeps the first visit, and finds its bins by name") {
  const PointDefinition words = messages_of(Kind::Words, "words", {{"write"}, {"read"}});
  Tally tally(words);
  tally.visit(tally.find_or_add("read"), at(2));
  tally.visit(tally.find_or_add("read"), at(3));
  tally.visit(tally.find_or_add("erase"), at(4));
  REQUIRE(tally.bins().size() == 3);
  CHECK((tally.bins()[1].count == 2 && tally.bins()[1].first == at(2)));
  CHECK((tally.bins()[2].name == "erase" && tally.bins()[2].is_ignored));
}

TEST_CASE("a state in which a bin is twice is refused") {
  const PointDefinition words = messages_of(Kind::Words, "words");
  core::StateArchive written;
  std::vector<std::string> names{"read", "read"};
  written.values(names);
  Tally tally(words);
  core::StateArchive read(written.bytes());
  CHECK_THROWS_AS(tally.persist(read), core::BadState);
}
