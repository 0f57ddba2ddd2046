#include "master/observe/capture/unended_stimuli.h"

#include <catch2/catch.hpp>

#include "tests/master/base/archive/support.h"

using stride::capture::end_stimuli;
using stride::tests::read;
using stride::tests::Scratch;

namespace {

const std::string kHead =
    "stride stimuli,1\nunit,u\ncomponent,c\nsystem,s\ninput,end,String,discrete,,,,\"\"\n"
    "set,step,1\ntime,event,variable,value\n";
const std::string kFirst = "0,,end,\"a\n1,end,,\"\"\"\n0,step,,1\n";

std::string ended(const std::string& rows) {
  const Scratch scratch;
  scratch.write("x.csv", kHead + rows);
  const bool is_good = end_stimuli(scratch / "x.csv", "failed: \"killed\"");
  const std::string text = read(scratch / "x.csv");
  REQUIRE(text.substr(0, kHead.size()) == kHead);
  return is_good ? text.substr(kHead.size()) : "none";
}

}  // namespace

TEST_CASE("a file with an end mark stays as it is") {
  const std::string rows = kFirst + "1,end,,\"completed\"\n";
  CHECK(ended(rows) == rows);
  CHECK(ended("0,end,,\"failed: it refused\"\n") == "0,end,,\"failed: it refused\"\n");
}

TEST_CASE("a file without one ends where its last step begins") {
  const std::string mark = "0.75,end,,\"failed: \"\"killed\"\"\"\n";
  const std::string whole = kFirst + "0.75,,end,\"b\"\n";  // the step to 1 s ended early
  CHECK(ended(whole + "0.75,step,,1\n") == whole + mark);
  CHECK(ended(whole + "0.75,step,,1\n1,,end,\"c\"\n1,0,en") == whole + mark);
  CHECK(ended(whole + "0.75,step,,1\n1,,end,\"c\n1,end,,\"") == whole + mark);
}

TEST_CASE("nothing is left of a file without a step that is known to have ended") {
  CHECK(ended("") == "none");
  CHECK(ended(kFirst) == "none");
  CHECK(ended(kFirst + "1,,end,\"b\"\n") == "none");
}
