#include <fmt/format.h>

#include "master/verify/checks.h"

namespace stride::verify {

Finding check_reset(const Trial& trial) {
  const Subject& subject = trial.subject;
  const Recording fresh = trial.record();
  Life life = trial.live();
  const auto compare = [&](const char* state) {
    life.reset();
    life.start();
    life.run_to(subject.steps());
    const auto differs = difference(subject, fresh.rows, life.recording().rows, "in a new instance",
                                    fmt::format("after a reset {}", state));
    if (differs) throw Failure(*differs);
  };
  life.start();
  life.run_to(trial.point_at(0.6));
  compare("in Step Mode");
  life.terminate();
  compare("of a terminated instance");
  life.reset();
  life.set_start_values();
  life.enter_initialization();
  compare("in Initialization Mode");
  return passed(fmt::format("three runs of {} steps after a reset are like that of a new instance",
                            subject.steps()));
}

}  // namespace stride::verify
