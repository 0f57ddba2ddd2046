#include "master/study/compare/streams.h"

#include "tests/master/study/compare/support.h"

using namespace stride;
using namespace stride::compare;
using Catch::Contains;

namespace {

const std::string kHead = "time,index,component,variable,direction,payload,content\n";
const std::string kPing = "1,2,a,y,sent,00ff,ping\n";
const std::string kReceived = "1,2,b,u,received,00ff,ping\n";
const std::string kPong = "2,0,b,y,sent,01,pong\n";

Streams messages(const std::string& rows) {
  const TemporaryFolder folder;
  return read_messages(folder.write("events.csv", kHead + rows));
}

Differences differences_between(const std::string& a, const std::string& b,
                                std::optional<Duration> time_tolerance = {},
                                const Selection& selection = Selection({}, {})) {
  return compare_streams(messages(a), messages(b), time_tolerance, selection, "events.csv");
}

}  // namespace

TEST_CASE("the same messages are equal") {
  CHECK(differences_between(kPing + kReceived + kPong, kPing + kReceived + kPong).empty());
  CHECK(differences_between("", "").empty());
}

TEST_CASE("a message with another payload is a difference of its stream") {
  const Differences differences =
      differences_between(kPing + kPong, kPing + "2,0,b,y,sent,02,pang\n");
  REQUIRE(names_of(differences) == Names{"message b.y sent"});
  CHECK(differences[0].time == Time(2 * kSecond));
  CHECK(differences[0].a == "pong");
  CHECK(differences[0].b == "pang");
  CHECK(differences_between(kPong, "2,0,b,y,sent,02,pong\n").at(0).a == "01");
}

TEST_CASE("a message at another instant, or in another iteration, is one") {
  const Differences later = differences_between(kPong, "2.5,0,b,y,sent,01,pong\n");
  REQUIRE(later.size() == 1);
  CHECK(later[0].time == Time(2 * kSecond));
  CHECK(later[0].a == "at 2 s");
  CHECK(later[0].b == "at 2.5 s");
  CHECK(differences_between(kPong, "2,1,b,y,sent,01,pong\n").at(0).b == "in iteration 1");
}

TEST_CASE("messages that one run has not are counted") {
  const Differences missing =
      differences_between(kPong, kPong + "3,0,b,y,sent,01,\n4,0,b,y,sent,01,\n");
  REQUIRE(missing.size() == 1);
  CHECK(missing[0].time == Time(3 * kSecond));
  CHECK(missing[0].a == "1 in all");
  CHECK(missing[0].b == "3 in all");
  CHECK(missing[0].count == 2);
  CHECK(differences_between(kPing, kPing + kPong).at(0).a == "0 in all");
}

TEST_CASE("with a tolerance of time instants may differ by it, and what was said may not") {
  const std::string later = "1.25,7,a,y,sent,00ff,ping\n";
  CHECK(differences_between(kPing, later, kSecond / 4).empty());
  CHECK(differences_between(kPing, later, kSecond / 5).size() == 1);
  CHECK(differences_between(kPing, "1,2,a,y,sent,00fe,ping\n", kSecond).size() == 1);
}

TEST_CASE("the order of messages of several variables is a difference, if nothing is tolerated") {
  const Differences order = differences_between(kPing + kReceived, kReceived + kPing);
  REQUIRE(names_of(order) == Names{"file events.csv"});
  CHECK(order[0].time == Time(kSecond));
  CHECK(order[0].a == "first a.y sent");
  CHECK(differences_between(kPing + kReceived, kReceived + kPing, Duration()).empty());
}

TEST_CASE("messages of variables that are not selected are left out, also of the order") {
  const Selection without({}, {"b.*"});
  CHECK(differences_between(kPing + kPong, kPong + kPing, {}, without).empty());
  CHECK(differences_between(kPing + kPong, kPing, {}, without).empty());
  CHECK(differences_between(kPing, kPong, {}, without).size() == 1);
}

TEST_CASE("events are the instants of a component in event mode") {
  const TemporaryFolder folder;
  const Streams a = read_events(
      folder.write("a.csv", "time,until,component,kind\n0,0,b,event\n0,2,b,idle\n2,2,b,event\n"));
  const Streams b = read_events(
      folder.write("b.csv", "time,until,component,kind\n0,0,b,event\n0,1,b,idle\n3,3,b,event\n"));
  const Selection none({"x"}, {});  // of signals and messages
  const Differences differences = compare_streams(a, b, {}, none, "activity.csv");
  REQUIRE(names_of(differences) == Names{"event b"});
  CHECK(differences[0].a == "at 2 s");
  CHECK(compare_streams(a, a, {}, none, "activity.csv").empty());
}

TEST_CASE("what is no file of messages is refused, a last line without its end is noted") {
  CHECK_THAT(error_of([] { messages("x,2,a,y,sent,00ff,ping\n"); }),
             Contains("events.csv:2: ") && Contains("time"));
  CHECK_THAT(error_of([] { messages("1,-1,a,y,sent,00ff,ping\n"); }),
             Contains("expected an integer"));
  CHECK_THAT(error_of([] { messages("1,2\n"); }), Contains("events.csv:2: expected 7 fields"));
  CHECK(messages(kPing + "2,0").cut == 3);
  const TemporaryFolder folder;
  CHECK_THAT(error_of([&] { read_events(folder.write("activity.csv", "time,until,kind\n")); }),
             Contains("activity.csv:1: the header has no column 'component'"));
}
