#ifndef STRIDE_MASTER_VERIFY_TRIAL_H
#define STRIDE_MASTER_VERIFY_TRIAL_H

#include <functional>
#include <string>

#include "master/isolation/process/child.h"
#include "master/isolation/process/shared_note.h"
#include "master/verify/test_instance.h"
#include "master/verify/tested_unit.h"

namespace stride::verify {

/// What a check works with. It runs in a process of its own, in which the unit's library was not
/// loaded before.
struct Trial {
  const TestedUnit& tested;
  process::SharedNote& note;

  /// An instance in this process.
  TestInstance make_instance(TestInstanceOptions options = {}) const {
    return TestInstance(tested, note, std::move(options));
  }

  /// Does the work in a further process, which begins as this one did if no library is loaded here.
  /// Throws Failure with what the work has thrown, or with how it ended otherwise.
  std::string in_child(const std::function<std::string()>& work) const;

  /// A whole run of an instance, to point `to` of the grid (0 = to its end), in a further process.
  Recording record(const TestInstanceOptions& options = {}, std::size_t to = 0) const;

  /// The points of the grid that stand at these shares of it.
  std::size_t point_at(double share) const {
    return static_cast<std::size_t>(share * static_cast<double>(tested.steps()));
  }
};

/// "it crashed with signal 11 (SIGSEGV) in fmi3Reset at 0.1 s", for what ended otherwise than by an
/// answer or an exception.
std::string explain(const process::ChildOutcome& outcome, const process::SharedNote& note);

}  // namespace stride::verify

#endif
