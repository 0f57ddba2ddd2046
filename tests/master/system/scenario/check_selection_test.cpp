#include "master/system/scenario/check_selection.h"

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;
using checks::Kind;
using std::chrono::seconds;

namespace {

using Declarations = std::vector<CheckDeclaration>;

CheckDeclaration declared(Kind kind, const std::string& subject) {
  CheckDeclaration check;
  check.kind = kind;
  check.subject = subject;
  check.where = {"x.ssd", 12};
  return check;
}

CheckDeclaration always(const std::string& signal, const std::string& equals) {
  CheckDeclaration check = declared(Kind::Always, signal);
  check.condition.equals = equals;
  return check;
}

CheckDeclaration count(const std::string& event) {
  CheckDeclaration check = declared(Kind::Count, event);
  check.min = 1;
  return check;
}

CheckDeclaration answer(const std::string& request, const std::string& reply) {
  CheckDeclaration check = declared(Kind::Answer, request);
  check.reply = reply;
  check.within = std::chrono::milliseconds(10);
  return check;
}

std::vector<checks::Definition> selected_checks(const Declarations& declarations) {
  return select_checks(sample_system(), declarations, {Time(seconds(1)), Time(seconds(10))});
}

std::vector<std::string> names(const Declarations& declarations) {
  std::vector<std::string> names;
  for (const checks::Definition& definition : selected_checks(declarations)) {
    names.push_back(definition.name);
  }
  return names;
}

std::string selection_error(const CheckDeclaration& check) {
  return error_of([&] { selected_checks({check}); });
}

CheckDeclaration during(std::optional<int> from, std::optional<int> to) {
  CheckDeclaration check = always("a.led", "true");
  if (from) check.window.from = Time(seconds(*from));
  if (to) check.window.to = Time(seconds(*to));
  return check;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("a check without a name has what it demands for one") {
  CheckDeclaration range = declared(Kind::Never, "a.distance");
  range.condition.above = "2";
  range.window.to = Time(seconds(5));
  CheckDeclaration both = count("a.transmit.frame");
  both.max = 3;
  CHECK(names({range, always("a.mode", "off"), both, answer("a.transmit.frame", "b, c.tick")}) ==
        Names{"a.distance never > 2 m up to 5 s", "a.mode always = off",
              "a.transmit.frame count >= 1 and <= 3",
              "a.transmit.frame answered by b, c.tick within 0.01 s"});
  range.name = "near";
  const auto definitions = selected_checks({range});
  CHECK((definitions[0].name == "near" &&
         definitions[0].demand == "a.distance never > 2 m up to 5 s"));
  CHECK(definitions[0].where.line == 12);
}

TEST_CASE("until has two signals, each with its own condition") {
  CheckDeclaration until = declared(Kind::Until, "a.led");
  until.condition.equals = "false";
  until.ending_signal = "a.range";
  until.ending.below = "2";
  until.window.to = Time(seconds(5));
  CHECK(names({until}) == Names{"a.led is = false until a.distance < 2 m up to 5 s"});
  until.ending_signal = "*.led";
  CHECK_THAT(selection_error(until), Contains("'*.led' matches 2 signals; expected one"));
  until.ending_signal = "a.lde";
  CHECK_THAT(selection_error(until),
             Contains("there is no signal 'a.lde'") && Contains("did you mean 'a.led'?"));
  until.ending_signal = "a.mode";
  CHECK_THAT(selection_error(until), Contains("a.mode"));
}

TEST_CASE("a glob is a check for each signal or message, an array one for each element") {
  CHECK(names({always("*.led", "true")}) == Names{"a.led always = true", "b, c.led always = true"});
  CHECK(names({count("*.transmit.*")}) ==
        Names{"a.transmit.frame count >= 1", "b, c.transmit.frame count >= 1"});
  CheckDeclaration still = always("a.position", "0");
  still.name = "still";
  CHECK(names({still}) ==
        Names{"still: a.position[1]", "still: a.position[2]", "still: a.position[3]"});
  const auto one = selected_checks({always("a.position[2]", "0")});
  REQUIRE(one.size() == 1);
  CHECK(std::get<checks::SignalDemand>(one[0].what).element == 1);
  CHECK(names({always("a.range", "0")}) == Names{"a.distance always = 0 m"});
}

TEST_CASE("names that match nothing, or something of another kind") {
  CHECK_THAT(selection_error(always("a.lde", "true")),
             Contains("x.ssd:12: there is no signal 'a.lde'") && Contains("did you mean 'a.led'?"));
  CHECK_THAT(selection_error(always("z.*", "true")), Contains("there is no signal 'z.*'"));
  CHECK_THAT(selection_error(always("a.position[4]", "0")),
             Contains("there is no signal 'a.position[4]'"));
  CHECK_THAT(selection_error(always("a.transmit.frame", "00")),
             Contains("'a.transmit.frame' belongs to a clock") && Contains("<stride:Count"));
  CHECK_THAT(selection_error(count("a.tikc")),
             Contains("there is no message 'a.tikc'") && Contains("did you mean 'a.tick'?"));
  CHECK_THAT(selection_error(count("a.led")),
             Contains("'a.led' is not a message") && Contains("Eventually"));
  CHECK_THAT(selection_error(count("a.transmit.clock")),
             Contains("ticks of 'a.transmit.clock' cannot be checked") &&
                 Contains("name what it carries: 'a.transmit.frame'"));
  CHECK_THAT(selection_error(answer("a.tick", "a.tick")),
             Contains("'a.tick' cannot answer itself"));
  CHECK_THAT(selection_error(answer("*.tick", "a.tick")), Contains("'*.tick' matches 2 messages"));
  CHECK_THAT(error_of([] { select_checks(sampled_system(), Declarations{count("s.tick")}, {}); }),
             Contains("it ticks by the time alone"));
}

TEST_CASE("a condition that does not fit its signal") {
  CHECK_THAT(
      selection_error(always("a.led", "on")),
      Contains("x.ssd:12: 'a.led': equals: 'on' is not a value") && Contains("true or false"));
  CHECK_THAT(selection_error(always("a.mode", "standby")), Contains("'a.mode': equals: 'standby'"));
  CHECK_THAT(selection_error(declared(Kind::Final, "a.distance")),
             Contains("'a.distance': it compares with nothing"));
}

TEST_CASE("an interval must be within the run") {
  CHECK(selected_checks({during(1, 10)}).size() == 1);
  CHECK(selected_checks({during(0, {})}).size() == 1);
  CHECK_THAT(selection_error(during(11, {})),
             Contains("from: 11 s is behind the end of the run, at 10 s"));
  CHECK_THAT(
      selection_error(during({}, 11)),
      Contains("to: 11 s is behind the end of the run, at 10 s") && Contains("leave 'to' out"));
  CHECK_THAT(selection_error(during(0, 0)),
             Contains("to: 0 s is before the beginning of the run, at 1 s"));
  CHECK(select_checks(sample_system(), Declarations{during(11, 12)}, {}).size() == 1);
}

TEST_CASE("two checks of one name, and several mistakes at once") {
  CheckDeclaration first = always("a.led", "true");
  first.name = "led";
  CheckDeclaration second = always("b, c.led", "true");
  second.name = "led";
  second.where.line = 14;
  CHECK_THAT(error_of([&] {
               selected_checks({first, second});
             }),
             Contains("x.ssd:14: a second check 'led'; the first is in line 12"));
  CHECK_THAT(error_of([&] {
               selected_checks({always("a.x", "1"), count("a.led")});
             }),
             Contains("there are 2 mistakes") && Contains("'a.x'") && Contains("is not a message"));
}
