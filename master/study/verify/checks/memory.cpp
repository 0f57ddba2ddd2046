#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

using Clock = std::chrono::steady_clock;

/// A block that is lost in every second instance, or step, is above this: none takes less than 32
/// bytes. malloc() now and then gives out a larger block than it was asked for, within this, too.
constexpr double kMostHeap = 16;
/// Pages come and go, and a library may have an allocator of its own.
constexpr double kMostResident = 1024;
/// Below this all together, it may be what malloc() itself keeps at hand of each size [byte].
constexpr double kNoise = 16384;
constexpr std::size_t kWarmUp = 20;
constexpr std::size_t kFewest = 40;
constexpr std::size_t kMostSteps = 20'000;

constexpr const char* kLeakAdvice =
    "what it makes with each instance and never frees; if that is a module of SystemC which cannot "
    "be mended (parts that are made with new), --leak BYTES allows it";

struct Usage {
  double heap = 0;      ///< bytes that malloc() has given out
  double resident = 0;  ///< bytes of the process in memory
};

Usage usage() {
  const struct mallinfo2 info = ::mallinfo2();
  std::size_t pages = 0;
  std::size_t resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return {static_cast<double>(info.uordblks + info.hblkhd),
          static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE))};
}

std::size_t entries(const char* folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// What instances may leave behind beside memory.
struct Leftovers {
  std::size_t files = entries("/proc/self/fd");
  std::size_t threads = entries("/proc/self/task");
};

/// Throws Failure if there are more of them after so many instances.
void require_released(const Leftovers& before, const Leftovers& after, std::size_t instances) {
  if (after.files > before.files + instances / 2) {
    throw Failure(
        fmt::format("{} instances leave {} files open", instances, after.files - before.files));
  }
  if (after.threads > before.threads + instances / 2) {
    throw Failure(fmt::format("{} instances leave {} threads running", instances,
                              after.threads - before.threads));
  }
}

/// Of those that are left once, whatever the number of instances.
std::vector<std::string> notes_on(const Leftovers& before, const Leftovers& after) {
  std::vector<std::string> notes;
  if (after.files > before.files) {
    notes.push_back(core::counted(after.files - before.files, "file stays", "files stay") +
                    " open when no instance is left");
  }
  if (after.threads > before.threads) {
    notes.push_back(core::counted(after.threads - before.threads, "thread runs", "threads run") +
                    " on when no instance is left");
  }
  return notes;
}

/// How much more is in use after each repetition.
struct Growth {
  std::size_t count = 0;  ///< of repetitions that were measured
  double heap = 0;        ///< [byte per repetition], in the quarter of the run with the least
  double resident = 0;

  bool heap_leaks(double allowed = 0) const {
    return heap > kMostHeap + allowed && exceeds_noise(heap);
  }
  /// `allowed`: of heap, which is resident, too.
  bool is_leak(double allowed = 0) const {
    return heap_leaks(allowed) || (resident > kMostResident + allowed && exceeds_noise(resident));
  }
  std::string text(const char* one) const {
    return fmt::format("{:.0f} bytes of heap and {:.0f} of resident memory per {}",
                       std::max(0.0, heap), std::max(0.0, resident), one);
  }

 private:
  bool exceeds_noise(double bytes) const { return bytes * static_cast<double>(count) >= kNoise; }
};

/// What grows in each quarter of the repetitions grows for ever: caches and pools fill up once.
/// `work` returns whether it can be repeated.
template <class Work>
Growth measure(std::size_t wanted, Clock::time_point deadline, Work&& work) {
  for (std::size_t i = 0; i < kWarmUp; ++i) work();
  constexpr std::size_t kQuarters = 4;
  // the number of repetitions that fit is found on the way, and the marks are set by it
  std::vector<Usage> marks(wanted + 1);  // in memory before the first measurement
  std::size_t count = 0;
  marks[0] = usage();
  while (count < wanted && (count < kFewest || Clock::now() < deadline)) {
    if (!work()) break;
    marks[++count] = usage();
  }
  Growth growth{count, 1e300, 1e300};
  const std::size_t length = growth.count / kQuarters;
  if (length == 0) return {};
  for (std::size_t q = 0; q < kQuarters; ++q) {
    const Usage& from = marks[q * length];
    const Usage& to = marks[(q + 1) * length];
    const auto each = static_cast<double>(length);
    growth.heap = std::min(growth.heap, (to.heap - from.heap) / each);
    growth.resident = std::min(growth.resident, (to.resident - from.resident) / each);
  }
  return growth;
}

/// Pages that malloc() keeps although all in them was freed look like a leak of something else, for
/// a while: such a leak has to show again when it has given them back.
template <class Work>
Growth measure_surely(std::size_t wanted, Clock::duration share, Work&& work) {
  const Growth growth = measure(wanted, Clock::now() + share, work);
  if (!growth.is_leak() || growth.heap_leaks()) return growth;
  ::malloc_trim(0);
  return measure(wanted, Clock::now() + share, work);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kIsSanitized = true;  // which has an allocator of its own and keeps what is freed
#else
constexpr bool kIsSanitized = false;
#endif

void live_briefly(const Trial& trial) {
  TestInstance instance = trial.make_instance();
  instance.start();
  instance.run_to(std::min<std::size_t>(5, trial.tested.steps()), false);
  if (!instance.recording().has_ended) instance.terminate();
}

/// Of instances that are made, run and freed one after the other.
Growth growth_by_instances(const Trial& trial, Clock::duration share) {
  std::size_t before = 0;
  return measure_surely(trial.tested.request().instances, share, [&] {
    try {
      live_briefly(trial);
      ++before;
      return true;
    } catch (const core::Error& error) {
      throw Failure(fmt::format("after {} instances in one process: {}", before, error.what()));
    }
  });
}

/// A unit may refuse to go further than the run that it was made for.
Growth growth_by_steps(const Trial& trial, Clock::duration share) {
  TestInstance instance = trial.make_instance();
  instance.start();
  return measure_surely(kMostSteps, share, [&] {
    const std::size_t at = instance.at();
    try {
      instance.run_to(at + 1, false);
    } catch (const core::Error&) {
      if (at < trial.tested.steps()) throw;
      return false;
    }
    return true;
  });
}

}  // namespace

Finding check_memory(const Trial& trial) {
  if (kIsSanitized) return skipped("memory cannot be measured in a build with sanitizers");
  const auto share = trial.tested.request().limit / 5;  // each of two may be measured twice
  trial.tested.fmu().load_library();
  const Leftovers before;
  const bool is_single = trial.tested.description().single_instance;
  const Growth instances = is_single ? Growth{} : growth_by_instances(trial, share);
  const double allowed = trial.tested.request().leak;
  if (instances.is_leak(allowed)) {
    return failed(fmt::format("it leaks {}, over {} instances (allowed: {} and {})",
                              instances.text("instance"), instances.count, kMostHeap + allowed,
                              kMostResident + allowed),
                  {kLeakAdvice});
  }
  const Leftovers after;
  if (!is_single) require_released(before, after, instances.count + kWarmUp);
  const Growth steps = growth_by_steps(trial, share);
  if (steps.is_leak()) {
    return failed(fmt::format("while it runs it grows by {}, over {} steps (allowed: {} and {})",
                              steps.text("step"), steps.count, kMostHeap, kMostResident));
  }
  const std::string of_steps = fmt::format("{} after {} steps", steps.text("step"), steps.count);
  if (is_single) return passed(of_steps);  // by canBeInstantiatedOnlyOncePerProcess
  std::vector<std::string> notes = notes_on(before, after);
  if (instances.is_leak()) {
    notes.push_back(fmt::format("it leaks {}, of which {} are allowed by --leak",
                                instances.text("instance"), allowed));
  }
  return passed(fmt::format("{} after {} instances; {}", instances.text("instance"),
                            instances.count, of_steps),
                std::move(notes));
}

}  // namespace stride::verify
