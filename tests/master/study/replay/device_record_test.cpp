#include "master/study/replay/device_record.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/base/archive/support.h"
#include "tests/master/engine/run/scripted_unit.h"

using namespace stride;
using namespace stride::replay;
using Catch::Contains;
using core::Causality;
using core::ValueType;
using stride::tests::error_of;
using stride::tests::Scratch;

namespace {

core::Variable output(const std::string& name, core::ValueReference reference, ValueType type) {
  return core::make_variable(name, reference, type, Causality::Output);
}

/// With a real output that has a unit of measure, an array, a text, a message and a bare clock.
core::UnitDescription device() {
  core::Variable power = output("power", 0, ValueType::Float64);
  power.unit = "W";
  core::Variable pair = output("pair", 1, ValueType::Int32);
  pair.dimensions = {2};
  pair.size = 2;
  core::Variable frame = output("frame", 4, ValueType::Binary);
  frame.clocks = {3};
  core::UnitDescription description;
  description.variables = {power,
                           pair,
                           output("text", 2, ValueType::String),
                           output("clock", 3, ValueType::Clock),
                           frame,
                           output("bell", 5, ValueType::Clock),
                           core::make_variable("input", 6, ValueType::Float64, Causality::Input)};
  return description;
}

const std::string kSignals =
    "time,a.input,a.power [W],a.pair[1],a.pair[2],a.text,b.power [W]\n"
    "0,9,1,2,3,\"x\",9\n0.5,9,1.5,2,3,\"x\",9\n0.5,9,2,2,3,\"y\",9\n1,9,2.5,4,5,\"say "
    "\"\"z\"\"\",9\n";
const std::string kEvents =
    "time,index,component,variable,direction,payload,content\n"
    "0.5,0,a,frame,sent,00ff,\n0.5,0,b,frame,sent,01,\n0.5,1,a,bell,sent,,\n"
    "0.75,0,a,frame,received,02,\n";

DeviceRecord record(const std::string& signals = kSignals, const std::string& events = kEvents) {
  const Scratch scratch;
  scratch.write("signals.csv", signals);
  scratch.write("events.csv", events);
  return read_device_record(scratch / "signals.csv", scratch / "events.csv", "a", device());
}

StimuliSummary stimuli() {
  StimuliSummary made;
  made.instants = {"0", "0.5", "1"};
  made.event_instants = {"0.5"};
  made.end = "1";
  return made;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string difference(const DeviceRecord& run, const StimuliSummary& at = stimuli()) {
  return first_difference(run, record(), at).value_or("none");
}

}  // namespace

TEST_CASE("a record has the outputs of one component, and what it has sent") {
  const DeviceRecord found = record();
  CHECK(found.outputs == std::vector<std::string>{"power", "pair[1]", "pair[2]", "text"});
  CHECK(found.times == std::vector<std::string>{"0", "0.5", "1"});
  CHECK(found.values.at("0.5") == std::vector<std::string>{"2", "2", "3", "y"});
  REQUIRE(found.sent.size() == 2);
  CHECK(found.sent[0] == DeviceRecord::Message{"0.5", "0", "frame", "00ff"});
  CHECK(read_device_record({}, {}, "a", device()).outputs.empty());
  CHECK_THAT(error_of([] { record(kSignals + "2,1\n"); }),
             Contains("signals.csv:6: this row has another number of fields"));
  CHECK_THAT(error_of([] { record(kSignals, kEvents + "2,1\n"); }),
             Contains("events.csv:6: this is no row of messages"));
}

TEST_CASE("a difference is found where the unit was called, in all that both have") {
  CHECK(difference(record()) == "none");
  CHECK(difference(record(with(kSignals, "\n1,9,2.5", "\n1,9,2.25"))) ==
        "power at 1 s, 2.5 and not 2.25");
  CHECK(difference(record(with(kSignals, "\n0.5,9,1.5", "\n0.5,9,7"))) == "none");
  CHECK(difference(record(with(kSignals, "\n1,9,", "\n1,8,"))) == "none");
  StimuliSummary skips = stimuli();
  skips.max_skip = "1";
  CHECK(difference(record(with(kSignals, "\n1,9,2.5", "\n1,9,2.25")), skips) == "none");
  CHECK(difference(record(with(kSignals, "\"y\"", "\"z\"")), skips) ==
        "text at 0.5 s, y and not z");
  CHECK(difference(record("time,a.text\n0.5,\"y\"\n")) == "none");
  CHECK(difference(record("time\n0.5\n")) == "none");
}

TEST_CASE("a message more, less or other is a difference") {
  CHECK(difference(record(kSignals, with(kEvents, "00ff", "00fe"))) ==
        "the message of frame at 0.5 s");
  CHECK(difference(record(kSignals, kEvents + "1,0,a,bell,sent,,\n")) ==
        "the message of bell at 1 s");
  CHECK(difference(record(kSignals, kEvents + "1.25,0,a,bell,sent,,\n")) == "none");
  CHECK(difference(record(kSignals, with(kEvents, "0.5,1,a,bell,sent,,\n", ""))) ==
        "the message of bell at 0.5 s");
}

TEST_CASE("expected is what there is at the end, and how many messages") {
  const auto made = expectations_of(record(), device(), "0.1");
  std::string text;
  for (const Expectation& one : made) {
    text +=
        one.output + "=" + one.equals + (one.tolerance.empty() ? "" : "~" + one.tolerance) + " ";
  }
  CHECK(text == "power=2.5~0.1 pair[1]=4 pair[2]=5 text=say \"z\" frame=1 bell=1 ");
  CHECK(made[4].kind == Expectation::Kind::Count);
}

TEST_CASE("what no check can have is not expected") {
  for (const std::string odd : {"nan", "inf", "-inf"}) {
    const auto made =
        expectations_of(record(with(kSignals, "\n1,9,2.5,", "\n1,9," + odd + ",")), device(), "");
    CHECK(made.front().output == "pair[1]");
  }
  const auto made =
      expectations_of(record(with(kSignals, "\"say \"\"z\"\"\"", "\"a\nb\"")), device(), "");
  CHECK(made.size() == 5);
}
