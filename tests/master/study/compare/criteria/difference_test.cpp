#include "master/study/compare/criteria/difference.h"

#include <set>
#include <string>

#include <catch2/catch.hpp>

using namespace stride::compare;

TEST_CASE("each kind of difference has a name of its own") {
  std::set<std::string> names;
  for (const Kind kind : {Kind::Message, Kind::Event, Kind::Signal, Kind::Coverage, Kind::Check,
                          Kind::Verdict, Kind::Outcome, Kind::File}) {
    names.insert(name(kind));
  }
  CHECK(names == std::set<std::string>{"check", "coverage", "event", "file", "message", "outcome",
                                       "signal", "verdict"});
}
