#include "master/observe/recorders/activity_recorder.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/recorders/recorder_support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;
using Kind = core::Activity::Kind;

TEST_CASE("activity.csv has a row for each activity, with exact times") {
  const TemporaryFolder folder;
  const SampleRun run;
  ActivityRecorder recorder(run.system, folder / "activity.csv");
  CHECK(recorder.watches_activities());
  recorder.on_start({});
  recorder.on_activity({1, Kind::Idle, Time{}, Time(Duration(14'200'000'000'001))});
  recorder.on_activity({0, Kind::Event, milliseconds(1), milliseconds(1)});
  recorder.on_activity({0, Kind::EarlyReturn, milliseconds(1), milliseconds(2)});
  recorder.on_activity({0, Kind::Rejection, milliseconds(2), milliseconds(3)});
  recorder.on_activity({0, Kind::Undone, milliseconds(2), milliseconds(3)});
  recorder.on_finish();
  CHECK(content(folder / "activity.csv") ==
        "time,until,component,kind\n"
        "0,14.200000000001,\"b, c\",idle\n"
        "0.001,0.001,a,event\n"
        "0.001,0.002,a,early return\n"
        "0.002,0.003,a,rejection\n"
        "0.002,0.003,a,undone\n");
}

TEST_CASE("activity.csv of a run without any has its header") {
  const TemporaryFolder folder;
  const SampleRun run;
  ActivityRecorder recorder(run.system, folder / "activity.csv");
  recorder.on_start({});
  recorder.on_finish();
  CHECK(content(folder / "activity.csv") == "time,until,component,kind\n");
}

TEST_CASE("activity.csv goes on where it was") {
  const TemporaryFolder folder;
  ContinuedRecorder<ActivityRecorder> recorder(folder / "activity.csv");
  const std::string whole = recorder.whole();
  CHECK(whole.size() > 70);
  CHECK(recorder.in_two_parts() == whole);
}
