#include "master/observe/checks/message_checks.h"

#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;
using Limit = std::optional<std::uint64_t>;

namespace {

/// A millisecond of a course.
void pass(Check& check, char letter, std::int64_t time) {
  if (letter == '-') return;
  if (letter == 'q' || letter == 'o') check.on_message(message(time, 1));
  if (letter != 'q' && letter != ' ') check.on_message(message(time, 2));
  if (letter == 'b') check.on_message(message(time, 1));
  check.on_message(message(time, 3));
  check.on_point(at(time));
}

/// Of a run that is resumed at this millisecond.
template <class OneCheck>
core::Verdict judged(const Definition& definition, const std::string& course, const Ending& ending,
                     std::size_t resumed_at) {
  OneCheck first(definition), second(definition);
  for (std::size_t i = 0; i < course.size(); ++i) {
    if (i == resumed_at) take_over(second, first);
    pass(i < resumed_at ? first : second, course[i], static_cast<std::int64_t>(i));
  }
  return (resumed_at < course.size() ? second : first).verdict(ending);
}

/// A course in words: each letter is a millisecond, 'q' a request, 'r' a reply, 'b' a reply and
/// then a request, 'o' a request and its reply in the same instant; a blank is a communication
/// point where neither comes, '-' is none.
core::Verdict judged(const std::string& course, int within, bool repeats = false, Window of = {},
                     bool is_complete = true) {
  const Definition definition{
      Kind::Answer, "answers", "",
      of,           {},        AnswerDemand{{0, 1}, {0, 2}, at(within) - Time{}, repeats}};
  const Ending ending{at(static_cast<std::int64_t>(course.size()) - 1), is_complete};
  core::Verdict verdict = judged<AnswerCheck>(definition, course, ending, course.size());
  for (std::size_t i = 0; i < course.size(); ++i) {
    CHECK(text_of(judged<AnswerCheck>(definition, course, ending, i)) == text_of(verdict));
  }
  return verdict;
}

}  // namespace

TEST_CASE("a reply in time, to the very instant") {
  const auto verdict = judged("q r  qr ", 2);
  CHECK(verdict.passed == true);
  CHECK(verdict.text == "2 requests answered, after 0.002 s at most");
  CHECK(judged("o   ", 0).text == "1 request answered, after 0 s at most");
  CHECK(judged("q--r", 3).passed == true);
}

TEST_CASE("a reply too late: the failure is where the time was out") {
  const auto verdict = judged(" q  r  qr ", 2);
  CHECK((verdict.passed == false && verdict.time == at(3)));
  CHECK(verdict.text == "no reply to the request at 0.001 s; 1 of 2 requests answered in time");
  CHECK(judged("q---r", 3).time == at(3));
  CHECK(judged("q    ", 4).time == at(4));
}

TEST_CASE("a reply before the request is none") {
  CHECK(judged("rq ", 1).passed == false);
  CHECK(judged("qrb  ", 1).time == at(3));
}

TEST_CASE("a reply answers one request, the oldest") {
  CHECK(judged("qqrr", 2).passed == true);
  const auto verdict = judged("qqr  ", 2);
  CHECK((verdict.passed == false && verdict.time == at(3)));
}

TEST_CASE("with repeats it answers all that are open, whose time counts from the first") {
  CHECK(judged("qqr  ", 2, true).passed == true);
  CHECK(judged("qqr  ", 2, true).text == "1 request answered, after 0.002 s at most");
  CHECK(judged("qqqr", 2, true).time == at(2));
  CHECK(judged("qrqr", 1, true).text == "2 requests answered, after 0.001 s at most");
}

TEST_CASE("a request whose time is not out where the run ends is undecided") {
  const auto verdict = judged("qr q", 1);
  CHECK_FALSE(verdict.passed);
  CHECK(verdict.text ==
        "the request at 0.003 s was still open where the run ended, at 0.003 s; 1 of 2 answered");
  CHECK(judged("q  q", 1).passed == false);
}

TEST_CASE("the interval is that of the requests") {
  CHECK(judged("q qr q", 1, false, window(1, 4)).passed == true);
  CHECK(judged("   q  r", 3, false, window(3, 3)).passed == true);
  CHECK(judged("   q   ", 3, false, window(3, 3)).time == at(6));
}

TEST_CASE("no request, and a run that breaks off, decide nothing") {
  CHECK(judged("  r ", 1).text == "there was no request");
  CHECK_FALSE(judged("  r ", 1).passed);
  CHECK_FALSE(judged("qr  ", 1, false, {}, false).passed);
  CHECK(judged("qr  ", 1, false, window(0, 2), false).passed == true);
  CHECK(judged("q   ", 1, false, {}, false).time == at(1));
}

TEST_CASE("margin of an answer: the least time that was left") {
  CHECK(margin_of(judged("q r  qr ", 3)) == "0.001 s at 0.002 s");
  CHECK(margin_of(judged("o   ", 0)) == "0 s at 0 s");
  CHECK(margin_of(judged("qr q", 1)) == "none");
  CHECK(margin_of(judged("  r ", 1)) == "none");
}

TEST_CASE("margin of an answer that is late: by how much") {
  CHECK(margin_of(judged(" q   r qr ", 2)) == "-0.002 s at 0.005 s");
  CHECK(margin_of(judged("q     ", 2)) == "-0.003 s at 0.005 s");
  CHECK(margin_of(judged("q  ", 2)) == "0 s at 0.002 s");
  CHECK(margin_of(judged("q     ", 2, false, {}, false)) == "-0.003 s at 0.005 s");
}

TEST_CASE("a reply that answers no open request answers the oldest late one") {
  CHECK(margin_of(judged("q  qr r", 2)) == "-0.004 s at 0.006 s");
  CHECK(margin_of(judged("q  qr    ", 2)) == "-0.006 s at 0.008 s");
  CHECK(margin_of(judged("qq   rr  ", 2)) == "-0.003 s at 0.005 s");
  CHECK(margin_of(judged("qq   r     ", 2)) == "-0.007 s at 0.01 s");
}

TEST_CASE("with repeats each reply answers the late ones, too") {
  CHECK(margin_of(judged("q  qr    ", 2, true)) == "-0.002 s at 0.004 s");
  CHECK(margin_of(judged("q   q   q r ", 2, true)) == "-0.008 s at 0.01 s");
  CHECK(margin_of(judged("qqr  ", 3, true)) == "0.001 s at 0.002 s");
}

TEST_CASE("a run that fails amid the events of an instant never turns the sign") {
  const Definition definition{
      Kind::Answer, "answers", "", {}, {}, AnswerDemand{{0, 1}, {0, 2}, at(5) - Time{}, false}};
  AnswerCheck check(definition);
  check.on_message(message(0, 1));
  check.on_point(at(0));
  check.on_message(message(6, 2));
  check.on_message(message(6, 1));
  CHECK(margin_of(check.verdict(broke(0))) == "-0.001 s at 0.006 s");
  AnswerCheck other(definition);
  other.on_message(message(0, 1));
  other.on_message(message(6, 1));
  const auto verdict = other.verdict(broke(0));
  CHECK((verdict.passed == false && margin_of(verdict) == "0 s at 0 s"));
}

namespace {

/// Messages at 1, 2, 3 and 4 ms, with others between, and communication points there and at 5 ms.
core::Verdict counted(Limit min, Limit max, Window of = {}, const Ending& ending = ended(5)) {
  const Definition definition{Kind::Count, "frames", "", of, {}, CountDemand{{0, 3}, min, max}};
  CountCheck check(definition), resumed(definition);
  check.on_point(at(0));
  const auto go_on = [](CountCheck& one, int first, int last) {
    for (int time = first; time <= last; ++time) {
      one.on_message(message(time, 3));
      one.on_message(message(time, 4));
      one.on_point(at(time));
    }
  };
  go_on(check, 1, 2);
  take_over(resumed, check);
  for (CountCheck* one : {&check, &resumed}) {
    go_on(*one, 3, 4);
    one->on_point(at(5));
  }
  CHECK(text_of(resumed.verdict(ending)) == text_of(check.verdict(ending)));
  return check.verdict(ending);
}

}  // namespace

TEST_CASE("messages of the variable are counted, and no others") {
  const auto verdict = counted(4, 4);
  CHECK((verdict.passed == true && verdict.text == "4 messages" && verdict.kind == "count"));
  CHECK(counted(1, 1, window(4, {})).text == "1 message");
}

TEST_CASE("one too many fails where it comes, also if the run breaks off") {
  for (const Ending& ending : {ended(5), broke(5)}) {
    const auto verdict = counted({}, 2, {}, ending);
    CHECK((verdict.passed == false && verdict.time == at(3)));
    CHECK(verdict.text == "message number 3; expected 2 at most");
  }
}

TEST_CASE("too few fail where the interval ends") {
  const auto verdict = counted(5, {});
  CHECK((verdict.passed == false && verdict.time == at(5)));
  CHECK(verdict.text == "4 messages; expected 5 at least");
  CHECK(counted(3, {}, window(0, 2)).time == at(2));
}

TEST_CASE("the interval's ends belong to it") {
  CHECK(counted(3, 3, window(2, 4)).passed == true);
  CHECK(counted(0, 0, window(5, {})).passed == true);
}

TEST_CASE("a run that breaks off leaves open what could still come") {
  CHECK_FALSE(counted(5, {}, {}, broke(5)).passed);
  CHECK_FALSE(counted({}, 4, {}, broke(5)).passed);
  CHECK(counted(4, {}, {}, broke(5)).passed == true);
  CHECK(counted({}, 4, window({}, 5), broke(5)).passed == true);
  CHECK_FALSE(counted({}, 4, window({}, 6), ended(5)).passed);
}

TEST_CASE("margin of a count: how many more or fewer there may be, too many or missing") {
  CHECK(margin_of(counted(1, 10)) == "3 messages at 0.005 s");
  CHECK(margin_of(counted(1, 5)) == "1 messages at 0.005 s");
  CHECK(margin_of(counted(4, 4)) == "0 messages at 0.005 s");
  CHECK(margin_of(counted({}, 1)) == "-3 messages at 0.005 s");
  CHECK(margin_of(counted(6, {}, window(0, 3))) == "-3 messages at 0.003 s");
  CHECK(margin_of(counted({}, 2, {}, broke(5))) == "-2 messages at 0.005 s");
  CHECK(margin_of(counted({}, 4, {}, broke(5))) == "none");
  CHECK(margin_of(counted(0, std::numeric_limits<std::uint64_t>::max())) ==
        "4 messages at 0.005 s");
}
