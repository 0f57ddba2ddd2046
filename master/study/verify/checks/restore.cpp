#include <fmt/format.h>

#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

constexpr std::size_t kEarly = 0, kLate = 1, kBeginning = 2;

class Restorer {
 public:
  Restorer(const Trial& trial, TestInstance& instance) : trial_(trial), instance_(instance) {}

  /// Saves here, and notes what follows until point `to`.
  void save(std::size_t slot, std::size_t to) {
    instance_.save(slot);
    const std::vector<std::string> values = instance_.observe();
    instance_.clear_recorded();
    instance_.run_to(to);
    expected_[slot] = {to, values, instance_.recording().rows};
  }

  void restore(std::size_t slot, const std::string& when) {
    const Expected& expected = expected_[slot];
    instance_.restore(slot);
    const Time now = instance_.now();
    compare({{now, expected.values, false}}, {{now, instance_.observe(), false}},
            "when it was saved", "when it is restored" + when);
    instance_.clear_recorded();
    instance_.run_to(expected.to);
    compare(expected.rows, instance_.recording().rows, "after the save",
            "after the restore" + when);
  }

  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct Expected {
    std::size_t to = 0;
    std::vector<std::string> values;
    std::vector<Row> rows;
  };

  void compare(const std::vector<Row>& expected, const std::vector<Row>& seen,
               const std::string& expected_when, const std::string& seen_when) {
    std::string note;
    const auto differs =
        difference_beyond_rounding(trial_.tested, expected, seen, expected_when, seen_when, note);
    if (differs) throw Failure(*differs);
    if (notes_.empty() && !note.empty()) notes_.push_back(note);
  }

  const Trial& trial_;
  TestInstance& instance_;
  Expected expected_[3];
  std::vector<std::string> notes_;  ///< of the first rounding that was seen
};

}  // namespace

Finding check_restore(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  if (!tested.description().can_save_state) return skipped("it has no canGetAndSetFMUState");
  TestInstance instance = trial.make_instance();
  Restorer restorer(trial, instance);
  const std::size_t early = trial.point_at(0.3);
  const std::size_t late = trial.point_at(0.7);
  instance.start();
  restorer.save(kBeginning, early);
  restorer.save(kEarly, late);
  restorer.restore(kEarly, "");
  restorer.restore(kEarly, " for the second time");
  restorer.save(kLate, tested.steps());
  restorer.restore(kEarly, " from a later instant, with another state saved meanwhile");
  restorer.restore(kLate, " from an earlier instant");
  restorer.restore(kBeginning, " of the beginning");
  return passed(fmt::format("three states alive at once, five restores, each followed by {} to {} "
                            "steps",
                            std::min(early, late - early), tested.steps() - early),
                restorer.notes());
}

}  // namespace stride::verify
