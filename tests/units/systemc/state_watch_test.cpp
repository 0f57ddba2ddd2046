#include <memory>
#include <optional>
#include <string>

#include <catch2/catch.hpp>

#include <stride/systemc/device.h>
#include <stride/systemc/state_watch.h>

#include "tests/units/systemc/times.h"

using stride::systemc::Device;
using stride::systemc::StateWatch;
using stride::tests::at;
using stride::tests::kMicrosecond;

namespace {

struct WatchedPart : sc_core::sc_module {
  sc_core::sc_signal<int> number{"number"};
  int member = 0;
  explicit WatchedPart(sc_core::sc_module_name name) : sc_module(name) {}
};

struct WatchedWhole : sc_core::sc_module {
  sc_core::sc_clock clock{"clock", 1, sc_core::SC_US};
  sc_core::sc_event event{"event"};
  WatchedPart inside{"inside"};
  std::unique_ptr<WatchedPart> outside{std::make_unique<WatchedPart>("outside")};
  sc_core::sc_signal<bool> level{"level"};
  sc_core::sc_signal<int> last{"last"};
  explicit WatchedWhole(sc_core::sc_module_name name) : sc_module(name) {}
};

struct WatchBench {
  Device<WatchedWhole> device{{}, "whole"};
  WatchedWhole& whole = device.module();
  std::optional<StateWatch> watch;

  WatchBench() {
    device.within([this](const WatchedWhole& module) { watch.emplace(module); });
    watch->has_changed();
  }
  template <class Write>
  void change(Write write) {
    device.within([&](WatchedWhole& module) { write(module); });
    device.advance(device.now());
  }
};

}  // namespace

TEST_CASE("members and signals of a module are watched") {
  WatchBench bench;
  CHECK_FALSE(bench.watch->has_changed());
  const auto place_of = [&](auto write) {
    bench.change(write);
    const bool has_changed = bench.watch->has_changed();
    CHECK_FALSE(bench.watch->has_changed());
    return has_changed ? bench.watch->place() : "none";
  };
  CHECK(place_of([](WatchedWhole& whole) { whole.inside.member = 1; }) == "whole.inside.number");
  CHECK(place_of([](WatchedWhole& whole) { whole.inside.number.write(2); }) ==
        "whole.inside.number");
  CHECK(place_of([](WatchedWhole& whole) { whole.outside->number.write(3); }) ==
        "whole.outside.number");
  CHECK(place_of([](WatchedWhole& whole) { whole.last.write(4); }) == "whole.last");
  CHECK(place_of([](WatchedWhole& whole) { whole.level.write(true); }) == "whole.level");
  CHECK(place_of([](WatchedWhole& whole) { whole.outside->member = 5; }) ==
        "none");  // out of its sight
}

TEST_CASE("what SystemC notes is no change of a module") {
  WatchBench bench;
  bench.device.advance(at(10 * kMicrosecond + kMicrosecond / 4));
  CHECK_FALSE(bench.watch->has_changed());
  bench.change([](WatchedWhole& whole) {
    whole.level.write(true);
    whole.event.notify(sc_core::SC_ZERO_TIME);
  });
  bench.change([](WatchedWhole& whole) { whole.level.write(false); });
  CHECK_FALSE(bench.watch->has_changed());
}
