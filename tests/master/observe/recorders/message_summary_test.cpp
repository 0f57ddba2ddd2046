#include "master/observe/recorders/message_summary.h"

#include <catch2/catch.hpp>

#include "tests/master/observe/recorders/recorder_support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;

TEST_CASE("a message in its component's words") {
  SampleRun run;
  core::Message message = run.frame_at(Time{}, false, 0);
  message.content = "set_led 1";
  CHECK(message_summary(run.system, message, 48) == "set_led 1");
  CHECK(message_summary(run.system, message, 5) == "set_…");
}

TEST_CASE("a message without words") {
  SampleRun run;
  run.set_first();
  CHECK(message_summary(run.system, run.frame_at(Time{}, false, 0), 48) == "0 bytes");
  run.frame.binaries()[0] = {1};
  CHECK(message_summary(run.system, run.frame_at(Time{}, false, 0), 48) == "1 byte");
  CHECK(message_summary(run.system, run.tick_at(Time{}), 48) == "");
  CHECK(message_summary(run.system, {Time{}, 0, {0, 5}, false, &run.label, 0}, 48) == "a \"b\"\\");
  CHECK(message_summary(run.system, {Time{}, 0, {0, 2}, false, &run.led, 0}, 48) == "false");
  CHECK(message_summary(run.system, {Time{}, 0, {0, 4}, false, &run.numbers, 0}, 48) ==
        "1, -0.5, 1e-09 m");
  CHECK(message_summary(run.system, {Time{}, 0, {0, 1}, false, &run.numbers, 3}, 48) == "0.1 m");
}

TEST_CASE("a text is one line of so many characters") {
  SampleRun run;
  run.label.strings()[0] = "first\nsecond " + std::string(1000, 'x');
  CHECK(message_summary(run.system, {Time{}, 0, {0, 5}, false, &run.label, 0}, 16) ==
        "first second xx…");
}
