#include "master/observe/recorders/event_recorder.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/recorders/recorder_support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;

TEST_CASE("events.csv has a row for each message sent or received") {
  const TemporaryFolder folder;
  SampleRun run;
  EventRecorder recorder(run.system, folder / "events.csv");
  recorder.on_start({});
  recorder.on_message(run.tick_at(Time{}));
  run.frame.binaries()[0] = {0x26, 0x00, 0xf1};
  core::Message told = run.frame_at(Time(Duration(14'200'000'000'001)), false, 0);
  told.content = "wake_up, \"now\"";
  recorder.on_message(told);
  recorder.on_message(run.frame_at(Time(Duration(14'200'000'000'001)), true, 1, 2));
  recorder.on_communication_point(milliseconds(15'000));
  recorder.on_finish();
  CHECK(content(folder / "events.csv") ==
        "time,index,component,variable,direction,payload,content\n"
        "0,0,a,tick,sent,,\n"
        "14.200000000001,0,a,transmit.frame,sent,2600f1,\"wake_up, \"\"now\"\"\"\n"
        "14.200000000001,2,\"b, c\",transmit.frame,received,2600f1,\n");
  CHECK(recorder.wants_content());
}

TEST_CASE("The elements of a clocked array are separated by blanks, and text is quoted") {
  core::SystemDeclaration declaration;
  auto description = sample_description();
  description->variables[4].clocks = {7};
  description->variables[5].clocks = {7};
  description->variables[5].size = 2;
  description->variables[5].dimensions = {2};
  declaration.components = {{"a", description, {}, {}}};
  const core::System system(declaration);
  const TemporaryFolder folder;
  SampleRun run;
  run.set_first();
  core::ValueBlock labels(core::ValueType::String, 2);
  labels.strings()[0] = "one, two";
  labels.strings()[1] = "three";
  EventRecorder recorder(system, folder / "events.csv");
  recorder.on_start({});
  recorder.on_message({Time{}, 0, {0, 4}, false, &run.numbers, 0});
  recorder.on_message({Time{}, 0, {0, 5}, false, &labels, 0});
  recorder.on_finish();
  CHECK(content(folder / "events.csv") ==
        "time,index,component,variable,direction,payload,content\n"
        "0,0,a,position,sent,1 -0.5 1e-09,\n"
        "0,0,a,label,sent,\"one, two three\",\n");
}

TEST_CASE("events.csv goes on where it was") {
  const TemporaryFolder folder;
  ContinuedRecorder<EventRecorder> recorder(folder / "events.csv");
  const std::string whole = recorder.whole();
  CHECK(whole.size() > 70);
  CHECK(recorder.in_two_parts() == whole);
}
