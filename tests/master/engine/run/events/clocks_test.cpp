// Time-based clocks in a run: when they tick, and what is sampled at their ticks.
#include "master/engine/run/events/clocks.h"

#include <limits>

#include <catch2/catch.hpp>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "tests/master/engine/run/scripted_system.h"

using namespace stride;
using namespace stride::core;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

using State = ClockInterval::State;
using Ticks = std::vector<Time>;

constexpr Duration kStep = 10ms;

Interval every(Duration duration) { return Interval::from_duration(duration); }
ClockInterval changed(Duration duration) { return {State::Changed, every(duration)}; }

Ticks times(std::initializer_list<Duration> list) {
  Ticks ticks;
  for (const Duration duration : list) ticks.emplace_back(duration);
  return ticks;
}

/// Writes down at what time its clock 0 is set.
struct Watch {
  explicit Watch(ScriptedUnit& unit) {
    unit.on_step = [this](ScriptedUnit&, Time, Time to) {
      now = to;
      return reached(to);
    };
    unit.on_set_clock = [this](ScriptedUnit&) { ticks.push_back(now); };
  }
  Time now{};
  Ticks ticks;
};

/// A unit with a clock, an input and an output that belong to it, and an ordinary input and output.
auto sampler(const std::string& name, Duration interval, Duration shift = {}) {
  return Describe(name)
      .clock("tick", IntervalVariability::Constant, every(interval), every(shift))
      .input("in")
      .clocked_by(0)
      .output("out")
      .clocked_by(0)
      .input("u")
      .output("y")
      .done();
}
constexpr ValueReference kIn = 1, kOut = 2, kU = 3, kY = 4;

/// Its output is a function of its input, computed when it is read, if not loose before the first
/// tick.
struct Following : ScriptedUnit {
  using ScriptedUnit::ScriptedUnit;
  bool is_loose = false;
  void get(std::span<const ValueReference> references, ValueBlock& values) override {
    if (!is_loose || clock(0)) number(kOut) = number(kIn) + 1;
    ScriptedUnit::get(references, values);
  }
};

struct Recorded : Observer {
  std::vector<Time> points;
  std::vector<double> values;
  Signal signal{};
  void on_start(std::span<const Signal> signals) override { signal = signals[0]; }
  void on_communication_point(Time time) override {
    points.push_back(time);
    values.push_back(signal.block->numbers<double>()[signal.first]);
  }
};

}  // namespace

TEST_CASE("a constant clock ticks at start + shift + k intervals, each rounded by itself") {
  ScriptedSystem f;
  Watch watch(f.add("a", Describe("a")
                             .clock("tick", IntervalVariability::Constant,
                                    Interval::from_fraction(1, 3), Interval::from_fraction(1, 6))
                             .done()));
  f.build(1.5, kStep).run();
  const auto tick = [](std::int64_t picoseconds) { return Time(Duration(picoseconds)); };
  CHECK(watch.ticks == Ticks{tick(166'666'666'667), tick(500'000'000'000), tick(833'333'333'333),
                             tick(1'166'666'666'667), tick(1'500'000'000'000)});
}

TEST_CASE("a million ticks of a third of a millisecond do not drift") {
  ScriptedSystem f;
  std::uint64_t wrong = 0;
  std::uint64_t count = 0;
  Time now{};
  auto& a =
      f.add("a", Describe("a")
                     .clock("tick", IntervalVariability::Constant, Interval::from_fraction(1, 3000))
                     .done());
  a.on_step = [&](ScriptedUnit&, Time, Time to) { return reached(now = to); };
  a.on_set_clock = [&](ScriptedUnit&) {
    wrong += now != Time(Duration((count * 1'000'000'000 + 1) / 3));
    ++count;
    a.calls.clear();
  };
  f.build(1'000'000.0 / 3000, 1s).run();
  CHECK(count == 1'000'001);
  CHECK(wrong == 0);
}

TEST_CASE("clocks that go on from a state tick when those would have that wrote it") {
  ScriptedSystem f;
  const bool is_described = GENERATE(true, false);
  if (is_described) {
    f.add(
        "a",
        Describe("a").clock("tick", IntervalVariability::Constant, every(3ms), every(1ms)).done());
  } else {
    auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Fixed).done());
    a.on_clock_interval = [](ScriptedUnit&, ValueReference) {
      return ClockInterval{ClockInterval::State::Changed, every(3ms)};
    };
    a.on_clock_shift = [](ScriptedUnit&, ValueReference) { return every(1ms); };
  }
  const System system(f.declaration);
  Clocks clocks(system, f.units);
  const Time start(10ms);
  clocks.begin(start);
  const auto tick = [](Clocks& ticking, Time time) {
    ticking.due(time);
    ticking.tick(time);
    ticking.update(0, time);
    ticking.due(time);
  };
  tick(clocks, start + 1ms);
  StateArchive written;
  clocks.persist(written, start, start + 1ms);
  Clocks other(system, f.units);
  StateArchive read(written.bytes());
  other.persist(read, start, start + 1ms);
  read.end();
  CHECK(other.next() == start + 4ms);
  tick(clocks, start + 4ms);
  CHECK(other.next() == start + 4ms);
  tick(other, start + 4ms);
  CHECK(other.next() == clocks.next());
  CHECK(other.next() == start + 7ms);
  StateArchive early(written.bytes());
  CHECK_THROWS_AS(other.persist(early, start, start + 4ms), BadState);
}

TEST_CASE("a clock that ticks at once, and one that ticks at the end") {
  ScriptedSystem f;
  Watch watch(f.add("a", sampler("a", 4ms)));
  f.build(0.008, kStep).run();
  CHECK(watch.ticks == times({0ms, 4ms, 8ms}));
}

TEST_CASE("the interval and the shift of a fixed clock come from the unit, once") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Fixed).done());
  Watch watch(a);
  int asked = 0;
  a.on_clock_interval = [&](ScriptedUnit& unit, ValueReference) {
    CHECK(unit.calls.back() == "enter_initialization");
    ++asked;
    return changed(7ms);
  };
  a.on_clock_shift = [](ScriptedUnit&, ValueReference) { return every(1ms); };
  f.build(0.02, kStep).run();
  CHECK(watch.ticks == times({1ms, 8ms, 15ms}));
  CHECK(asked == 1);
}

TEST_CASE("an interval in the description is not queried") {
  ScriptedSystem f;
  const auto kind = GENERATE(IntervalVariability::Fixed, IntervalVariability::Tunable);
  auto& a = f.add("a", Describe("a").clock("tick", kind, every(8ms), every(2ms)).done());
  Watch watch(a);
  a.on_clock_interval = [](ScriptedUnit&, ValueReference) -> ClockInterval {
    throw std::logic_error("asked");
  };
  f.build(0.02, kStep).run();
  CHECK(watch.ticks == times({2ms, 10ms, 18ms}));
}

TEST_CASE("a tunable clock counts a new interval from the event in which it changed") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Tunable).done());
  Watch watch(a);
  a.on_clock_interval = [&](ScriptedUnit&, ValueReference) -> ClockInterval {
    if (watch.now == Time(5ms)) return changed(3ms);
    return {State::Unchanged, every(4ms)};
  };
  a.on_event = [&](ScriptedUnit&) {
    EventResult result;
    if (watch.now < Time(5ms)) result.next_event_time = Time(5ms);
    return result;
  };
  f.build(0.013, kStep).run();
  CHECK(watch.ticks == times({0ms, 4ms, 8ms, 11ms}));
}

TEST_CASE("a changing clock gives the next interval at each tick") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Changing).done());
  Watch watch(a);
  a.on_clock_interval = [&](ScriptedUnit&, ValueReference) {
    return changed(static_cast<int>(watch.ticks.size() + 1) * Duration(1ms));
  };
  f.build(0.02, kStep).run();
  CHECK(watch.ticks == times({1ms, 3ms, 6ms, 10ms, 15ms}));
}

namespace {

/// That of a clock of 30 ticks a second, as a unit may give it: as a fraction, as the double that
/// is nearest to it, as a decimal, or as the difference of two doubles.
Interval thirtieth(int way, std::size_t tick) {
  const auto number = static_cast<double>(tick);
  switch (way) {
    case 0:
      return Interval::from_fraction(1, 30);
    case 1:
      return Interval::from_seconds(1.0 / 30);
    case 2:
      return every(Duration(33'333'333'333));
    default:
      return Interval::from_seconds((number + 1) / 30 - number / 30);
  }
}

Ticks thirtieths(int first, int last) {
  Ticks ticks;
  for (int k = first; k <= last; ++k) {
    ticks.emplace_back(Duration((k * 1'000'000'000'000 + 15) / 30));
  }
  return ticks;
}

void count_thirtieths(ScriptedUnit& unit, const Watch& watch, int way) {
  unit.on_clock_interval = [&watch, way](ScriptedUnit&, ValueReference) {
    return ClockInterval{State::Changed, thirtieth(way, watch.ticks.size())};
  };
}

}  // namespace

TEST_CASE("clocks of one period tick together, however their intervals are given") {
  const auto kind = GENERATE(IntervalVariability::Changing, IntervalVariability::Countdown,
                             IntervalVariability::Tunable);
  const int way = GENERATE(0, 1, 2, 3);
  CAPTURE(name(kind), way);
  ScriptedSystem f;
  Watch constant(f.add(
      "constant", Describe("constant")
                      .clock("tick", IntervalVariability::Constant, Interval::from_fraction(1, 30))
                      .done()));
  auto& a = f.add("a", Describe("a").clock("tick", kind).done());
  Watch watch(a);
  count_thirtieths(a, watch, way);
  CHECK(points(f, 10, Interval(10s)).size() == 301);
  CHECK(constant.ticks == thirtieths(0, 300));
  CHECK(watch.ticks == thirtieths(kind == IntervalVariability::Tunable ? 0 : 1, 300));
}

TEST_CASE("a clock that counts 1/30 s again and again meets the steps of 1/30 s") {
  const int way = GENERATE(0, 1, 2, 3);
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Changing).done());
  Watch watch(a);
  count_thirtieths(a, watch, way);
  CHECK(points(f, 10, Interval::from_fraction(1, 30)).size() == 301);
  CHECK(watch.ticks == thirtieths(1, 300));
}

TEST_CASE("a changing clock by itself adds its intervals exactly") {
  const int way = GENERATE(0, 1);
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Changing).done());
  Watch watch(a);
  count_thirtieths(a, watch, way);
  f.build(10, 7s).run();
  CHECK(watch.ticks == thirtieths(1, 300));
}

TEST_CASE("a countdown of 0 after a tick that was made with another one is at the same instant") {
  ScriptedSystem f;
  f.add("constant",
        Describe("constant")
            .clock("tick", IntervalVariability::Constant, Interval::from_fraction(1, 30))
            .done());
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Countdown).done());
  Watch watch(a);
  a.on_clock_interval = [&](ScriptedUnit&, ValueReference) {
    return watch.ticks.size() % 2 == 1 ? changed(0ms) : changed(Duration(33'333'333'333));
  };
  CHECK(points(f, 10, Interval(10s)).size() == 301);
  CHECK(watch.ticks.size() == 600);
}

TEST_CASE("short intervals are not merged with anything") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Changing).done());
  Watch watch(a);
  a.on_clock_interval = [](ScriptedUnit&, ValueReference) { return changed(Duration(3)); };
  f.build(20e-12, Duration(4)).run();
  CHECK(watch.ticks ==
        times({Duration(3), Duration(6), Duration(9), Duration(12), Duration(15), Duration(18)}));
}

TEST_CASE("a changing clock goes on from a state with the fraction of its last tick") {
  ScriptedSystem f;
  f.add("a", Describe("a").clock("tick", IntervalVariability::Changing).done()).on_clock_interval =
      [](ScriptedUnit&, ValueReference) {
        return ClockInterval{State::Changed, Interval::from_fraction(1, 3)};
      };
  const System system(f.declaration);
  Clocks clocks(system, f.units);
  clocks.begin(Time());
  const auto tick = [](Clocks& ticking) {
    const Time now = *ticking.next();
    ticking.due(now);
    ticking.tick(now);
    ticking.update(0, now);
    ticking.due(now);
    return now;
  };
  StateArchive written;
  const Time now = tick(clocks);
  clocks.persist(written, Time(), now);
  Clocks other(system, f.units);
  StateArchive read(written.bytes());
  other.persist(read, Time(), now);
  read.end();
  CHECK(other.next() == Time(Duration(666'666'666'667)));
  tick(other);
  CHECK(other.next() == Time(1s));
}

TEST_CASE("the interval of a countdown clock is queried at every event, until it is known") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Countdown).done());
  Watch watch(a);
  int asked = 0;
  a.on_event = [&](ScriptedUnit&) {
    EventResult result;
    for (const Time event : {Time(3ms), Time(5ms), Time(15ms)}) {
      if (watch.now < event && !result.next_event_time) result.next_event_time = event;
    }
    return result;
  };
  a.on_clock_interval = [&](ScriptedUnit&, ValueReference) -> ClockInterval {
    ++asked;
    if (watch.now == Time(3ms)) return changed(10ms);
    if (watch.now == Time(5ms)) return changed(4ms);  // in the place of the other
    if (watch.now == Time(15ms)) return changed(1ms);
    return {watch.now < Time(5ms) ? State::NotYetKnown : State::Unchanged, every(4ms)};
  };
  f.build(0.02, kStep).run();
  CHECK(watch.ticks == times({9ms, 16ms}));
  CHECK(asked == 7);  // before the start, at the start, at 3, 5, 9, 15 and 16 ms
}

TEST_CASE("a countdown of 0 is another super-dense instant of the same time") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Countdown).done());
  Watch watch(a);
  a.on_clock_interval = [&](ScriptedUnit&, ValueReference) -> ClockInterval {
    if (watch.ticks.empty()) return changed(2ms);
    return watch.ticks.size() < 3 ? changed(0ms) : ClockInterval{};
  };
  f.build(0.005, kStep).run();
  CHECK(watch.ticks == times({2ms, 2ms, 2ms}));
}

TEST_CASE("a clock that never ends its instant is an error that names the unit") {
  ScriptedSystem f;
  auto& a = f.add("a", Describe("a").clock("tick", IntervalVariability::Countdown).done());
  a.on_clock_interval = [](ScriptedUnit&, ValueReference) { return changed(0ms); };
  CHECK_THAT(failure(f.build(1, kStep)), Contains("1000 event iterations") && Contains("'a'"));
}

TEST_CASE("intervals that cannot be name unit, clock and time") {
  const auto reason = [](IntervalVariability kind, ClockInterval said) {
    ScriptedSystem f;
    f.add("a", Describe("a").clock("tick", kind).done()).on_clock_interval =
        [said](ScriptedUnit&, ValueReference) { return said; };
    return failure(f.build(1, kStep));
  };
  CHECK_THAT(reason(IntervalVariability::Fixed, changed(0ms)),
             Contains("unit 'a', variable 'tick', at 0 s") && Contains("interval is 0 s") &&
                 Contains("a fixed one"));
  CHECK_THAT(reason(IntervalVariability::Tunable, {State::Changed, Interval::from_seconds(1e-13)}),
             Contains("interval is 1e-13 s"));
  CHECK_THAT(reason(IntervalVariability::Changing, {}),
             Contains("unit 'a', variable 'tick', at 0 s") && Contains("does not know"));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(reason(IntervalVariability::Countdown,
               {State::Changed, Interval::from_seconds(infinity)}) == "none");
}

TEST_CASE("ticks that fall on other events and on each other are all there") {
  ScriptedSystem f;
  auto& a = f.add("a", sampler("a", 2ms));
  auto& b = f.add("b", sampler("b", 3ms));
  Watch on_a(a);
  Watch on_b(b);
  int events = 0;
  a.on_event = [&](ScriptedUnit&) {
    ++events;
    EventResult result;
    result.next_event_time = on_a.now + 1ms;
    return result;
  };
  f.build(0.006, 1500us).run();
  CHECK(on_a.ticks == times({0ms, 2ms, 4ms, 6ms}));
  CHECK(on_b.ticks == times({0ms, 3ms, 6ms}));
  CHECK(events == 7);
}

TEST_CASE("a step that is redone makes no tick twice and loses none") {
  ScriptedSystem f;
  auto a = Describe("a").clock("tick", IntervalVariability::Constant, every(5ms)).can_save_state();
  Watch watch(f.add("a", a.done()));
  auto& b = f.add("b", Describe("b").may_return_early().can_save_state().done());
  b.on_step = [](ScriptedUnit&, Time from, Time to) {
    const bool stops = from < Time(3ms) && to > Time(3ms);
    StepResult result = reached(stops ? Time(3ms) : to);
    result.early_return = stops;
    return result;
  };
  Simulation& simulation = f.build(0.012, kStep);
  simulation.run();
  CHECK(watch.ticks == times({0ms, 5ms, 10ms}));
  CHECK(simulation.statistics().units[0].rollbacks == 1);
}

TEST_CASE("the clocked inputs are set and the clocked outputs read while the clock ticks") {
  ScriptedSystem f;
  auto& source = f.add("source", Describe("source").output("y").done());
  auto& a = f.add("a", sampler("a", 4ms, 1ms));
  auto& sink = f.add("sink", Describe("sink").input("u").event_mode().done());
  f.wire("source", "y", "a", "in");
  f.wire("a", "out", "sink", "u");
  source.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(0) = 1000 * to_seconds(to);
    return reached(to);
  };
  // the output has its value for as long as the clock ticks, and is nonsense otherwise
  a.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(kOut) = -1;
    return reached(to);
  };
  a.on_set_clock = [](ScriptedUnit& unit) { unit.number(kOut) = 10; };
  std::vector<double> in;
  a.on_event = [&](ScriptedUnit& unit) {
    if (unit.clock(0)) in.push_back(unit.number(kIn));
    unit.number(kOut) = -2;
    return EventResult{};
  };
  Recorded recorded;
  f.build(0.006, 1ms, {{1, kOut}}).add_observer(recorded);
  f.simulation->run();
  CHECK(in == std::vector<double>{1, 5});
  CHECK(recorded.values == std::vector<double>{0, 10, 10, 10, 10, 10, 10});
  CHECK(sink.number(0) == 10);
}

TEST_CASE("a time-based clock that is connected to a triggered one sends messages at its ticks") {
  ScriptedSystem f;
  auto& b = f.add("b", Describe("b")
                           .add("rx", ValueType::Clock, Causality::Input)
                           .input("in")
                           .clocked_by(0)
                           .done());  // is before its source
  auto& a = f.add("a", sampler("a", 4ms, 1ms));
  f.wire("a", "tick", "b", "rx");
  f.wire("a", "out", "b", "in");
  a.on_set_clock = [count = 0](ScriptedUnit& unit) mutable { unit.number(kOut) = ++count; };
  std::vector<double> seen;
  b.on_event = [&](ScriptedUnit& unit) {
    if (unit.clock(0)) seen.push_back(unit.number(1));
    return EventResult{};
  };
  f.build(0.009, 2ms).run();
  CHECK(seen == std::vector<double>{1, 2, 3});  // at 1, 5 and 9 ms
  const RunStatistics& statistics = f.simulation->statistics();
  CHECK(statistics.units[1].messages_sent == 3);
  CHECK(statistics.units[0].messages_received == 3);
}

TEST_CASE("a tick and the message that it causes are one super-dense instant") {
  ScriptedSystem f;
  auto& b = f.add("b", Describe("b")
                           .add("rx", ValueType::Clock, Causality::Input)
                           .input("in")
                           .clocked_by(0)
                           .clock("tx", IntervalVariability::Countdown)
                           .output("out")
                           .clocked_by(2)
                           .done());
  auto& a = f.add("a", Describe("a")
                           .clock("tx", IntervalVariability::Constant, every(4ms), every(1ms))
                           .output("out")
                           .clocked_by(0)
                           .add("rx", ValueType::Clock, Causality::Input)
                           .input("in")
                           .clocked_by(2)
                           .done());
  f.wire("a", "tx", "b", "rx");
  f.wire("a", "out", "b", "in");
  f.wire("b", "tx", "a", "rx");
  f.wire("b", "out", "a", "in");
  // b answers at once, by a countdown of 0
  bool has_received = false;
  b.on_event = [&](ScriptedUnit& unit) {
    has_received = unit.clock(0);
    if (has_received) unit.number(3) = unit.number(1) + 100;
    return EventResult{};
  };
  b.on_clock_interval = [&](ScriptedUnit&, ValueReference) {
    return has_received ? changed(0ms) : ClockInterval{};
  };
  a.on_set_clock = [](ScriptedUnit& unit) {
    if (unit.clock(0)) unit.number(1) += 1;
  };
  std::vector<double> answers;
  a.on_event = [&](ScriptedUnit& unit) {
    if (unit.clock(2)) answers.push_back(unit.number(3));
    return EventResult{};
  };
  f.build(0.006, kStep).run();
  CHECK(answers == std::vector<double>{101, 102});
}

TEST_CASE("a sampled and held value is an event for its receiver") {
  ScriptedSystem f;
  auto& a = f.add("a", sampler("a", 4ms));
  auto& sink = f.add("sink", Describe("sink").input("u").event_mode().done());
  f.wire("a", "out", "sink", "u");
  a.on_set_clock = [count = 0](ScriptedUnit& unit) mutable { unit.number(kOut) = ++count; };
  std::vector<std::string> seen;
  sink.on_step = [&](ScriptedUnit& unit, Time, Time to) {
    seen.push_back(to_text(to) + ":" + std::to_string(static_cast<int>(unit.number(0))));
    return reached(to);
  };
  sink.on_event = [&](ScriptedUnit& unit) {
    seen.push_back("event:" + std::to_string(static_cast<int>(unit.number(0))));
    return EventResult{};
  };
  f.build(0.006, 2ms).run();
  CHECK(seen ==
        std::vector<std::string>{"event:0", "event:1", "0.002:1", "0.004:1", "event:2", "0.006:2"});
}

TEST_CASE("values from clock to clock: of this instant where both tick, else the last") {
  ScriptedSystem f;
  auto& b = f.add("b", sampler("b", 3ms));  // is before its source
  auto& a = f.add("a", sampler("a", 2ms));
  f.wire("a", "out", "b", "in");
  a.on_set_clock = [count = 0](ScriptedUnit& unit) mutable { unit.number(kOut) = ++count; };
  std::vector<double> seen;
  b.on_event = [&](ScriptedUnit& unit) {
    if (unit.clock(0)) seen.push_back(unit.number(kIn));
    return EventResult{};
  };
  f.build(0.009, kStep).run();
  CHECK(seen == std::vector<double>{1, 2, 4, 5});  // at 0, 3, 6 and 9 ms
}

TEST_CASE("a chain of clocks that tick together has no delay") {
  ScriptedSystem f;
  auto& c = f.add<Following>("c", sampler("c", 2ms));
  f.add<Following>("b", sampler("b", 2ms));
  f.add<Following>("a", sampler("a", 2ms));
  f.wire("a", "out", "b", "in");
  f.wire("b", "out", "c", "in");
  std::vector<double> seen;
  c.on_event = [&](ScriptedUnit& unit) {
    if (unit.clock(0)) seen.push_back(unit.number(kIn));
    return EventResult{};
  };
  f.build(0.003, kStep).run();
  CHECK(seen == std::vector<double>{2, 2});
}

TEST_CASE("a loop of values that are sampled at one instant is an error that names them") {
  ScriptedSystem f;
  auto& a = f.add<Following>("a", sampler("a", 2ms, 1ms));
  auto& b = f.add<Following>("b", sampler("b", 2ms, 1ms));
  f.wire("a", "out", "b", "in");
  f.wire("b", "out", "a", "in");
  a.is_loose = b.is_loose = true;  // until the clocks tick
  CHECK_THAT(failure(f.build(1, kStep)),
             Contains("at 0.001 s") && Contains("algebraic loop") && Contains("'a.in', 'b.in'"));
}

TEST_CASE("sampled values may also be recorded where they go in: as they were at the tick") {
  ScriptedSystem f;
  auto& source = f.add("source", Describe("source").output("y").done());
  f.add("a", sampler("a", 2ms));
  f.wire("source", "y", "a", "in");
  source.on_step = [](ScriptedUnit& unit, Time, Time to) {
    unit.number(0) = 1000 * to_seconds(to);
    return reached(to);
  };
  Recorded recorded;
  f.build(0.004, 1ms, {{1, kIn}}).add_observer(recorded);
  f.simulation->run();
  CHECK(recorded.values == std::vector<double>{0, 0, 2, 2, 4});
}
