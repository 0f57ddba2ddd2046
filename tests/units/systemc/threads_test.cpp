// Devices that are advanced from several threads at the same time, and each from several in turn.
#include <memory>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

#include <stride/systemc/device.h>

#include "tests/units/systemc/blinker.h"
#include "tests/units/systemc/times.h"

using blinker::Blinker;
using stride::Duration;
using stride::Time;
using stride::systemc::Device;

namespace {

using stride::tests::kMicrosecond;
constexpr std::size_t kDevices = 4;
constexpr int kRounds = 200;

struct Seen {
  std::vector<int> edges;
  std::vector<sc_core::sc_time> changes;
};

std::vector<std::unique_ptr<Device<Blinker>>> devices() {
  std::vector<std::unique_ptr<Device<Blinker>>> all;
  for (std::size_t i = 0; i < kDevices; ++i) {
    const double period = 10.0 + static_cast<double>(i);
    all.push_back(
        std::make_unique<Device<Blinker>>(stride::systemc::Kernel::Log{}, "blinker", period));
  }
  return all;
}

void step(Device<Blinker>& device, int round, Seen& seen) {
  device.within([&](Blinker& module) { module.enable.write(round % 3 == 0); });
  device.advance(Time(kMicrosecond * (round + 1)));
  device.within([&](Blinker& module) {
    seen.edges.push_back(module.edges.read());
    seen.changes = module.changes;
  });
}

std::vector<Seen> in_turn() {
  std::vector<Seen> seen(kDevices);
  const auto all = devices();
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < kDevices; ++i) step(*all[i], round, seen[i]);
  }
  return seen;
}

/// In each round every device is on another thread than in the one before, now and then on this
/// one.
std::vector<Seen> on_threads() {
  std::vector<Seen> seen(kDevices);
  const auto all = devices();
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < kDevices; ++i) {
      const std::size_t device = (i + static_cast<std::size_t>(round)) % kDevices;
      threads.emplace_back([&, device] { step(*all[device], round, seen[device]); });
    }
    const std::size_t own = static_cast<std::size_t>(round) % kDevices;
    step(*all[own], round, seen[own]);
    for (std::thread& thread : threads) thread.join();
  }
  return seen;
}

}  // namespace

TEST_CASE("devices on several threads do what they do in turn") {
  const auto expected = in_turn();
  const auto seen = on_threads();
  for (std::size_t i = 0; i < kDevices; ++i) {
    INFO("device " << i);
    CHECK(expected[i].edges.back() > kRounds * 70);
    CHECK(seen[i].edges == expected[i].edges);
    CHECK(seen[i].changes == expected[i].changes);
  }
}
