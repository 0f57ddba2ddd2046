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

TEST_CASE("times are exact to the picosecond, and may be before the start") {
  const Stimuli stimuli = table("time,k:Int32\n-1.5,0\n0.1,1\n1e-1,2\n14.200358702064,3\n");
  CHECK(stimuli.entries[0].time == stride::Time(stride::Duration(100'000'000'000)));
  CHECK(stimuli.entries[1].time == stimuli.entries[0].time);
  CHECK(stimuli.entries[2].time == stride::Time(stride::Duration(14'200'358'702'064)));
}

TEST_CASE("mistakes in a table have the line and the column") {
  const std::pair<const char*, const char*> kMistakes[] = {
      {"", "x.csv:1: the table is empty"},
      {"t,u\n0,1\n", "x.csv:1: the first column is 't'"},
      {"time;u\n0;1\n", "x.csv:1: the first column is 'time;u'"},
      {"time\n0\n", "x.csv:1: the table has no column"},
      {"time,u,v,u\n0,1,2,3\n", "x.csv:1: columns 2 and 4 have one name, 'u'"},
      {"time,k: Int32 linear\n0,1\n", "x.csv:1: column 'k': only Float64 and Float32"},
      {"time,k: Int32 event\n0,1\n", "x.csv:1: column 'k': expected a name such as 'k.value'"},
      {"time,u,v\n0,1\n", "x.csv:2: the line has 2 fields, the headings 3"},
      {"time,u\n0,1\n\n", "x.csv:3: the line has 1 fields"},
      {"time,u\n1,1\n0,1\n", "x.csv:3: column 'time': 0 is before"},
      {"time,u\nx,1\n", "x.csv:2: column 'time': 'x' is not a time"},
      {"time,u\n,1\n", "x.csv:2: column 'time': '' is not a time"},
      {"time,u\n1e7,1\n", "x.csv:2: column 'time': '1e7' is not a time"},
      {"time,u:Float64\n0,1\n1,x\n", "x.csv:3: column 'u': 'x' is not a valid Float64"},
      {"time,k:Int8\n0,1\n1,128\n", "x.csv:3: column 'k': '128' is not a valid Int8"},
      {"time,u\n0,nan\n", "x.csv:2: column 'u': 'nan' is not finite"},
      {"time,u,v\n0,1,\n", "column 'v': the column has no value"},
      {"time,f.a:Int8 event,f.b:Int8 event\n0,1,\n", "x.csv:2: column 'f.b': the message has"},
  };
  for (const auto& [text, expected] : kMistakes) {
    INFO(text);
    CHECK_THAT(table_mistake_in(text), Catch::Contains(expected));
  }
}
