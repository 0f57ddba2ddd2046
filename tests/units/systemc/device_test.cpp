#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/device.h>

#include "tests/units/systemc/blinker.h"
#include "tests/units/systemc/times.h"

using blinker::Blinker;
using blinker::Owner;
using stride::Duration;
using stride::Time;
using stride::systemc::Device;

namespace {

using stride::tests::at;
using stride::tests::kMicrosecond;

int edges(Device<Blinker>& device) {
  return device.within([](Blinker& blinker) { return blinker.edges.read(); });
}

}  // namespace

TEST_CASE("two devices of the same name, advanced in turn, do not see each other") {
  Device<Blinker> alone({}, "blinker", 20.0);
  alone.advance(at(100 * kMicrosecond));

  Device<Blinker> fast({}, "blinker", 20.0);
  Device<Blinker> slow({}, "blinker", 70.0);
  for (int i = 1; i <= 100; ++i) {
    fast.advance(at(i * kMicrosecond));
    if (i % 7 == 0) slow.advance(at(i * kMicrosecond));
  }
  CHECK(fast.now() == at(100 * kMicrosecond));
  CHECK(slow.now() == at(98 * kMicrosecond));
  CHECK(edges(fast) == edges(alone));
  CHECK(edges(slow) == 98'000 / 70 + 1);
}

TEST_CASE("devices can be made and destroyed hundreds of times") {
  Device<Blinker> bystander({}, "blinker", 20.0);
  for (int i = 0; i < 200; ++i) {
    Device<Blinker> device({}, "blinker", 20.0);
    device.advance(at(kMicrosecond));
    REQUIRE(edges(device) == 51);
    bystander.advance(at((i + 1) * kMicrosecond));
  }
  CHECK(edges(bystander) == 10'001);
}

TEST_CASE("a device whose processes have a reset port can be destroyed") {
  struct Counter : sc_core::sc_module {
    sc_core::sc_clock clock{"clock", 10, sc_core::SC_NS};
    sc_core::sc_signal<bool> reset{"reset"};
    sc_core::sc_in<bool> clock_port{"clock_port"}, reset_port{"reset_port"};
    sc_core::sc_signal<int> count{"count"};
    explicit Counter(sc_core::sc_module_name name) : sc_module(name) {
      clock_port(clock);
      reset_port(reset);
      SC_HAS_PROCESS(Counter);
      SC_CTHREAD(run, clock_port.pos());
      reset_signal_is(reset_port, true);
      SC_THREAD(fail);
    }
    void run() {
      count.write(0);
      for (wait();; wait()) count.write(count.read() + 1);
    }
    void fail() {
      wait(reset.posedge_event());
      SC_REPORT_ERROR("counter", "reset");
    }
  };
  for (int i = 0; i < 3; ++i) {
    Device<Counter> device({}, "counter");
    device.advance(at(kMicrosecond));
    CHECK(device.within([](Counter& counter) { return counter.count.read(); }) == 100);
    if (i < 2) continue;
    device.within([](Counter& counter) { counter.reset.write(true); });
    CHECK_THROWS(device.advance(at(2 * kMicrosecond)));
  }
}

TEST_CASE("objects on a thread's stack are destroyed with the device") {
  auto object = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = object;
  {
    Device<Owner> device({}, "owner", std::exchange(object, nullptr));
    device.advance(at(kMicrosecond));
    CHECK_FALSE(watch.expired());
  }
  CHECK(watch.expired());
}

TEST_CASE("objects on a thread's stack are destroyed with a device that has failed") {
  struct Failing : sc_core::sc_module {
    Owner owner;
    blinker::Actor actor{"actor", [] { SC_REPORT_ERROR("actor", "fails"); }, false};
    Failing(sc_core::sc_module_name name, std::shared_ptr<int> object)
        : sc_module(name), owner("owner", std::move(object)) {}
  };
  auto object = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = object;
  {
    Device<Failing> device({}, "failing", std::exchange(object, nullptr));
    CHECK_THROWS(device.advance(at(kMicrosecond)));
    CHECK_FALSE(watch.expired());
  }
  CHECK(watch.expired());
}

TEST_CASE("objects on a thread's stack are destroyed when a device fails at its beginning") {
  struct Stillborn : sc_core::sc_module {
    Owner owner;
    Stillborn(sc_core::sc_module_name name, std::shared_ptr<int> object)
        : sc_module(name), owner("owner", std::move(object)) {
      SC_HAS_PROCESS(Stillborn);
      SC_THREAD(fail);
    }
    void fail() {
      wait(sc_core::SC_ZERO_TIME);
      SC_REPORT_ERROR("stillborn", "fails");
    }
  };
  auto object = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = object;
  CHECK_THROWS(Device<Stillborn>({}, "stillborn", std::exchange(object, nullptr)));
  CHECK(watch.expired());
}

TEST_CASE("threads that have not begun do not begin when their device is destroyed") {
  struct Waiting : sc_core::sc_module {
    sc_core::sc_event never{"never"};
    int& begun;
    Waiting(sc_core::sc_module_name name, int& begun_) : sc_module(name), begun(begun_) {
      port(signal);
      SC_HAS_PROCESS(Waiting);
      SC_CTHREAD(run, port.pos());
      SC_THREAD(run);
      sensitive << never;
      dont_initialize();
      sc_core::sc_spawn_options options;
      options.dont_initialize();
      options.set_sensitivity(&never);
      sc_core::sc_spawn([this] { run(); }, "spawned", &options);
    }
    void run() { ++begun; }
    sc_core::sc_signal<bool> signal{"signal"};
    sc_core::sc_in<bool> port{"port"};
  };
  int begun = 0;
  for (const Time end : {at(0 * kMicrosecond), at(kMicrosecond)}) {
    Device<Waiting> device({}, "waiting", begun);
    device.advance(end);
  }
  CHECK(begun == 0);
}

TEST_CASE("devices may be advanced from several threads at once") {
  std::vector<std::unique_ptr<Device<Blinker>>> devices;
  for (int i = 0; i < 4; ++i) {
    devices.push_back(std::make_unique<Device<Blinker>>(nullptr, "blinker", 20.0));
  }
  std::vector<std::thread> threads;
  for (auto& device : devices) {
    threads.emplace_back([&device] {
      for (int i = 1; i <= 200; ++i) device->advance(at(i * kMicrosecond));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (auto& device : devices) CHECK(edges(*device) == 10'001);
}

TEST_CASE("the kernel of the surrounding program is not touched") {
  sc_core::sc_simcontext* const global = sc_core::sc_default_global_context;
  REQUIRE(sc_core::sc_curr_simcontext == global);
  const auto handler = sc_core::sc_report_handler::get_handler();
  {
    Device<Blinker> device({}, "blinker", 20.0);
    device.advance(at(kMicrosecond));
    CHECK(sc_core::sc_curr_simcontext == global);
  }
  CHECK(sc_core::sc_curr_simcontext == global);
  CHECK(sc_core::sc_default_global_context == global);
  CHECK(sc_core::sc_report_handler::get_handler() == handler);
}

TEST_CASE("the next event is when the device does something by itself") {
  Device<Blinker> device({}, "blinker", 20.0);
  device.advance(at(Duration(21'000)));
  CHECK(device.next_event() == at(Duration(30'000)));  // the clock's falling edge
}
