#include "master/observe/recorders/csv_recorder.h"

#include <limits>

#include <catch2/catch.hpp>

#include "master/base/error.h"
#include "tests/master/observe/recorders/recorder_support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;
using Catch::Contains;

TEST_CASE("signals.csv has a row for each communication point") {
  const TemporaryFolder folder;
  SampleRun run;
  CsvRecorder recorder(run.system, folder / "signals.csv");
  recorder.on_start(run.signals());
  run.set_first();
  recorder.on_communication_point(Time{});
  run.set_second();
  recorder.on_message(run.frame_at(milliseconds(1), false, 0));
  recorder.on_communication_point(milliseconds(1));
  recorder.on_finish();
  CHECK(content(folder / "signals.csv") ==
        "time,a.distance [m],a.led,a.frames.count,a.position[1] [m],a.position[2] [m],"
        "a.position[3] [m],a.label,a.digest,\"b, c.distance [m]\"\n"
        "0,0.1,false,0,1,-0.5,1e-09,\"a \"\"b\"\"\\\",0aff,0\n"
        "0.001,0.30000000000000004,true,-3,1,-0.5,1e-09,\"\",0aff,0\n");
}

TEST_CASE("Values that are not numbers are written, too") {
  const TemporaryFolder folder;
  SampleRun run;
  CsvRecorder recorder(run.system, folder / "signals.csv");
  recorder.on_start(std::vector<core::Signal>{{{0, 1}, &run.numbers, 3}});
  run.numbers.numbers<double>()[3] = std::numeric_limits<double>::quiet_NaN();
  recorder.on_communication_point(Time{});
  run.numbers.numbers<double>()[3] = -std::numeric_limits<double>::infinity();
  recorder.on_communication_point(milliseconds(1));
  recorder.on_finish();
  CHECK(content(folder / "signals.csv") == "time,a.distance [m]\n0,nan\n0.001,-inf\n");
}

TEST_CASE("A full disk ends the run with the simulated time") {
  SampleRun run;
  CsvRecorder recorder(run.system, "/dev/full");
  recorder.on_start(run.signals());
  const auto run_long = [&] {
    for (int i = 0; i < 10'000; ++i) recorder.on_communication_point(milliseconds(i));
  };
  CHECK_THROWS_WITH(run_long(),
                    Contains("/dev/full: at ") && Contains(" s: cannot write the file"));
  CHECK_NOTHROW(recorder.on_finish());
}

TEST_CASE("signals.csv goes on where it was") {
  const TemporaryFolder folder;
  ContinuedRecorder<CsvRecorder> recorder(folder / "signals.csv");
  const std::string whole = recorder.whole();
  CHECK(whole.size() > 70);
  CHECK(recorder.in_two_parts() == whole);
}
