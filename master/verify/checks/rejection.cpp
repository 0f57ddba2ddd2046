#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "master/util/error.h"
#include "master/verify/checks.h"

namespace stride::verify {
namespace {

constexpr int kDoublings = 12;
constexpr std::size_t kMostRejections = 20;

/// What can be told of a unit in Step Mode.
struct Portrait {
  Row row;
  std::vector<std::uint8_t> bytes;  ///< of its state, where it can be serialised
};

Portrait portrait(const Trial& trial, Life& life) {
  Portrait picture{{life.now().time_since_epoch().count(), life.observe(), false}, {}};
  if (!trial.subject.description().can_serialize_state) return picture;
  life.capability<core::StateSaving>().save_state();
  picture.bytes = life.capability<core::StateSerialization>().serialize_state();
  return picture;
}

/// Tries longer and longer steps, and after each rejection shorter ones.
class Daring {
 public:
  Daring(const Trial& trial, Life& life) : trial_(trial), life_(life) {}

  void run() {
    Duration size = trial_.subject.step();
    for (int i = 0; i < kDoublings && !is_over(); ++i, size *= 2) {
      if (const auto& most = trial_.subject.description().maximum_step)
        size = std::min(size, *most);
      attempt(size);
    }
  }
  const std::vector<Time>& reached() const { return reached_; }
  std::size_t rejections() const { return rejections_; }
  Duration longest() const { return longest_; }
  const std::string& error() const { return error_; }

 private:
  bool is_over() const {
    return life_.recording().has_ended || rejections_ >= kMostRejections || !error_.empty();
  }

  void attempt(Duration size) {
    const Portrait before = portrait(trial_, life_);
    const Time begin = life_.now();
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
    reached_.push_back(life_.now());
  }

  /// An error is a way to refuse a step, too, but it ends the life.
  bool make(Time to) {
    try {
      return life_.try_step(to);
    } catch (const core::Error& error) {
      error_ = error.what();
      return false;
    }
  }

  void compare(const Portrait& before, Time to) {
    const Portrait after = portrait(trial_, life_);
    const std::string when = fmt::format("after it has rejected a step to {} s", core::to_text(to));
    const auto differs = difference(trial_.subject, {before.row}, {after.row}, "before", when);
    if (differs) throw Failure(*differs);
    if (before.bytes == after.bytes) return;
    throw Failure(fmt::format("at {} s its serialised state is another one {}",
                              core::to_text(life_.now()), when));
  }

  const Trial& trial_;
  Life& life_;
  std::vector<Time> reached_;
  std::size_t rejections_ = 0;
  Duration longest_{};
  std::string error_;
};

/// The values of a life that makes the accepted steps alone.
std::vector<std::string> values_without_rejections(const Trial& trial, std::size_t from,
                                                   const std::vector<Time>& steps) {
  const Recording twin = recording_from_text(trial.in_child([&] {
    Life life = trial.live();
    life.start();
    life.run_to(from, false);
    for (const Time to : steps) {
      if (!life.try_step(to)) {
        throw Failure(
            fmt::format("a step to {} s that it accepted after a rejection it rejects "
                        "without one",
                        core::to_text(to)));
      }
    }
    return to_text(Recording{{{life.now().time_since_epoch().count(), life.observe(), false}}});
  }));
  return twin.rows.front().values;
}

}  // namespace

Finding check_rejection(const Trial& trial) {
  const Subject& subject = trial.subject;
  const core::UnitDescription& unit = subject.description();
  const Recording run = trial.record();
  const auto fail_if_denied = [&](std::size_t rejections) {
    if (unit.may_reject || rejections == 0) return;
    throw Failure(
        fmt::format("it rejects {} steps, though it declares mayReject=\"false\"", rejections));
  };
  fail_if_denied(run.rejections);
  if (!unit.can_vary_step) {
    return run.rejections == 0
               ? skipped(
                     "it rejects no step of its size, and has no "
                     "canHandleVariableCommunicationStepSize")
               : passed(fmt::format("{} steps are rejected, and made in parts", run.rejections));
  }
  const std::size_t from = trial.point_at(0.2);
  Life life = trial.live();
  life.start();
  life.run_to(from, false);
  Daring daring(trial, life);
  daring.run();
  fail_if_denied(daring.rejections());
  std::vector<std::string> notes;
  if (!daring.error().empty()) notes.push_back("a longer step is an error: " + daring.error());
  if (daring.rejections() == 0) {
    return passed(
        fmt::format("no step is rejected, up to {} s", core::to_text(Time(daring.longest()))),
        std::move(notes));
  }
  if (daring.error().empty()) {
    const auto twin = values_without_rejections(trial, from, daring.reached());
    const std::int64_t now = life.now().time_since_epoch().count();
    const auto differs = difference(subject, {{now, twin, false}}, {{now, life.observe(), false}},
                                    "without rejected steps", "with them");
    if (differs) throw Failure(*differs);
  }
  return passed(fmt::format("{} steps rejected, nothing changed; shorter ones are accepted",
                            daring.rejections() + run.rejections),
                std::move(notes));
}

}  // namespace stride::verify
