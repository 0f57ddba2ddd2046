#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/device.h>
#include <stride/systemc/time.h>
#include <stride/systemc/timer.h>

#include "tests/units/systemc/times.h"

using Catch::Matchers::Contains;
using stride::Duration;
using stride::Time;
using stride::systemc::current_time;
using stride::systemc::Device;
using stride::systemc::Timer;

namespace {

using stride::tests::at;
using stride::tests::kMicrosecond;

/// Three timers, an event that is notified the usual way, and the order in which they go off.
class Alarms : public sc_core::sc_module {
 public:
  struct Mark {
    int which;
    Time when;
    bool operator==(const Mark& other) const { return which == other.which && when == other.when; }
  };

  Timer first{"first"};
  Timer second{"second"};
  Timer third{"third"};
  sc_core::sc_event usual{"usual"};
  std::vector<Mark> marks;
  std::vector<sc_dt::uint64> deltas;  ///< before the mark, at its instant

  explicit Alarms(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Alarms);
    // not in the order of the timers
    SC_METHOD(on_third);
    sensitive << third.event();
    dont_initialize();
    SC_METHOD(on_first);
    sensitive << first.event();
    dont_initialize();
    SC_METHOD(on_second);
    sensitive << second.event();
    dont_initialize();
    SC_METHOD(on_usual);
    sensitive << usual;
    dont_initialize();
  }

 private:
  void mark(int which) {
    marks.push_back({which, current_time()});
    deltas.push_back(sc_core::sc_delta_count_at_current_time());
  }
  void on_first() { mark(1); }
  void on_second() { mark(2); }
  void on_third() { mark(3); }
  void on_usual() { mark(0); }
};

using Marks = std::vector<Alarms::Mark>;

struct Bench {
  Device<Alarms> device{stride::systemc::Kernel::Log{}, "alarms"};

  template <class Function>
  void with(Function f) {
    device.within(f);
  }
  Marks marks() {
    return device.within([](Alarms& alarms) { return alarms.marks; });
  }
};

}  // namespace

TEST_CASE("a timer goes off at its instant, once") {
  Bench bench;
  bench.with([](Alarms& a) { a.first.set(at(3 * kMicrosecond)); });
  bench.device.advance(at(3 * kMicrosecond - Duration(1)));
  CHECK(bench.marks().empty());
  bench.with([](Alarms& a) { CHECK(a.first.due() == at(3 * kMicrosecond)); });
  bench.device.advance(at(9 * kMicrosecond));
  CHECK(bench.marks() == Marks{{1, at(3 * kMicrosecond)}});
  bench.with([](Alarms& a) { CHECK_FALSE(a.first.due()); });
}

TEST_CASE("a timer that is set for ever never goes off") {
  Bench bench;
  bench.device.advance(at(kMicrosecond));
  bench.with([](Alarms& a) {
    a.first.set(Time::max());
    a.second.set_after(Duration::max());
    CHECK(a.second.due() == Time::max());
  });
  bench.device.advance(at(9 * kMicrosecond));
  CHECK(bench.marks().empty());
}

TEST_CASE("a timer that is set again has one instant, the last") {
  Bench bench;
  const auto set = [&](Duration when) { bench.with([=](Alarms& a) { a.first.set(at(when)); }); };
  set(5 * kMicrosecond);
  set(2 * kMicrosecond);
  bench.device.advance(at(kMicrosecond));
  set(7 * kMicrosecond);
  bench.device.advance(at(6 * kMicrosecond));
  CHECK(bench.marks().empty());
  bench.device.advance(at(8 * kMicrosecond));
  CHECK(bench.marks() == Marks{{1, at(7 * kMicrosecond)}});
}

TEST_CASE("a timer that is cancelled does not go off") {
  Bench bench;
  bench.with([](Alarms& a) {
    a.first.set(at(2 * kMicrosecond));
    a.second.set(at(4 * kMicrosecond));
  });
  bench.device.advance(at(kMicrosecond));
  bench.with([](Alarms& a) { a.first.cancel(); });
  bench.device.advance(at(5 * kMicrosecond));
  CHECK(bench.marks() == Marks{{2, at(4 * kMicrosecond)}});
}

TEST_CASE("a timer that is set to now goes off in the next delta cycle") {
  Bench bench;
  bench.device.advance(at(kMicrosecond));
  bench.with([](Alarms& a) { a.first.set_after(Duration{}); });
  bench.device.advance(at(kMicrosecond));
  CHECK(bench.marks() == Marks{{1, at(kMicrosecond)}});
}

TEST_CASE("timers of one instant go off in the order of their construction, however a run is cut") {
  const Time when = at(4 * kMicrosecond);
  const Marks expected = {{0, when}, {1, when}, {2, when}, {3, when}};
  for (const Duration step : {Duration(4'000'000), Duration(1'000'000), Duration(777'777)}) {
    Bench bench;
    bench.with([=](Alarms& a) {
      a.second.set(when);
      a.usual.notify(4, sc_core::SC_US);
      a.third.set(when);
    });
    bench.device.advance(at(kMicrosecond / 2));
    bench.with([=](Alarms& a) { a.first.set(when); });
    while (bench.device.now() < when) {
      bench.device.advance(std::min(when, bench.device.now() + step));
    }
    Marks marks = bench.marks();
    REQUIRE(marks.size() == 4);
    CAPTURE(step.count());
    // the usual notification's position among them is SystemC's choice
    std::stable_partition(marks.begin(), marks.end(), [](const auto& m) { return m.which == 0; });
    CHECK(marks == expected);
    bench.with([](Alarms& a) { CHECK(a.deltas == std::vector<sc_dt::uint64>(4, a.deltas[0])); });
  }
}

TEST_CASE("after a skip a timer goes off at its true instant, and a usual event is late") {
  Bench bench;
  bench.with([](Alarms& a) {
    a.first.set(at(10 * kMicrosecond));
    a.usual.notify(10, sc_core::SC_US);
  });
  bench.device.advance(at(kMicrosecond));
  bench.device.kernel().skip(6 * kMicrosecond);
  CHECK(bench.device.now() == at(7 * kMicrosecond));
  bench.with([](Alarms& a) {
    CHECK(sc_core::sc_time_stamp() == sc_core::sc_time(1, sc_core::SC_US));
    CHECK(a.first.due() == at(10 * kMicrosecond));
    a.second.set_after(2 * kMicrosecond);
  });
  bench.device.advance(at(20 * kMicrosecond));
  CHECK(bench.marks() ==
        Marks{{2, at(9 * kMicrosecond)}, {1, at(10 * kMicrosecond)}, {0, at(16 * kMicrosecond)}});
}

TEST_CASE("a timer that is destroyed is forgotten") {
  Bench bench;
  bench.with([](Alarms&) {
    Timer gone("gone");
    gone.set(at(2 * kMicrosecond));
  });
  CHECK_FALSE(bench.device.next_event());
  bench.device.advance(at(3 * kMicrosecond));
  CHECK(bench.marks().empty());
}

TEST_CASE("a timer is not set to the past, and not made outside of a kernel") {
  Bench bench;
  bench.device.advance(at(2 * kMicrosecond));
  bench.with([](Alarms& a) {
    CHECK_THROWS_WITH(a.first.set(at(kMicrosecond)),
                      Contains("alarms.first") && Contains("0.000001 s ago"));
  });
  CHECK_THROWS_WITH(Timer("orphan"), Contains("orphan") && Contains("kernel"));
}
