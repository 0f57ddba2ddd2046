// The checks, each in a file of its own under checks/, and what they work with. docs/verify.md says
// what they mean.
#ifndef STRIDE_MASTER_STUDY_VERIFY_CHECKS_H
#define STRIDE_MASTER_STUDY_VERIFY_CHECKS_H

#include <functional>
#include <string>
#include <vector>

#include "master/base/child_process/child.h"
#include "master/loader/fmu/instance/call_note.h"
#include "master/study/verify/finding.h"
#include "master/study/verify/test_instance.h"
#include "master/study/verify/tested_unit.h"

namespace stride::verify {

/// What a check works with. It runs in a process of its own, in which the unit's library was not
/// loaded before.
struct Trial {
  const TestedUnit& tested;
  importer::CallNote& note;  ///< in memory that outlives that process

  /// An instance in this process.
  TestInstance make_instance(TestInstanceOptions options = {}) const {
    return TestInstance(tested, note, std::move(options));
  }

  /// Does the work in a further process, which starts as this one did if no library is loaded here.
  /// Throws Failure with what the work has thrown, or with how it ended otherwise.
  std::string in_child(const std::function<std::string()>& work) const;

  /// A whole run of an instance, to point `to` of the grid (0 = to its end), in a further process.
  Recording record(const TestInstanceOptions& options = {}, std::size_t to = 0) const;

  /// Whether the unit is made with stride's kit, which refuses what the standards leave open.
  bool is_of_kit() const;

  /// The point of the grid at this share of it.
  std::size_t point_at(double share) const {
    return static_cast<std::size_t>(share * static_cast<double>(tested.steps()));
  }
};

/// "it crashed with signal 11 (SIGSEGV) in fmi3Reset at 0.1 s", for what ended otherwise than by an
/// answer or an exception.
std::string explain(const isolation::ChildOutcome& outcome, const importer::CallNote& note);

/// The sections of the standards with the rule that a check is about; null: there is none.
struct Rules {
  const char* fmi2 = nullptr;
  const char* fmi3 = nullptr;
};

struct UnitCheck {
  const char* name;
  const char* summary;  ///< what passes, in a line
  Finding (*run)(const Trial& trial);
  Rules rules{};
};

/// "FMI 3.0, 2.2.7.4": the rule for a unit of this version; empty if there is none.
std::string rule_of(const Rules& rules, const std::string& fmi_version);

/// In the order in which they are run. The first is the one without which no other makes sense.
const std::vector<UnitCheck>& checks();

Finding check_load(const Trial& trial);
Finding check_description(const Trial& trial);
Finding check_values(const Trial& trial);
Finding check_dependencies(const Trial& trial);
Finding check_events(const Trial& trial);
Finding check_calls(const Trial& trial);
Finding check_idle(const Trial& trial);
Finding check_messages(const Trial& trial);
Finding check_splitting(const Trial& trial);
Finding check_rejection(const Trial& trial);
Finding check_reset(const Trial& trial);
Finding check_instances(const Trial& trial);
Finding check_restore(const Trial& trial);
Finding check_repetition(const Trial& trial);
Finding check_serialization(const Trial& trial);
Finding check_memory(const Trial& trial);
Finding check_determinism(const Trial& trial);

}  // namespace stride::verify

#endif
