#include "units/player/table.h"

#include <catch2/catch.hpp>

using namespace player;
using stride::time_from_seconds;

namespace {

Stimuli table(const std::string& text) { return parse_table(text, "x.csv"); }

std::string table_mistake_in(const std::string& text) {
  try {
    table(text);
  } catch (const std::runtime_error& mistake) {
    return mistake.what();
  }
  return "";
}

std::vector<Entry::Kind> kinds_of(const Stimuli& stimuli) {
  std::vector<Entry::Kind> kinds;
  for (const Entry& entry : stimuli.entries) kinds.push_back(entry.kind);
  return kinds;
}

}  // namespace

TEST_CASE("the types of columns follow from their values") {
  const Stimuli stimuli =
      table("time,speed [km/h],door,note\n0,72,true,\"\"\n10,100,false,\"a, b\"\n");
  REQUIRE(stimuli.inputs.size() == 3);
  CHECK(stimuli.is_table);
  CHECK(stimuli.inputs[0].unit == "km/h");
  CHECK(stimuli.inputs[0].type == Type::Float64);
  CHECK(stimuli.inputs[0].curve->at(time_from_seconds(5)).value == 86);
  CHECK(stimuli.inputs[1].type == Type::Boolean);
  CHECK(!stimuli.inputs[1].curve);
  CHECK(std::get<std::vector<std::string>>(stimuli.inputs[2].values) ==
        std::vector<std::string>{"", "a, b"});
  CHECK(stimuli.end() == time_from_seconds(10));
}

TEST_CASE("values may have blanks around them, and the forms that other programs write") {
  const Stimuli stimuli = table(
      "time, speed [m/s] ,door,gear: Int32,lamp: Boolean\n"
      " 0 , 1.5,True , 1.0,1\n"
      "+1,\t+2 ,FALSE,  ,0\n"
      "2,   ,false,2,\n");
  CHECK(stimuli.inputs[0].name == "speed");
  CHECK(stimuli.inputs[0].type == Type::Float64);
  CHECK(stimuli.inputs[0].curve->at(time_from_seconds(0.5)).value == 1.75);
  CHECK(std::get<std::vector<bool>>(stimuli.inputs[1].values) == std::vector<bool>{true, false});
  CHECK(std::get<std::vector<std::int32_t>>(stimuli.inputs[2].values) ==
        std::vector<std::int32_t>{1, 2});
  CHECK(std::get<std::vector<bool>>(stimuli.inputs[3].values) == std::vector<bool>{true, false});
}

TEST_CASE("a column of texts may have numbers where it says so, or they are in quotation marks") {
  for (const char* text : {"time,id: String\n0,12\n1,A7\n", "time,id\n0,\"12\"\n1,\"A7\"\n"}) {
    CHECK(std::get<std::vector<std::string>>(table(text).inputs[0].values) ==
          std::vector<std::string>{"12", "A7"});
  }
  CHECK(table("time,u\n0,\"1\"\n1,\"2\"\n").inputs[0].type == Type::Float64);
}

TEST_CASE("the first row is the beginning, also where its values come later") {
  CHECK(table("time,u\n2,\n3,1\n").begin == time_from_seconds(2));
  CHECK(table("time,u\n-2,1\n").begin == time_from_seconds(-2));
}

TEST_CASE("a held column has an entry where its value changes") {
  const Stimuli stimuli = table("time [ms],gear:Int8\n0,1\n5,1\n7,2\n8,\n9,3\n");
  REQUIRE(kinds_of(stimuli) ==
          std::vector{Entry::Kind::Value, Entry::Kind::Value, Entry::Kind::End});
  CHECK(stimuli.entries[0].time == time_from_seconds(0.007));
  CHECK(stimuli.entries[1].time == time_from_seconds(0.009));
  CHECK(std::get<std::vector<std::int8_t>>(stimuli.inputs[0].values) ==
        std::vector<std::int8_t>{1, 2, 3});
}

TEST_CASE("a row of event columns is a message, an empty one is none") {
  const Stimuli stimuli =
      table("time,frame.data:Binary event,frame.id:UInt8 event\n0,,\n0.5,0aff,7\n0.5,01,8\n1,,\n");
  REQUIRE(stimuli.inputs.size() == 3);
  CHECK(stimuli.inputs[0].name == "frame.clock");
  CHECK(stimuli.inputs[0].type == Type::Clock);
  CHECK(stimuli.inputs[1].clock == 0u);
  CHECK(stimuli.inputs[2].clock == 0u);
  using Kind = Entry::Kind;
  CHECK(kinds_of(stimuli) == std::vector{Kind::Tick, Kind::Value, Kind::Value, Kind::Tick,
                                         Kind::Value, Kind::Value, Kind::End});
  CHECK(stimuli.entries[0].time == time_from_seconds(0.5));
  CHECK(stimuli.end() == time_from_seconds(1));
}

TEST_CASE("a second row of the same time is a jump of a line") {
  const Stimuli stimuli = table("time,u\n0,0\n1,2\n1,5\n2,5");
  REQUIRE(kinds_of(stimuli) == std::vector{Entry::Kind::Jump, Entry::Kind::End});
  CHECK(stimuli.entries[0].time == time_from_seconds(1));
  CHECK(stimuli.entries[0].event == 1);
}

TEST_CASE("a second row of the same time is a jump of a held value") {
  const Stimuli stimuli = table("time,k:Int32\n0,0\n1,2\n1,5\n2,5\n");
  REQUIRE(kinds_of(stimuli) ==
          std::vector{Entry::Kind::Value, Entry::Kind::Value, Entry::Kind::End});
  CHECK(stimuli.entries[0].time == time_from_seconds(1));
  CHECK(stimuli.entries[1].time == time_from_seconds(1));
  CHECK(std::get<std::vector<std::int32_t>>(stimuli.inputs[0].values) ==
        std::vector<std::int32_t>{0, 2, 5});
}

TEST_CASE("rows of one time may repeat a value") {
  const Stimuli stimuli = table("time,u,k:Int32\n0,0,0\n1,0,0\n1,2,2\n1,2,2\n1,,\n2,5,5\n");
  CHECK(stimuli.inputs[0].curve->before(time_from_seconds(1)) == 0);
  CHECK(stimuli.inputs[0].curve->at(time_from_seconds(1)).value == 2);
  CHECK(std::get<std::vector<std::int32_t>>(stimuli.inputs[1].values) ==
        std::vector<std::int32_t>{0, 2, 5});
}

TEST_CASE("lines without a value at the end are none") {
  for (const char* end : {"", "\n", "\n\n", "\n , \n\r\n,,\n", "\r\n\r\n"}) {
    INFO(end);
    const Stimuli stimuli = table(std::string("time,u,s\n0,1,a\n1,2,\"\"") + end);
    CHECK(stimuli.end() == time_from_seconds(1));
    CHECK(std::get<std::vector<std::string>>(stimuli.inputs[1].values).back().empty());
  }
}

TEST_CASE("times are exact to the picosecond, and may be before the start") {
  const Stimuli stimuli = table("time,k:Int32\n-1.5,0\n0.1,1\n1e-1,2\n14.200358702064,3\n");
  CHECK(stimuli.entries[0].time == stride::Time(stride::Duration(100'000'000'000)));
  CHECK(stimuli.entries[1].time == stimuli.entries[0].time);
  CHECK(stimuli.entries[2].time == stride::Time(stride::Duration(14'200'358'702'064)));
}

TEST_CASE("what sums of doubles leave in place of 0 is 0, and of one time the same") {
  const Stimuli stimuli = table("time,k:Int32\n-0.1,0\n5.5e-17,1\n0.3,2\n0.30000000000000004,3\n");
  CHECK(stimuli.entries[0].time == stride::Time{});
  CHECK(stimuli.entries[1].time == stimuli.entries[2].time);
}

TEST_CASE("whole numbers keep their digits, or their column says that it may round them") {
  const Stimuli stimuli = table(
      "time,a: Int64,b: Float64,c,d\n0,9007199254740993,9007199254740993,1e300,36028797018963968\n"
      "1,-9007199254740993,0,123456789012345678901234,-9007199254740994\n");
  CHECK(std::get<std::vector<std::int64_t>>(stimuli.inputs[0].values) ==
        std::vector<std::int64_t>{9007199254740993, -9007199254740993});
  CHECK(stimuli.inputs[1].curve->at(time_from_seconds(0)).value == 9007199254740992.0);
}

TEST_CASE("mistakes in a table have the line and the column") {
  const std::pair<const char*, const char*> kMistakes[] = {
      {"", "x.csv:1: the table is empty"},
      {"t,u\n0,1\n", "x.csv:1: the first column is 't'"},
      {"time;u\n0;1\n", "x.csv:1: the fields are separated by ';'; expected commas"},
      {"time\tu\n0\t1\n", "x.csv:1: the fields are separated by tabs; expected commas"},
      {"time,u\r0,1\r1,2\r", "x.csv:1: the lines end with a carriage return alone"},
      {"\xff\xfet", "x.csv:1: the file is in UTF-16; expected UTF-8"},
      {"time\n0\n", "x.csv:1: the table has no column"},
      {"time,u\n", "x.csv:1: the table has headings, and no rows"},
      {"time,u,x: int\n0,1,2\n", "x.csv:1: column 3: 'int' behind the colon"},
      {"time,time\n0,1\n", "x.csv:1: column 2: 'time' is the name of the first column"},
      {"time,u,v,u\n0,1,2,3\n", "x.csv:1: columns 2 and 4 have one name, 'u'"},
      {"time,k: Int32 linear\n0,1\n", "x.csv:1: column 'k': only Float64 and Float32"},
      {"time,k [m]: Int32\n0,1\n", "x.csv:1: column 'k': a value with a unit of measure, [m], is"},
      {"time,k: Int32 event\n0,1\n", "x.csv:1: column 'k': expected a name such as 'k.value'"},
      {"time,u,v\n0,1\n", "x.csv:2: the line has 2 fields, the headings 3"},
      {"time,u\n0\n", "x.csv:2: the line has 1 field, the headings 2; a field without a value is"},
      {"time,u\n0,1\n\n1,2\n", "x.csv:3: the line is empty"},
      {"\n\n", "x.csv:1: the table is empty"},
      {"# made by hand\ntime,u\n0,1\n",
       "x.csv:1: the line begins with '#'; a table has no comments"},
      {"u,time [s]\n1,0\n",
       "x.csv:1: 'time [s]' is the heading of column 2; expected it as the first"},
      {"time (s),u\n0,1\n", "did you mean 'time [s]'?"},
      {"time;u [m],v\n0;1\n", "x.csv:1: the fields are separated by ';'"},
      {"time,u\n0,5;1,2\n",
       "x.csv:2: the line has 3 fields, the headings 2; fields are separated "
       "by commas, not by ';', and numbers have a decimal point"},
      {"time,u,v\n0,1,2\n0,5;1,2\n",
       "'5;1' is not a number as '1' in line 2 is; expected commas between"},
      {"time,u\n0,5,1\n", "the headings 2; numbers have a decimal point"},
      {"time,u\n0,\"0,5\"\n1,\"1,5\"\n",
       "x.csv:2: column 'u': '0,5' looks like a number with a "
       "decimal comma; expected a decimal point"},
      {"time,u\n1,0\n1,1\n1,2\n", "x.csv:4: column 'u': a third value at the time 1; two are"},
      {"time,k:Int32\n1,0\n1,1\n1,0\n", "x.csv:4: column 'k': a third value at the time 1"},
      {"time,u\n1,1\n0,1\n", "x.csv:3: column 'time': 0 is before"},
      {"time,u\nx,1\n", "x.csv:2: column 'time': 'x' is not a time"},
      {"time,u\n,1\n", "x.csv:2: column 'time': '' is not a time"},
      {"time,u\n1e16,1\n", "x.csv:2: column 'time': '1e16' is beyond 1e15 s, the largest"},
      {"time,u\n0,1\n9999999999999999,1\n", "'9999999999999999' is beyond 1e15 s"},
      {"time,u\n1e-13,1\n", "x.csv:2: column 'time': 1e-13 is less than 1 ps from 0"},
      {"time [us],u\n0,1\n1e-7,1\n", "x.csv:3: column 'time': 1e-7 is less than 1 ps from the"},
      {"time,n\n0,9007199254740992\n1,9007199254740993\n",
       "x.csv:3: column 'n': '9007199254740993' has more digits than a Float64, the type of a "
       "column "
       "of numbers; write ': Int64'"},
      {"time,u:Float64\n0,1\n1,x\n", "x.csv:3: column 'u': 'x' is not a valid Float64"},
      {"time,k:Int8\n0,1\n1,128\n", "x.csv:3: column 'k': '128' is not a valid Int8"},
      {"time,u\n0,nan\n", "x.csv:2: column 'u': 'nan' is not finite"},
      {"time,u,v\n0,1,\n1,1,\n", "x.csv:1: column 'v' has no value in any row"},
      {"time,u:Float32\n0,1e39\n", "x.csv:2: column 'u': '1e39' is not a valid Float32"},
      {"time,u\n0,1\n1,\n2,n/a\n3,2\n",
       "x.csv:4: column 'u': 'n/a' is not a number as '1' in line 2 is; leave the field empty if "
       "there is no value, or write ': String' behind the heading"},
      {"time,u\n0,1\n1,\"1,5\"\n", "x.csv:3: column 'u': '1,5' is not a number"},
      {"time,u\n0,x\n1,2\n", "x.csv:3: column 'u': '2' is not text as 'x' in line 2 is"},
      {"time,u\n0,n/a\n1,2\n2,3\n", "x.csv:2: column 'u': 'n/a' is not a number as '2' in line 3"},
      {"time,b\n0,1\n1,true\n", "or write ': Boolean' behind the heading"},
      {"time,k:Int32\n0,1.5\n", "x.csv:2: column 'k': '1.5' is not a valid Int32"},
      {"time,f.a:Int8 event,f.b:Int8 event\n0,1,\n", "x.csv:2: column 'f.b': the message has"},
  };
  for (const auto& [text, expected] : kMistakes) {
    INFO(text);
    CHECK_THAT(table_mistake_in(text), Catch::Contains(expected));
  }
}
