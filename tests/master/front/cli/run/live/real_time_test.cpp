#include "master/front/cli/run/live/real_time.h"

#include <catch2/catch.hpp>

#include "master/base/error.h"

using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using stride::Duration;
using stride::Time;
using stride::cli::parse_real_time_factor;
using stride::cli::RealTime;
using stride::cli::WallClock;

namespace {

constexpr std::int64_t kMillisecond = 1'000'000'000;

Time at(std::int64_t milliseconds) { return Time(Duration(milliseconds * kMillisecond)); }

/// A clock that goes on where it is waited for, or where a test says so.
struct WaitBench {
  WallClock::Instant now{};
  int pauses = 0;
  volatile std::sig_atomic_t interrupted = 0;
  std::chrono::milliseconds interrupted_after = 24h;

  WallClock clock() {
    WallClock clock;
    clock.now = [this] { return now; };
    clock.wait_until = [this](WallClock::Instant instant) {
      ++pauses;
      now = instant;
      if (now.time_since_epoch() >= interrupted_after) interrupted = 1;
    };
    return clock;
  }
  auto elapsed() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
  }
};

}  // namespace

TEST_CASE("a run in real time waits for each of its instants") {
  WaitBench bench;
  RealTime real_time(1, bench.interrupted, bench.clock());
  CHECK(real_time.text() == "");
  bench.now += 5ms;
  real_time.on_communication_point(at(1000));
  CHECK(bench.pauses == 0);
  real_time.on_communication_point(at(1010));
  CHECK(bench.elapsed() == 15ms);
  real_time.on_communication_point(at(1010));
  CHECK(bench.elapsed() == 15ms);
  bench.now += 3ms;
  real_time.on_communication_point(at(1020));
  CHECK(bench.elapsed() == 25ms);
  CHECK(real_time.text() == "Real time: never late");
  CHECK(!real_time.is_late());
}

TEST_CASE("a factor makes it slower or faster") {
  WaitBench bench;
  RealTime slow(0.5, bench.interrupted, bench.clock());
  slow.on_communication_point(at(0));
  slow.on_communication_point(at(10));
  CHECK(bench.elapsed() == 20ms);
  RealTime fast(4, bench.interrupted, bench.clock());
  fast.on_communication_point(at(0));
  fast.on_communication_point(at(40));
  CHECK(bench.elapsed() == 30ms);
  CHECK_THAT(fast.text(), Contains("4 x real time"));
}

TEST_CASE("a run that is late does not wait until it has caught up, and says how late it was") {
  WaitBench bench;
  RealTime real_time(1, bench.interrupted, bench.clock());
  real_time.on_communication_point(at(0));
  bench.now += 160ms;
  real_time.on_communication_point(at(10));
  CHECK(real_time.is_late());
  real_time.on_communication_point(at(100));
  CHECK(bench.pauses == 0);
  CHECK(real_time.text() == "Real time: 150.0 ms late at most, at 0.01 s; 60.0 ms at the end");
  CHECK(!real_time.is_late());
  real_time.on_communication_point(at(200));
  CHECK(bench.elapsed() == 200ms);
  CHECK(real_time.text() == "Real time: 150.0 ms late at most, at 0.01 s; 0.0 ms at the end");
}

TEST_CASE("where there is time, something is done about once a second") {
  WaitBench bench;
  bench.now += 1h;
  int done = 0;
  RealTime real_time(1, bench.interrupted, bench.clock());
  real_time.set_meanwhile([&] { ++done; });
  for (int i = 0; i <= 30; ++i) real_time.on_communication_point(at(100 * i));
  CHECK(done == 3);
  bench.now += 10s;
  real_time.on_communication_point(at(3100));
  CHECK(done == 3);
}

TEST_CASE("an interruption ends a long pause") {
  WaitBench bench;
  bench.interrupted_after = 100ms;
  RealTime real_time(1, bench.interrupted, bench.clock());
  real_time.on_communication_point(at(0));
  real_time.on_communication_point(Time(Duration(INT64_MAX)));
  CHECK(bench.elapsed() == 100ms);
}

TEST_CASE("a factor is a number above 0") {
  CHECK(parse_real_time_factor("1") == 1);
  CHECK(parse_real_time_factor("0.25") == 0.25);
  for (const char* text : {"0", "-1", "fast", "", "nan", "inf", "2x"}) {
    CHECK_THROWS_WITH(parse_real_time_factor(text), Contains("--realtime ") && Contains("above 0"));
  }
}
