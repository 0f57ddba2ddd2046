#include <fmt/format.h>

#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

void compare(const Trial& trial, const Recording& alone, const TestInstance& instance,
             const char* which) {
  const auto differs = difference(trial.tested, alone.rows, instance.recording().rows,
                                  "in an instance that is alone", which);
  if (differs) throw Failure(*differs);
}

}  // namespace

Finding check_instances(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  if (tested.description().single_instance) {
    return skipped("it declares canBeInstantiatedOnlyOncePerProcess");
  }
  const Recording alone = trial.record();
  const std::size_t steps = tested.steps();
  std::optional<TestInstance> first(trial.make_instance({.name = "first"}));
  std::optional<TestInstance> second(
      trial.make_instance({.name = "second", .seed = tested.request().seed + 1}));
  std::optional<TestInstance> third;
  first->start();
  second->start();
  // the second is ahead, with other inputs; half-way the third takes its place
  for (std::size_t k = 0; k < steps; ++k) {
    if (second) second->run_to(std::min(steps, 2 * k + 2), false);
    if (k == steps / 2) {
      second.reset();
      third.emplace(trial.make_instance({.name = "third"}));
      third->start();
    }
    if (third) third->run_to(2 * (k - steps / 2));
    first->run_to(k + 1);
  }
  compare(trial, alone, *first, "in one beside others");
  first.reset();
  third->run_to(steps);
  compare(trial, alone, *third, "in one that was made later beside others");
  return passed(
      fmt::format("three instances, two at a time, are each like one that is alone, for {} "
                  "steps",
                  steps));
}

}  // namespace stride::verify
