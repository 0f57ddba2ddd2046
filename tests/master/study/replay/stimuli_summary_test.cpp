#include "master/study/replay/stimuli_summary.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/base/archive/support.h"

using namespace stride::replay;
using Catch::Contains;
using stride::tests::error_of;
using stride::tests::Scratch;

namespace {

const std::string kHead =
    "stride stimuli,1\nunit,u\ncomponent,\"a, b\"\nsystem,s\ninput,x,Float64,continuous,,,,0\n"
    "input,clock,Clock,discrete,,,\ninput,unused,Int8,discrete,,,,0\n"
    "input,bell,Clock,discrete,,,\ninput,frame,Binary,discrete,,bell,,\nset,size,1\nskip,1\ntime,"
    "event,variable,value\n";
const std::string kRows =
    "0.5,,x,1\n0.5,step,,0.75\n0.75,,x,2\n0.75,0,clock,\n0.75,step,,1\n1,end,,\"completed\"\n";

StimuliSummary summary(const std::string& text) {
  const Scratch scratch;
  scratch.write("x.csv", text);
  return summarise_stimuli(scratch / "x.csv");
}

std::string part(const std::string& text) {
  const Scratch scratch;
  scratch.write("x.csv", text);
  return repeated_part(scratch / "x.csv");
}

}  // namespace

TEST_CASE("a summary has the inputs, the times and the skip of a file") {
  const StimuliSummary found = summary(kHead + kRows);
  CHECK(found.component == "a, b");
  CHECK(found.inputs == std::vector<std::string>{"x", "clock", "bell", "frame"});
  CHECK(found.max_skip == "1");
  CHECK(found.start == "0.5");
  CHECK(found.end == "1");
  CHECK(found.instants == std::set<std::string>{"0.5", "0.75", "1"});
  CHECK(found.event_instants == std::set<std::string>{"0.75"});
}

TEST_CASE("what cannot be played has no summary") {
  CHECK_THAT(error_of([] { summary(kHead + "0,end,,\"failed: it refused\"\n"); }),
             Contains("it has no step"));
  CHECK_THAT(error_of([] { summary(kHead + "0,step,,1\n"); }), Contains("it has no end mark"));
  CHECK_THAT(error_of([] { summary("x\n"); }), Contains("x.csv:1: this is no line of captured"));
}

TEST_CASE("what a replay has to repeat is all but names and the reason of the end") {
  const std::string here = part(kHead + kRows);
  CHECK_THAT(here, Contains("set,size,1") && Contains("skip,1") && Contains("0.75,step,,1"));
  std::string there = kHead + kRows;
  there.replace(there.find("system,s"), 8, "system,t");
  there.replace(there.find("completed"), 9, "failed: it broke");
  CHECK(part(there) == here);
  there.replace(there.find("0.75,,x,2"), 9, "0.75,,x,3");
  CHECK(part(there) != here);
  there = kHead + kRows;
  there.replace(there.find("set,size,1"), 10, "set,size,2");
  CHECK(part(there) != here);
  there = kHead + kRows;
  there.replace(there.find("skip,1"), 6, "set,x,3\nskip,1");
  CHECK(part(there) == here);
  there = kHead + kRows;
  there.replace(there.find("1,end,"), 6, "2,end,");
  CHECK(part(there) != here);
}
