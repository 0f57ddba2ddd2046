#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

constexpr int kDoublings = 12;
constexpr std::size_t kMostRejections = 20;

/// What can be observed of a unit in Step Mode.
struct Fingerprint {
  Row row;
  std::vector<std::uint8_t> bytes;  ///< of its state, where it can be serialised
};

Fingerprint fingerprint(const Trial& trial, TestInstance& instance) {
  Fingerprint print{{instance.now(), instance.observe(), false}, {}};
  if (!trial.tested.description().can_serialize_state) return print;
  instance.capability<core::StateSaving>().save_state();
  print.bytes = instance.capability<core::StateSerialization>().serialize_state();
  return print;
}

/// Tries longer and longer steps, and after each rejection shorter ones.
class RejectionProbe {
 public:
  RejectionProbe(const Trial& trial, TestInstance& instance) : trial_(trial), instance_(instance) {}

  void run() {
    Duration size = trial_.tested.step();
    for (int i = 0; i < kDoublings && !is_over(); ++i, size *= 2) {
      const auto& most = trial_.tested.description().maximum_step;
      if (most) size = std::min(size, most->rounded());
      attempt(size);
    }
  }
  const std::vector<Time>& reached() const { return reached_; }
  std::size_t rejections() const { return rejections_; }
  Duration longest() const { return longest_; }
  const std::string& error() const { return error_; }

 private:
  bool is_over() const {
    return instance_.recording().has_ended || rejections_ >= kMostRejections || !error_.empty();
  }

  void attempt(Duration size) {
    const Fingerprint before = fingerprint(trial_, instance_);
    const Time begin = instance_.now();
    while (!make(begin + size)) {
      if (!error_.empty()) return;
      ++rejections_;
      compare(before, begin + size);
      size /= 2;
      if (size < std::chrono::nanoseconds(1)) {
        throw Failure(fmt::format("at {} s it rejects every step", core::to_text(begin)));
      }
    }
    longest_ = std::max(longest_, size);
    reached_.push_back(instance_.now());
  }

  /// An error is a way to refuse a step, too, but it ends the run.
  bool make(Time to) {
    try {
      return instance_.try_step(to);
    } catch (const core::Error& error) {
      error_ = error.what();
      return false;
    }
  }

  void compare(const Fingerprint& before, Time to) {
    const Fingerprint after = fingerprint(trial_, instance_);
    const std::string when = fmt::format("after it has rejected a step to {} s", core::to_text(to));
    const auto differs = difference(trial_.tested, {before.row}, {after.row}, "before", when);
    if (differs) throw Failure(*differs);
    if (before.bytes == after.bytes) return;
    throw Failure(fmt::format("at {} s its serialised state is another one {}",
                              core::to_text(instance_.now()), when));
  }

  const Trial& trial_;
  TestInstance& instance_;
  std::vector<Time> reached_;
  std::size_t rejections_ = 0;
  Duration longest_{};
  std::string error_;
};

/// The values of an instance that makes the accepted steps alone.
std::vector<std::string> values_without_rejections(const Trial& trial, std::size_t from,
                                                   const std::vector<Time>& steps) {
  const Recording twin = recording_from_text(trial.in_child([&] {
    TestInstance instance = trial.make_instance();
    instance.start();
    instance.run_to(from, false);
    for (const Time to : steps) {
      if (!instance.try_step(to)) {
        throw Failure(
            fmt::format("a step to {} s that it accepted after a rejection it rejects "
                        "without one",
                        core::to_text(to)));
      }
    }
    return to_text(Recording{{{instance.now(), instance.observe(), false}}});
  }));
  return twin.rows.front().values;
}

/// Throws Failure if the rejected steps have changed what the instance computes.
void require_no_effect(const Trial& trial, std::size_t from, const RejectionProbe& probe,
                       TestInstance& instance) {
  const auto twin = values_without_rejections(trial, from, probe.reached());
  const Time now = instance.now();
  const auto differs =
      difference(trial.tested, {{now, twin, false}}, {{now, instance.observe(), false}},
                 "without rejected steps", "with them");
  if (differs) throw Failure(*differs);
}

void require_allowed(const core::UnitDescription& unit, std::size_t rejections) {
  if (unit.may_reject || rejections == 0) return;
  throw Failure(fmt::format("it rejects {}, though it declares mayReject=\"false\"",
                            core::counted(rejections, "step")),
                false);
}

/// Steps of other sizes than its own cannot be tried.
Finding finding_of_fixed_step(std::size_t rejections) {
  if (rejections > 0) {
    return passed(core::counted(rejections, "step") + " rejected, and made in parts");
  }
  return skipped(
      "it rejects no step of its size, and has no canHandleVariableCommunicationStepSize");
}

}  // namespace

Finding check_rejection(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  const Recording run = trial.record();
  require_allowed(unit, run.rejections);
  if (!unit.can_vary_step) return finding_of_fixed_step(run.rejections);
  const std::size_t from = trial.point_at(0.2);
  TestInstance instance = trial.make_instance();
  instance.start();
  instance.run_to(from, false);
  RejectionProbe probe(trial, instance);
  probe.run();
  require_allowed(unit, probe.rejections());
  std::vector<std::string> notes;
  if (!probe.error().empty()) notes.push_back("a longer step is an error: " + probe.error());
  if (probe.rejections() == 0) {
    return passed(fmt::format("no step is rejected, up to {} s", core::to_text(probe.longest())),
                  std::move(notes));
  }
  if (probe.error().empty()) require_no_effect(trial, from, probe, instance);
  return passed(fmt::format("{} rejected, nothing changed; shorter ones are accepted",
                            core::counted(probe.rejections() + run.rejections, "step")),
                std::move(notes));
}

}  // namespace stride::verify
