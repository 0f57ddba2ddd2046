#include "units/player/stimuli.h"

#include <catch2/catch.hpp>

#include "tests/units/player/example.h"

using namespace player;
using stride::tests::example;
using stride::tests::replaced;

namespace {

std::string mistake_in(const std::string& text) {
  try {
    parse_stimuli(text, "x.csv");
  } catch (const std::runtime_error& mistake) {
    return mistake.what();
  }
  return "";
}

std::string mistake_with(const std::string& before, const std::string& after) {
  return mistake_in(replaced(example(), before, after));
}

}  // namespace

TEST_CASE("a file is read as it is written") {
  const Stimuli stimuli = parse_stimuli(example(), "x.csv");
  CHECK(stimuli.unit == "lamp");
  CHECK(stimuli.component == "left");
  CHECK(stimuli.system == "room");
  CHECK(stimuli.ending == "completed");
  REQUIRE(stimuli.inputs.size() == 5);
  const Input& level = stimuli.inputs[0];
  CHECK(level.name == "level");
  CHECK(level.is_continuous);
  CHECK(level.unit == "V");
  CHECK(std::get<std::vector<double>>(level.values) == std::vector<double>{9, 0.5, 0.75});
  CHECK(stimuli.inputs[1].items.size() == 2);
  CHECK(!stimuli.inputs[1].is_continuous);
  CHECK(stimuli.inputs[3].clock == 2u);
  CHECK(stimuli.inputs[4].dimensions == std::vector<std::size_t>{2, 1});
  CHECK(std::get<std::vector<bool>>(stimuli.inputs[4].values) ==
        std::vector<bool>{false, true, true, true});

  REQUIRE(stimuli.entries.size() == 12);
  const Entry& step = stimuli.entries[3];
  CHECK(step.kind == Entry::Kind::Step);
  CHECK(step.target == stride::time_from_seconds(0.25));
  const Entry& tick = stimuli.entries[8];
  CHECK(tick.kind == Entry::Kind::Tick);
  CHECK(tick.event == 1);
  CHECK(tick.input == 2);
  CHECK(tick.time == stride::Time(stride::Duration(499'999'999'999)));
  CHECK(stimuli.start() == stride::Time{});
  CHECK(stimuli.end() == stride::time_from_seconds(1));
}

TEST_CASE("every beginning of a file is known to be cut off") {
  const std::string whole = example();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    INFO(length);
    const std::string mistake = mistake_in(whole.substr(0, length));
    CHECK(mistake.rfind("x.csv:", 0) == 0);
    const bool is_named = mistake.find("cut off") != std::string::npos;
    CHECK((is_named || length == 0));
  }
}

TEST_CASE("a file of something else, or of another version, is refused") {
  CHECK(mistake_in("time,a\n0,1\n") ==
        "x.csv:1: expected 'stride stimuli,1', as stride run --capture writes it");
  CHECK_THAT(mistake_with("stimuli,1", "stimuli,2"),
             Catch::Contains("x.csv:1: the version is '2', expected 1; capture again"));
}

TEST_CASE("an edited head is reported with its line") {
  CHECK_THAT(mistake_with("input,mode", "inpt,mode"), Catch::Contains("'inpt' is not known here"));
  CHECK_THAT(mistake_with("input,mode", "input,level"),
             Catch::Contains("x.csv:6: the input 'level' is described twice"));
  CHECK_THAT(mistake_with("Enumeration", "Enum"), Catch::Contains("'Enum' is not a type"));
  CHECK_THAT(mistake_with("item,mode,on", "item,level,on"),
             Catch::Contains("is not an Enumeration"));
  CHECK_THAT(
      mistake_with(",message.clock,,", ",other.clock,,"),
      Catch::Contains("the head has no clock 'other.clock', which the input 'message.text'"));
  CHECK_THAT(mistake_with("2 1,", "2 0,"), Catch::Contains("'2 0' are not sizes of an array"));
  CHECK_THAT(mistake_with("2 1,", "99999999999999 3,"), Catch::Contains("not sizes"));
  CHECK_THAT(mistake_with("set,level,9", "set,level,9,9"),
             Catch::Contains("'level' has 1 element, the line gives 2"));
  CHECK_THAT(mistake_with("time,event,variable,value", "time,event,value"),
             Catch::Contains("the line has 3 fields, expected time,event,variable,value"));
}

TEST_CASE("rows that are out of order are reported with their line") {
  CHECK_THAT(mistake_with("0.25,,level", "0.2,,level"),
             Catch::Contains("out of order") && Catch::Contains("x.csv:"));
  CHECK_THAT(
      mistake_with("0.25,,level,0.75\n0.25,step,,0.5\n", "0.25,step,,0.5\n0.2,,level,0.75\n"),
      Catch::Contains("the time 0.2 s is before the 0.25 s of the line above"));
  CHECK_THAT(mistake_with("0,step,,0.25\n", ""),
             Catch::Contains("no step leads from 0 s, the time of the line above, to 0.25 s"));
  CHECK_THAT(mistake_with("0,step,,0.25", "0,step,,0.1"),
             Catch::Contains("the time 0.25 s is behind the end of the step in the line above"));
  CHECK_THAT(mistake_with("0.25,step,,0.5", "0.25,step,,0.2"),
             Catch::Contains("the step ends before it begins"));
  CHECK_THAT(mistake_with("999,0,mode", "999,2,mode"),
             Catch::Contains("the event iteration is before that of the line above"));
  CHECK_THAT(mistake_in(example() + "1,,level,1\n"),
             Catch::Contains("the file continues after its end mark"));
}

TEST_CASE("a bad row is reported with its line, and what was expected") {
  CHECK_THAT(mistake_with("0.25,,level,0.75", "0.25,,level,much"),
             Catch::Contains("'much' is not a valid Float64; expected a number"));
  CHECK_THAT(mistake_with("0.25,,level", "0.25,,lever"),
             Catch::Contains("the head has no input 'lever', only level, mode, "));
  CHECK_THAT(mistake_with("0.25,,level", "0.25,x,level"), Catch::Contains("'x' is not an event"));
  CHECK_THAT(mistake_with("0.25,,level", "1e-3,,level"), Catch::Contains("'1e-3' is not a time"));
  CHECK_THAT(mistake_with("0.25,,level", "--1,,level"), Catch::Contains("'--1' is not a time"));
  CHECK_THAT(mistake_with("0.25,,level", "0.2500000000001,,level"),
             Catch::Contains("is not a time"));
  CHECK_THAT(mistake_with("1,message.clock,", "1,message.clock,5"),
             Catch::Contains("the tick of a clock has no value"));
}

TEST_CASE("a file that cannot be read is named") {
  CHECK_THROWS_WITH(load_stimuli("/nowhere/x.csv"),
                    Catch::Contains("/nowhere/x.csv: cannot be read"));
}
