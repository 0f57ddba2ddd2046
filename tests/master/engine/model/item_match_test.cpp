#include "master/engine/model/item_match.h"

#include <catch2/catch.hpp>

using namespace stride::core;

TEST_CASE("enumerations with the same items, or more of them, match as they are") {
  const EnumerationItems lamp{{"off", 0}, {"on", 1}};
  for (const EnumerationItems& other :
       {lamp, EnumerationItems{{"OFF", 0}, {"On", 1}, {"broken", 2}}, EnumerationItems{}}) {
    const ItemMatch match = match_items(lamp, other);
    CHECK(match.by_name.empty());
    CHECK(match.renamed.empty());
    CHECK(match.contradictions.empty());
  }
}

TEST_CASE("items match by their names if the other enumeration has all of them") {
  const ItemMatch match = match_items({{"off", 1}, {"on", 2}}, {{"on", 0}, {"off", 1}});
  CHECK(match.by_name == NumberMap{{1, 1}, {2, 0}});
  CHECK(match.contradictions.empty());
}

TEST_CASE("items that match by their numbers alone are listed") {
  const ItemMatch match = match_items({{"off", 0}, {"idle", 2}}, {{"off", 0}, {"standby", 2}});
  CHECK(match.by_name.empty());
  CHECK(match.renamed == std::vector<std::string>{"'idle' (2) becomes 'standby'"});
}

TEST_CASE("names and numbers that say different things are a contradiction") {
  const ItemMatch match = match_items({{"on", 1}, {"idle", 2}}, {{"on", 2}, {"off", 1}});
  CHECK(match.by_name.empty());
  CHECK(match.contradictions == std::vector<std::string>{"'on' is 1 and 2"});
  const ItemMatch one_number = match_items({{"on", 1}, {"an", 1}}, {{"on", 2}, {"an", 3}});
  CHECK(one_number.by_name.empty());
  CHECK_FALSE(one_number.contradictions.empty());
}
