#include <algorithm>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/study/verify/checks.h"
#include "master/study/verify/step_outcome.h"

namespace stride::verify {
namespace {

/// Makes stretches of a run again, as a run does with a unit that is taken back to where its state
/// was not saved (CoastingUnit).
class Repeater {
 public:
  Repeater(const Trial& trial, TestInstance& instance)
      : trial_(trial),
        instance_(instance),
        longest_(std::clamp<std::size_t>(trial.tested.steps() / 8, 5, 60)) {}

  void run() {
    instance_.start();
    keep(recorded());
    while (!is_over()) {
      keep(make(point_after(draw(longest_ / 2 + 1)), true));
      if (!is_over()) repeat(point_after(1 + draw(longest_)));
    }
  }

  /// `whole`: the run of an instance that is never taken back.
  void compare_all(const Recording& whole) {
    compare({whole.steps, whole.rows}, all_, "in an instance that is never taken back",
            "in one that repeats steps");
  }

  std::size_t stretches() const { return stretches_; }
  std::size_t longest() const { return longest_; }
  const std::string& rounding() const { return rounding_; }

 private:
  struct Pass {
    std::vector<StepOutcome> steps;
    std::vector<Row> rows;
  };

  bool is_over() const {
    return instance_.recording().has_ended || instance_.at() == trial_.tested.steps();
  }
  std::size_t point_after(std::size_t steps) const {
    return std::min(instance_.at() + steps, trial_.tested.steps());
  }
  /// Below `end`.
  std::size_t draw(std::size_t end) {
    const double random = uniform(trial_.tested.request().seed, draws_++);
    return static_cast<std::size_t>(random * static_cast<double>(end));
  }

  Pass recorded() const { return {instance_.recording().steps, instance_.recording().rows}; }

  Pass make(std::size_t to, bool reads) {
    instance_.clear_recorded();
    instance_.run_to(to, reads);
    return recorded();
  }

  Row present() { return {instance_.now(), instance_.observe(), false}; }

  void keep(const Pass& pass) {
    all_.steps.insert(all_.steps.end(), pass.steps.begin(), pass.steps.end());
    all_.rows.insert(all_.rows.end(), pass.rows.begin(), pass.rows.end());
  }

  void repeat(std::size_t to) {
    ++stretches_;
    instance_.save(0);
    const Pass first = make(to, true);
    const Row end = present();
    keep(first);
    instance_.restore(0);
    compare(first, make(to, true), "after the save", "when the steps are repeated");
    instance_.restore(0);
    make(to, false);  // the values that observers alone want are not read again in a run
    compare({{}, {end}}, {{}, {present()}}, "after the save",
            "when the steps are repeated without reading values in between");
  }

  void compare(const Pass& expected, const Pass& seen, const std::string& expected_when,
               const std::string& seen_when) {
    std::string note;
    auto differs =
        difference_beyond_rounding(expected.steps, seen.steps, expected_when, seen_when, note);
    if (!differs) {
      differs = difference_beyond_rounding(trial_.tested, expected.rows, seen.rows, expected_when,
                                           seen_when, note);
    }
    if (differs) throw Failure(*differs);
    if (rounding_.empty()) rounding_ = note;
  }

  const Trial& trial_;
  TestInstance& instance_;
  std::size_t longest_;  ///< [steps of the grid]
  std::uint64_t draws_ = 0;
  std::size_t stretches_ = 0;
  Pass all_;              ///< without what was repeated
  std::string rounding_;  ///< the first that was seen
};

std::vector<std::string> notes_of(const std::string& rounding) {
  if (rounding.empty()) return {};
  return {rounding +
          "; where a rollback must be exact, <stride:StateSaving components=\"…\" "
          "eachStep=\"true\"/> saves its state before each step, and none is repeated"};
}

}  // namespace

Finding check_repetition(const Trial& trial) {
  const core::UnitDescription& unit = trial.tested.description();
  if (!unit.can_save_state) return skipped("it has no canGetAndSetFMUState");
  const TestInstanceOptions options{.split = unit.can_vary_step ? Split::Random : Split::None};
  const Recording whole = trial.record(options);
  TestInstance instance = trial.make_instance(options);
  Repeater repeater(trial, instance);
  repeater.run();
  repeater.compare_all(whole);
  const std::string outcome =
      repeater.rounding().empty() ? "the same bits" : "the same but for rounding";
  return passed(fmt::format("{} of at most {}, each repeated twice: {}",
                            core::counted(repeater.stretches(), "stretch", "stretches"),
                            core::counted(repeater.longest(), "step"), outcome),
                notes_of(repeater.rounding()));
}

}  // namespace stride::verify
