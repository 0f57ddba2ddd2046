#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <stride/systemc/device.h>
#include <stride/systemc/trace.h>

#include "tests/units/systemc/meter.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/vcd.h"

using Catch::Matchers::Contains;
using meter::kPeriod;
using meter::Meter;
using stride::Duration;
using stride::Time;
using stride::systemc::Device;
using stride::systemc::SignalList;
using stride::systemc::Trace;
using stride::systemc::TraceOptions;
using stride::tests::read_vcd;
using stride::tests::Vcd;

namespace fs = std::filesystem;

namespace {

using stride::tests::at;
using stride::tests::kMicrosecond;

struct TemporaryFolder {
  fs::path path = fs::temp_directory_path() / ("stride_trace_" + std::to_string(getpid()));
  TemporaryFolder() { fs::create_directory(path); }
  ~TemporaryFolder() { fs::remove_all(path); }
  std::string operator/(const char* name) const { return (path / name).string(); }
};

struct TracedMeter {
  explicit TracedMeter(const TraceOptions& options)
      : device(stride::systemc::Kernel::Log{}, "meter") {
    SignalList signals;
    device.within([&](Meter& meter) { signals.add_all_within(meter); });
    trace = std::make_unique<Trace>(device.kernel(), options, signals);
  }
  void request(bool wanted) {
    device.within([=](Meter& meter) { meter.request.write(wanted); });
  }

  Device<Meter> device;
  std::unique_ptr<Trace> trace;
};

std::vector<std::string> names(const Vcd& vcd) {
  std::vector<std::string> names;
  for (const auto& [name, changes] : vcd.signals) names.push_back(name);
  return names;
}

}  // namespace

TEST_CASE("a trace holds the signals that the patterns choose, below their module") {
  const TemporaryFolder folder;
  const auto traced = [&](const std::string& patterns) {
    const TraceOptions options{folder / "meter.vcd", patterns};
    { TracedMeter(options).device.advance(at(kMicrosecond)); }
    return names(read_vcd(options.file));
  };
  CHECK(traced("*") == std::vector<std::string>{"advanceTime", "meter.busy", "meter.clock",
                                                "meter.measurements", "meter.request"});
  CHECK(traced("bus? m*") ==
        std::vector<std::string>{"advanceTime", "meter.busy", "meter.measurements"});
  CHECK(traced("clock") == std::vector<std::string>{"advanceTime", "meter.clock"});
}

TEST_CASE("the last changes are in the file, in picoseconds") {
  const TemporaryFolder folder;
  const TraceOptions options{folder / "meter", "*"};
  TracedMeter meter(options);
  meter.device.advance(at(kMicrosecond));
  meter.request(true);
  meter.device.advance(at(kMicrosecond));
  meter.trace.reset();
  const Vcd vcd = read_vcd(folder / "meter.vcd");  // the extension was added
  CHECK(vcd.timescale == "1 ps");
  CHECK(vcd.of("meter.request") == Vcd::Changes{{0, "0"}, {1'000'000, "1"}});
  CHECK(vcd.of("meter.clock").size() == 101);
}

TEST_CASE("an expanded trace is the one without skipping, but for the clock's edges") {
  const TemporaryFolder folder;
  const auto run = [&](bool skips) {
    const TraceOptions options{folder / (skips ? "skipping.vcd" : "full.vcd"), "*"};
    TracedMeter meter(options);
    Time now;
    for (int i = 0; i < 6; ++i) {
      now += 37 * kMicrosecond + Duration(777);
      while (meter.device.now() < now) {
        meter.device.advance(std::min(now, meter.device.now() + 8 * kMicrosecond));
        const Duration room = (now - meter.device.now()) / kPeriod * kPeriod;
        if (skips && room > Duration{} && meter.device.module().sleeps()) {
          meter.device.advance(meter.device.now() + Duration(1));
          meter.device.kernel().skip(room - kPeriod);
        }
      }
      meter.request(i % 2 == 0);
    }
    meter.device.advance(now + 10 * kMicrosecond);
    meter.trace.reset();
    return read_vcd(options.file);
  };
  const Vcd full = run(false);
  const Vcd skipping = run(true);
  for (const char* name : {"meter.request", "meter.busy", "meter.measurements"}) {
    CAPTURE(name);
    CHECK(full.of(name).size() > 3);
    CHECK(skipping.of(name) == full.of(name));
  }
  const auto& edges = skipping.of("meter.clock");
  const auto& all_edges = full.of("meter.clock");
  CHECK(std::includes(all_edges.begin(), all_edges.end(), edges.begin(), edges.end()));
  CHECK(edges.size() < all_edges.size() * 2 / 3);
  CHECK(full.of("advanceTime").size() == 1);
  CHECK(skipping.of("advanceTime").size() > 4);
  CHECK(skipping.bytes < full.bytes);
  CHECK(skipping.last_stamp < full.last_stamp);
}

TEST_CASE("a device of a finer time resolution is traced in its units") {
  struct Fine : sc_core::sc_module {
    sc_core::sc_signal<bool> lit{"lit"};
    explicit Fine(sc_core::sc_module_name name) : sc_module((set_resolution(), name)) {}
    static void set_resolution() { sc_core::sc_set_time_resolution(10, sc_core::SC_FS); }
  };
  const TemporaryFolder folder;
  Device<Fine> device({}, "fine");
  SignalList signals;
  device.within([&](Fine& fine) { signals.add(fine.lit); });
  {
    const Trace trace(device.kernel(), {folder / "fine.vcd", "*"}, signals);
    device.advance(at(kMicrosecond));
    device.kernel().skip(kMicrosecond);
    device.advance(at(3 * kMicrosecond));
    device.within([](Fine& fine) { fine.lit.write(true); });
    device.advance(at(3 * kMicrosecond));
  }
  const Vcd vcd = read_vcd(folder / "fine.vcd");
  CHECK(vcd.timescale == "10 fs");
  CHECK(vcd.of("fine.lit") == Vcd::Changes{{0, "0"}, {300'000'000, "1"}});
}

TEST_CASE("several devices have several files, and one file has one device") {
  const TemporaryFolder folder;
  TracedMeter first({folder / "first.vcd", "busy"});
  TracedMeter second({folder / "second.vcd", "busy"});
  const auto third = [&](const char* name) { TracedMeter({folder / name, "*"}); };
  CHECK_THROWS_WITH(third("first.vcd"),
                    Contains("trace.file") && Contains("another device") && Contains("first.vcd"));
  const std::string detour = "../" + folder.path.filename().string() + "/first";
  CHECK_THROWS_WITH(third(detour.c_str()), Contains("another device"));
  second.device.advance(at(kMicrosecond));
  second.request(true);
  second.device.advance(at(2 * kMicrosecond));
  first.device.advance(at(kMicrosecond));
  first.trace.reset();
  second.trace.reset();
  CHECK(read_vcd(folder / "first.vcd").of("meter.busy").size() == 1);
  CHECK(read_vcd(folder / "second.vcd").of("meter.busy").size() == 2);
  CHECK_NOTHROW(third("first.vcd"));  // it is free again
}

TEST_CASE("one file has one device, whichever process it is in") {
  const TemporaryFolder folder;
  TracedMeter meter({folder / "meter.vcd", "busy"});
  const auto attempt = [&] {
    const pid_t child = ::fork();
    if (child == 0) {
      std::string message = "traced";
      try {
        TracedMeter other({folder / "meter.vcd", "busy"});
      } catch (const std::exception& error) {
        message = error.what();
      }
      ::_exit(message.find("another device") == std::string::npos ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status);
  };
  CHECK(attempt() == 1);
  meter.trace.reset();
  CHECK(attempt() == 0);
}

TEST_CASE("a file that cannot be written, and a pattern that chooses nothing, are errors") {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& file, const std::string& patterns) {
    TracedMeter({file, patterns});
  };
  CHECK_THROWS_WITH(
      trace(folder / "no/such/folder.vcd", "*"),
      Contains("trace.file") && Contains("folder.vcd") && Contains("No such file or directory"));
  CHECK_THROWS_WITH(trace(folder / "meter.vcd", "busy bsy*"),
                    Contains("trace.signals") && Contains("\"bsy*\"") &&
                        Contains("request, busy, measurements, clock"));
  CHECK_THROWS_WITH(trace(folder / "meter.vcd", " "), Contains("trace.signals"));
  CHECK_FALSE(fs::exists(folder / "meter.vcd"));
}

TEST_CASE("what was traced before a device failed is complete") {
  struct Failing : sc_core::sc_module {
    sc_core::sc_signal<int> count{"count"};
    explicit Failing(sc_core::sc_module_name name) : sc_module(name) {
      SC_HAS_PROCESS(Failing);
      SC_THREAD(run);
    }
    void run() {
      for (int i = 1; i < 5; ++i) {
        wait(1, sc_core::SC_US);
        count.write(i);
      }
      wait(1, sc_core::SC_US);
      SC_REPORT_ERROR("motor", "overheated");
    }
  };
  const TemporaryFolder folder;
  Device<Failing> device({}, "failing");
  SignalList signals;
  device.within([&](Failing& failing) { signals.add(failing.count); });
  {
    const Trace trace(device.kernel(), {folder / "failing.vcd", "*"}, signals);
    CHECK_THROWS_AS(device.advance(at(9 * kMicrosecond)), stride::systemc::DeviceError);
  }
  CHECK(read_vcd(folder / "failing.vcd").of("failing.count").size() == 5);
}
