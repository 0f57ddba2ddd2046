#include "master/observe/capture/stimuli_file.h"

#include <catch2/catch.hpp>

#include "tests/master/base/archive/support.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride;
using namespace stride::capture;
using core::Causality;
using core::ValueType;
using stride::tests::Scratch;

namespace {

core::ValueBlock texts(const std::vector<std::string>& values) {
  core::ValueBlock block(ValueType::String, values.size());
  std::copy(values.begin(), values.end(), block.strings().begin());
  return block;
}

}  // namespace

TEST_CASE("the head describes arrays, enumerations, and names with commas") {
  const Scratch scratch;
  core::UnitDescription description;
  description.model_name = "a, b";
  core::Variable words = core::make_variable("words", 0, ValueType::String, Causality::Input);
  words.dimensions = {2, 1};
  words.size = 2;
  core::Variable mode = core::make_variable("mode", 1, ValueType::Enumeration, Causality::Input);
  mode.items = {{"off", 1}, {"on", 2}};
  mode.start = "2";
  core::Variable clock = core::make_variable("sampling", 2, ValueType::Clock, Causality::Input);
  clock.clock->variability = core::IntervalVariability::Constant;
  core::Variable sample = core::make_variable("sample", 3, ValueType::Float64, Causality::Input);
  sample.clocks = {2};
  description.variables = {words, mode, clock, sample};
  StimuliFile file(scratch / "x.csv", {"part", "whole", &description});
  file.end_head(Time{});
  file.add_value(Time{}, "", words, texts({"x", "say \"y\",\nz"}), 0);
  file.commit(Time{});
  file.close("ended by a unit");
  // a clock that the master ticks is none of the stimuli, what it samples is
  CHECK(stride::tests::read(scratch / "x.csv") ==
        "stride stimuli,1\nunit,\"a, b\"\ncomponent,part\nsystem,whole\n"
        "input,words,String,discrete,,,2 1,\"\",\"\"\n"
        "input,mode,Enumeration,discrete,,,,2\nitem,mode,off,1\nitem,mode,on,2\n"
        "input,sample,Float64,continuous,,,,0\n"
        "time,event,variable,value\n"
        "0,,words,\"x\",\"say \"\"y\"\",\nz\"\n"
        "0,end,,\"ended by a unit\"\n");
}

TEST_CASE("rows that wait can be taken back, those that are committed cannot") {
  const Scratch scratch;
  const auto description = core::Describe("device").input("u").done();
  StimuliFile file(scratch / "x.csv", {"part", "whole", description.get()});
  file.end_head(Time{});
  file.add_step(Time{}, Time(Duration(5)));
  const std::size_t mark = file.mark();
  file.add_step(Time(Duration(5)), Time(Duration(9)));
  file.drop(mark);
  file.commit(Time(Duration(5)));
  file.drop(mark);
  file.add_step(Time(Duration(5)), Time(Duration(7)));
  file.close("completed");
  const std::string text = stride::tests::read(scratch / "x.csv");
  CHECK(text.substr(text.find("\n0,")) ==
        "\n0,step,,0.000000000005\n0.000000000005,end,,\"completed\"\n");
}

TEST_CASE("a run that fails before it begins leaves a head and an end") {
  const Scratch scratch;
  const auto description = core::Describe("device").input("u").done();
  StimuliFile file(scratch / "x.csv", {"part", "whole", description.get()});
  file.close("failed: no \"u\"");
  const std::string text = stride::tests::read(scratch / "x.csv");
  CHECK(text.substr(text.find("\ntime,")) ==
        "\ntime,event,variable,value\n0,end,,\"failed: no \"\"u\"\"\"\n");
}

TEST_CASE("a file that cannot be created is an error of the input") {
  const auto description = core::Describe("device").input("u").done();
  try {
    StimuliFile("/nowhere/x.csv", {"part", "whole", description.get()});
    FAIL("it was created");
  } catch (const core::Error& error) {
    CHECK(error.kind() == core::Error::Kind::Input);
    CHECK_THAT(error.what(), Catch::Contains("/nowhere/x.csv: cannot create the file") &&
                                 Catch::Contains("--capture COMPONENT=FILE"));
  }
}
