#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <sysc/kernel/sc_dynamic_processes.h>
#include <tlm_core/tlm_2/tlm_quantum/tlm_global_quantum.h>
#include <unistd.h>

#include <stride/systemc/device.h>
#include <stride/systemc/kernel.h>

#include "tests/units/systemc/blinker.h"
#include "tests/units/systemc/times.h"

using blinker::Actor;
using blinker::Blinker;
using Catch::Matchers::Contains;
using stride::Duration;
using stride::Time;
using stride::systemc::Device;
using stride::systemc::DeviceError;
using stride::systemc::Kernel;

namespace {

using stride::tests::at;
using stride::tests::kMicrosecond;
using stride::tests::kNanosecond;

std::string error_of(void (*action)(), bool in_thread) {
  Device<Actor> device({}, "actor", action, in_thread);
  device.advance(at(Duration(999'999)));
  try {
    device.advance(at(2 * kMicrosecond));
  } catch (const DeviceError& error) {
    CHECK_THROWS_WITH(device.advance(at(3 * kMicrosecond)), Contains("failed before"));
    return error.what();
  }
  return "no error";
}

/// What is written to a file descriptor while f runs.
template <class Function>
std::string captured(int descriptor, Function f) {
  std::fflush(nullptr);
  std::FILE* file = std::tmpfile();
  const int saved = dup(descriptor);
  dup2(fileno(file), descriptor);
  f();
  std::fflush(nullptr);
  dup2(saved, descriptor);
  close(saved);
  std::rewind(file);
  std::string text(4096, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

}  // namespace

TEST_CASE("a device that is linked with another copy of SystemC is refused") {
  static int other = 0;
  CHECK_THROWS_WITH(Kernel({}, &other), Contains("a process can have one only") &&
                                            Contains("units that were in this process before"));
}

TEST_CASE("time is converted to the picosecond") {
  Device<Blinker> device({}, "blinker", 20.0);
  const Duration odd(123'456'789'012'345);
  Kernel kernel;
  kernel.initialize();
  CHECK(kernel.advance(at(odd)) == at(odd));
  CHECK(kernel.advance(at(odd + Duration(1))) == at(odd + Duration(1)));
  kernel.within([&] {
    CHECK(sc_core::sc_time_stamp() ==
          sc_core::sc_time::from_value(static_cast<std::uint64_t>(odd.count()) + 1));
  });
}

TEST_CASE("what happens at the end of a step has happened") {
  Device<Blinker> device({}, "blinker", 20.0);
  const auto edges = [&] { return device.within([](Blinker& b) { return b.edges.read(); }); };
  const int at_start = edges();
  device.advance(at(40 * kNanosecond - Duration(1)));
  CHECK(edges() == at_start + 1);
  device.advance(at(40 * kNanosecond));
  CHECK(edges() == at_start + 2);
}

TEST_CASE("an input that is written at an instant is seen at that instant") {
  Device<Blinker> device({}, "blinker", 20.0);
  device.advance(at(1234 * kNanosecond));
  device.within([](Blinker& b) { b.enable.write(true); });
  device.advance(at(5 * kMicrosecond));
  device.within([](Blinker& b) {
    REQUIRE(b.changes.size() == 1);
    CHECK(b.changes[0] == sc_core::sc_time(1234, sc_core::SC_NS));
  });
}

TEST_CASE("kernels of different time resolution exist side by side") {
  Kernel fine;
  fine.within([] { sc_core::sc_set_time_resolution(1, sc_core::SC_FS); });
  fine.initialize();
  Kernel usual;
  usual.initialize();
  CHECK(fine.advance(at(3 * kMicrosecond)) == at(3 * kMicrosecond));
  CHECK(usual.advance(at(kMicrosecond)) == at(kMicrosecond));
  fine.within([] { CHECK(sc_core::sc_time_stamp() == sc_core::sc_time(3, sc_core::SC_US)); });
  fine.within([] { CHECK(sc_core::sc_time_stamp().value() == 3'000'000'000); });
  usual.within([] { CHECK(sc_core::sc_time_stamp().value() == 1'000'000); });

  Kernel coarse;
  coarse.within([] { sc_core::sc_set_time_resolution(1, sc_core::SC_NS); });
  CHECK_THROWS_WITH(coarse.initialize(), Contains("coarser than 1 ps"));
}

TEST_CASE("a call out of order is an error") {
  Kernel kernel;
  CHECK_THROWS_AS(kernel.advance(at(kMicrosecond)), std::logic_error);
  kernel.initialize();
  kernel.advance(at(kMicrosecond));
  CHECK_THROWS_WITH(kernel.advance(at(kNanosecond)), Contains("from 0.000001 s to 0.000000001 s"));
}

TEST_CASE("the failure of a device is an error with what, where and when") {
  const bool in_thread = GENERATE(false, true);
  CAPTURE(in_thread);
  CHECK_THAT(error_of([] { SC_REPORT_ERROR("motor", "overheated"); }, in_thread),
             Contains("motor: overheated") && Contains("actor.act") && Contains("1 us"));
  CHECK_THAT(error_of([] { SC_REPORT_FATAL("motor", "on fire"); }, in_thread),
             Contains("motor: on fire"));
  CHECK_THAT(error_of([] { throw std::runtime_error("lost"); }, in_thread), Contains("lost"));
  CHECK_THAT(error_of([] { sc_core::sc_start(); }, in_thread),
             Contains("sc_start") && Contains("actor.act") && Contains("1 us"));
}

TEST_CASE("a device that calls sc_stop has finished") {
  const bool in_thread = GENERATE(false, true);
  CAPTURE(in_thread);
  Device<Actor> device(
      {}, "actor", [] { sc_core::sc_stop(); }, in_thread);
  CHECK(device.advance(at(Duration(999'999))) == at(Duration(999'999)));
  CHECK_FALSE(device.kernel().stopped());
  CHECK(device.advance(at(2 * kMicrosecond)) == at(kMicrosecond));
  CHECK(device.kernel().stopped() == at(kMicrosecond));
  CHECK(device.advance(at(3 * kMicrosecond)) == at(kMicrosecond));
}

TEST_CASE("an error whose action is to stop is an error") {
  Device<Actor> device(
      {}, "actor",
      [] {
        sc_core::sc_report_handler::set_actions("motor", sc_core::SC_ERROR, sc_core::SC_STOP);
        SC_REPORT_ERROR("motor", "overheated");
      },
      true);
  CHECK_THROWS_WITH(device.advance(at(2 * kMicrosecond)), Contains("motor: overheated"));
  sc_core::sc_report_handler::set_actions("motor", sc_core::SC_ERROR, sc_core::SC_UNSPECIFIED);
}

namespace {

/// Its threads wait for others, which use what is on its stack.
class Forker : public sc_core::sc_module {
 public:
  Forker(sc_core::sc_module_name name, std::shared_ptr<int> object)
      : sc_module(name), object_(std::move(object)) {
    SC_HAS_PROCESS(Forker);
    SC_THREAD(run);
  }

 private:
  void run() {
    const std::shared_ptr<int> held = object_;
    SC_FORK
    sc_core::sc_spawn([&held] { hold(held, 2); }),
        sc_core::sc_spawn([&held] { hold(held, 5); }) SC_JOIN
  }
  static void hold(const std::shared_ptr<int>& object, int microseconds) {
    const std::shared_ptr<int> held = object;
    sc_core::wait(microseconds, sc_core::SC_US);
  }
  std::shared_ptr<int> object_;
};

}  // namespace

TEST_CASE("a device ends while its threads are in SC_FORK and SC_JOIN") {
  const auto object = std::make_shared<int>(1);
  for (const int microseconds : {1, 3, 10}) {
    Device<Forker> device({}, "forker", object);
    device.advance(at(microseconds * kMicrosecond));
  }
  CHECK(object.use_count() == 1);
}

TEST_CASE("the threads of a device that has called sc_stop are ended, too") {
  struct Stopper : blinker::Owner {
    Stopper(sc_core::sc_module_name name, std::shared_ptr<int> object) : Owner(name, object) {
      sc_core::sc_spawn([] { sc_core::sc_stop(); });
    }
  };
  const auto object = std::make_shared<int>(1);
  {
    Device<Stopper> device({}, "stopper", object);
    CHECK(device.kernel().stopped());
    CHECK(object.use_count() > 1);
  }
  CHECK(object.use_count() == 1);
}

TEST_CASE("each kernel has a global quantum of its own") {
  const auto quantum = [] { return tlm::tlm_global_quantum::instance().get(); };
  Kernel first;
  first.initialize();
  Kernel second;
  second.initialize();
  first.set_quantum(kMicrosecond);
  CHECK(first.within(quantum) == sc_core::sc_time(1, sc_core::SC_US));
  CHECK(second.within(quantum) == sc_core::SC_ZERO_TIME);
  second.within(
      [] { tlm::tlm_global_quantum::instance().set(sc_core::sc_time(1, sc_core::SC_NS)); });
  CHECK(second.within(quantum) == sc_core::sc_time(1, sc_core::SC_NS));
  CHECK(first.within(quantum) == sc_core::sc_time(1, sc_core::SC_US));
  CHECK(quantum() == sc_core::SC_ZERO_TIME);
}

TEST_CASE("a device that runs or ends the simulation in its constructor gives an error") {
  struct Driver : sc_core::sc_module {
    Driver(sc_core::sc_module_name name, void (*action)()) : sc_module(name) { action(); }
  };
  const auto error_of = [](void (*action)()) -> std::string {
    try {
      Device<Driver> device({}, "driver", action);
    } catch (const DeviceError& error) {
      return error.what();
    }
    return "no error";
  };
  CHECK_THAT(error_of([] { sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US)); }),
             Contains("sc_start"));
  CHECK_THAT(error_of([] { sc_core::sc_stop(); }), Contains("called sc_stop"));
  CHECK_THAT(error_of([] { SC_REPORT_FATAL("driver", "no licence"); }), Contains("no licence"));
}

TEST_CASE("elaboration errors name the port") {
  struct Unbound : sc_core::sc_module {
    sc_core::sc_in<bool> missing{"missing"};
    explicit Unbound(sc_core::sc_module_name name) : sc_module(name) {}
  };
  const auto make = [] { Device<Unbound> device({}, "unbound"); };
  CHECK_THROWS_WITH(make(), Contains("unbound.missing"));
}

TEST_CASE("a constructor that throws leaves the kernel usable for others") {
  struct Broken : sc_core::sc_module {
    Blinker part{"part", 20.0};
    explicit Broken(sc_core::sc_module_name name) : sc_module(name) {
      throw std::invalid_argument("no such mode");
    }
  };
  const auto make = [] { Device<Broken> device({}, "broken"); };
  CHECK_THROWS_WITH(make(), "no such mode");
  Device<Blinker> device({}, "blinker", 20.0);
  CHECK(device.advance(at(kMicrosecond)) == at(kMicrosecond));
}

TEST_CASE("warnings go to the log of their device, and nothing is printed") {
  std::vector<std::string> first_log;
  std::vector<std::string> second_log;
  const auto log_to = [](std::vector<std::string>& lines) {
    return [&lines](sc_core::sc_severity severity, const std::string& text) {
      lines.push_back((severity == sc_core::SC_WARNING ? "warning " : "info ") + text);
    };
  };
  const auto run = [&] {
    const auto warn = [] { SC_REPORT_WARNING("battery", "low"); };
    const auto note = [] { SC_REPORT_INFO("battery", "fine"); };
    Device<Actor> first(log_to(first_log), "first", static_cast<void (*)()>(warn), false);
    Device<Actor> second(log_to(second_log), "second", static_cast<void (*)()>(note), false);
    second.advance(at(2 * kMicrosecond));
    first.advance(at(2 * kMicrosecond));
  };
  std::string error_output;
  const std::string output =
      captured(STDOUT_FILENO, [&] { error_output = captured(STDERR_FILENO, run); });
  CHECK(output.empty());
  CHECK(error_output.empty());
  REQUIRE(first_log.size() == 1);
  CHECK_THAT(first_log[0], Contains("warning battery: low") && Contains("first.act"));
  REQUIRE(second_log.size() == 1);
  CHECK_THAT(second_log[0], Contains("info battery: fine"));
}

TEST_CASE("sc_pause stops early only where that is allowed") {
  const auto pause = static_cast<void (*)()>([] { sc_core::sc_pause(); });
  Device<Actor> allowed({}, "actor", pause, true);
  CHECK(allowed.advance(at(5 * kMicrosecond), true) == at(kMicrosecond));
  CHECK(allowed.advance(at(5 * kMicrosecond), true) == at(5 * kMicrosecond));
  Device<Actor> not_allowed({}, "actor", pause, true);
  CHECK(not_allowed.advance(at(5 * kMicrosecond)) == at(5 * kMicrosecond));
}

TEST_CASE("a skip moves true time and leaves SystemC's where it is") {
  Device<Blinker> device({}, "blinker", 20.0);
  Kernel& kernel = device.kernel();
  const auto edges = [&] { return device.within([](Blinker& b) { return b.edges.read(); }); };
  device.advance(at(kMicrosecond + kNanosecond));
  const int before = edges();
  kernel.skip(400 * 20 * kNanosecond);
  CHECK(device.now() == at(9 * kMicrosecond + kNanosecond));
  CHECK(kernel.skipped() == 8 * kMicrosecond);
  CHECK(edges() == before);
  CHECK(device.next_event() == at(9 * kMicrosecond + 10 * kNanosecond));
  device.advance(at(9 * kMicrosecond + 20 * kNanosecond - Duration(1)));
  CHECK(edges() == before);
  device.advance(at(9 * kMicrosecond + 20 * kNanosecond));
  CHECK(edges() == before + 1);
}

TEST_CASE("a device that sleeps for years keeps its true time to the picosecond") {
  constexpr Duration kYears = std::chrono::hours(24 * 3650) + Duration(1);
  Device<Blinker> device({}, "blinker", 20.0);
  Kernel& kernel = device.kernel();
  device.advance(at(kMicrosecond));
  kernel.skip(kYears);
  CHECK(device.now() == at(kMicrosecond + kYears));
  CHECK(kernel.skipped() == kYears);
  device.advance(at(2 * kMicrosecond + kYears));
  CHECK(device.now() == at(2 * kMicrosecond + kYears));
}

TEST_CASE("SystemC's own time ends after 64 bits, in words") {
  CHECK_THROWS_WITH(stride::systemc::to_sc_time(std::chrono::hours(24 * 3650)),
                    Contains("315360000 s is beyond SystemC's time, which ends at 18446744"));
}

TEST_CASE("only a device at rest is skipped, and forwards") {
  Device<Blinker> device({}, "blinker", 20.0);
  Kernel& kernel = device.kernel();
  CHECK_THROWS_WITH(kernel.skip(Duration(-1)), Contains("negative"));
  device.within([](Blinker& b) { b.enable.write(true); });
  CHECK_FALSE(kernel.at_rest());
  CHECK_THROWS_WITH(kernel.skip(kMicrosecond), Contains("at rest"));
  CHECK(kernel.skipped() == Duration{});
}

TEST_CASE("a device of a finer time resolution is skipped by picoseconds") {
  Kernel fine;
  fine.within([] { sc_core::sc_set_time_resolution(1, sc_core::SC_FS); });
  fine.initialize();
  fine.advance(at(kNanosecond));
  fine.skip(kMicrosecond);
  CHECK(fine.now() == at(kMicrosecond + kNanosecond));
  CHECK(fine.skipped() == kMicrosecond);
  CHECK(fine.advance(at(2 * kMicrosecond)) == at(2 * kMicrosecond));
}

TEST_CASE("what is due at the end of an approach happens in the next call") {
  const auto pause = static_cast<void (*)()>([] { sc_core::sc_pause(); });
  Device<Actor> device({}, "actor", pause, false);
  Kernel& kernel = device.kernel();
  CHECK(kernel.approach(at(kMicrosecond), true) == at(kMicrosecond));
  CHECK_FALSE(kernel.at_rest());
  CHECK(kernel.approach(at(5 * kMicrosecond), true) == at(kMicrosecond));  // the pause
  CHECK(kernel.at_rest());
  CHECK(kernel.approach(at(5 * kMicrosecond), true) == at(5 * kMicrosecond));
}

TEST_CASE("errors have true times") {
  const auto overheat = static_cast<void (*)()>([] { SC_REPORT_ERROR("motor", "overheated"); });
  Device<Actor> device({}, "actor", overheat, false);
  device.advance(at(kNanosecond));
  device.kernel().skip(2 * kMicrosecond);
  CHECK_THROWS_WITH(device.advance(at(5 * kMicrosecond)),
                    Contains("overheated") && Contains("at 3 us"));
}
