#include <fmt/format.h>

#include "master/study/verify/checks.h"
#include "master/study/verify/disturbance.h"

namespace stride::verify {
Finding check_determinism(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  const Recording first = trial.record();
  const Recording second = recording_from_text(trial.in_child([&] {
    disturb();
    TestInstance instance = trial.make_instance();
    instance.start();
    instance.run_to(tested.steps());
    return to_text(instance.recording());
  }));
  const auto differs = difference(tested, first.rows, second.rows, "in one process",
                                  "in another, whose memory is not zero and at other addresses");
  if (differs) return failed(*differs);
  return passed(fmt::format("two processes, {} values at {} instants", tested.observed_count(),
                            first.rows.size()));
}

}  // namespace stride::verify
