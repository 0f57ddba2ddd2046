#include "master/observe/recorders/vcd_recorder.h"

#include <cstdlib>
#include <limits>

#include <catch2/catch.hpp>

#include "tests/master/observe/recorders/recorder_support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;
using Catch::Contains;

namespace {

void record(const std::filesystem::path& file) {
  SampleRun run;
  VcdRecorder recorder(run.system, file);
  recorder.on_start(run.signals());
  run.set_first();
  recorder.on_message(run.tick_at(Time{}));
  recorder.on_communication_point(Time{});
  run.frame.binaries()[0] = {0x26, 0xf1};
  recorder.on_message(run.frame_at(Time(Duration(999'999'999)), false, 0));
  recorder.on_message(run.frame_at(Time(Duration(999'999'999)), true, 1));
  run.set_second();
  recorder.on_communication_point(milliseconds(1));
  recorder.on_communication_point(milliseconds(2));  // nothing changes
  recorder.on_communication_point(milliseconds(3));
  recorder.on_finish();
}

const std::string kTrace = R"($version stride $end
$timescale 1 ps $end
$scope module a $end
$var real 64 ! distance $end
$var wire 1 " led $end
$var real 64 $ position[1] $end
$var real 64 % position[2] $end
$var real 64 & position[3] $end
$var string 1 ' label $end
$var string 1 ( digest $end
$var event 1 , tick $end
$scope module frames $end
$var integer 32 # count $end
$upscope $end
$scope module transmit $end
$var event 1 * clock $end
$var string 1 + frame $end
$upscope $end
$upscope $end
$scope module b,_c $end
$var real 64 ) distance $end
$var event 1 / tick $end
$scope module transmit $end
$var event 1 - clock $end
$var string 1 . frame $end
$upscope $end
$upscope $end
$enddefinitions $end
#0
1,
$dumpvars
r0.1 !
0"
b0 #
r1 $
r-0.5 %
r1e-09 &
sa\040"b"\134 '
s0aff (
r0 )
$end
#999999999
s26f1 +
1*
s26f1 .
1-
#1000000000
r0.30000000000000004 !
1"
b11111111111111111111111111111101 #
s '
#3000000000
)";

}  // namespace

TEST_CASE("signals.vcd holds changes only, and each message at its exact time") {
  const TemporaryFolder folder;
  record(folder / "signals.vcd");
  CHECK(content(folder / "signals.vcd") == kTrace);
}

TEST_CASE("GTKWave's reader takes the trace, and finds every change in it") {
  if (std::system("command -v vcd2fst fst2vcd > /dev/null") != 0) {
    WARN("vcd2fst is not installed (Debian: gtkwave), so the trace is not checked with it");
    REQUIRE(std::getenv("CI") == nullptr);
    return;
  }
  const TemporaryFolder folder;
  record(folder / "signals.vcd");
  const std::string command = "cd '" + (folder / "").string() +
                              "' && vcd2fst signals.vcd signals.fst > log 2>&1"
                              " && fst2vcd signals.fst > back.vcd 2>> log";
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(content(folder / "log").empty());
  const std::string back = content(folder / "back.vcd");
  for (const char* expected :
       {"1ps", "$scope module transmit", "#999999999\n", "s26f1 ", "r1e-09 ",
        "b11111111111111111111111111111101 ", "sa\\040\\\"b\\\"\\\\ ", "#3000000000"}) {
    CHECK_THAT(back, Contains(expected));
  }
}

TEST_CASE("time stamps begin at 0 where the run begins before it") {
  const TemporaryFolder folder;
  SampleRun run;
  VcdRecorder recorder(run.system, folder / "x.vcd");
  recorder.on_start(std::vector<core::Signal>{{{0, 1}, &run.numbers, 3}});
  recorder.on_communication_point(Time(-std::chrono::milliseconds(1)));
  run.numbers.numbers<double>()[3] = 1;
  recorder.on_communication_point(milliseconds(1));
  recorder.on_finish();
  CHECK_THAT(content(folder / "x.vcd"),
             Contains("$timezero -1000000000 $end\n$enddefinitions $end\n#0\n") &&
                 Catch::EndsWith("#2000000000\nr1 !\n"));
}

TEST_CASE("A value that is not a number changes once") {
  const TemporaryFolder folder;
  SampleRun run;
  VcdRecorder recorder(run.system, folder / "x.vcd");
  recorder.on_start(std::vector<core::Signal>{{{0, 1}, &run.numbers, 3}});
  run.numbers.numbers<double>()[3] = std::numeric_limits<double>::quiet_NaN();
  recorder.on_communication_point(Time{});
  recorder.on_communication_point(milliseconds(1));
  recorder.on_finish();
  CHECK_THAT(content(folder / "x.vcd"),
             Catch::EndsWith("#0\n$dumpvars\nrnan !\n$end\n#1000000000\n"));
}

TEST_CASE("There are more codes than printable characters") {
  const TemporaryFolder folder;
  core::SystemDeclaration declaration;
  auto description = sample_description();
  description->variables[4].dimensions = {20, 500};
  description->variables[4].size = 10'000;
  declaration.components = {{"a", description, {}, {}}};
  const core::System system(declaration);
  const core::ValueBlock block(core::ValueType::Float64, 10'000);
  VcdRecorder recorder(system, folder / "x.vcd");
  recorder.on_start(std::vector<core::Signal>{{{0, 4}, &block, 0}});
  recorder.on_finish();
  const std::string text = content(folder / "x.vcd");
  CHECK_THAT(text, Contains("$var real 64 ! position[1,1] $end"));
  CHECK_THAT(text, Contains("$var real 64 !\" position[1,95] $end"));  // 94 = 0 + 1 * 94
  CHECK_THAT(text, Contains("position[20,500] $end"));
}

TEST_CASE("A dot at an end of a name opens no scope") {
  const TemporaryFolder folder;
  OutputFile file(folder / "x");
  VcdScope top;
  top.scope("u").add(".a", core::ValueType::Boolean, "!");
  top.scope("u").add("b.", core::ValueType::UInt16, "\"");
  top.scope("u").add("c.d e", core::ValueType::Int8, "#");
  top.write(file);
  file.close();
  CHECK(content(folder / "x") ==
        "$scope module u $end\n$var wire 1 ! .a $end\n$var wire 16 \" b. $end\n"
        "$scope module c $end\n$var integer 8 # d_e $end\n$upscope $end\n$upscope $end\n");
}

TEST_CASE("What is sampled at the ticks of a time-based clock is declared once, the clock is not") {
  const TemporaryFolder folder;
  const core::System system = sampled_system();
  const core::ValueBlock value(core::ValueType::Float64, 1);
  const core::Signal signal{{0, 2}, &value, 0};
  VcdRecorder recorder(system, folder / "s.vcd");
  recorder.on_start(std::span(&signal, 1));
  recorder.on_finish();
  const std::string text = content(folder / "s.vcd");
  CHECK_THAT(text, Contains("$var real 64 ! y $end"));
  CHECK(text.find("$var", text.find("$var") + 1) == std::string::npos);
}

TEST_CASE("signals.vcd goes on where it was") {
  const TemporaryFolder folder;
  ContinuedRecorder<VcdRecorder> recorder(folder / "signals.vcd");
  const std::string whole = recorder.whole();
  CHECK(whole.size() > 70);
  CHECK(recorder.in_two_parts() == whole);
}
