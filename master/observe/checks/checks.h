// The checks of a scenario, as an observer of its run.
#ifndef STRIDE_MASTER_OBSERVE_CHECKS_CHECKS_H
#define STRIDE_MASTER_OBSERVE_CHECKS_CHECKS_H

#include <memory>
#include <span>
#include <vector>

#include "master/engine/port/observer.h"
#include "master/engine/run/verdict.h"
#include "master/observe/checks/check.h"
#include "master/observe/checks/definition.h"

namespace stride::checks {

/// Judges a run by the values at its communication points and by its messages. Added to a
/// simulation with signals(), which RunOptions::watched has to hold.
class Checks final : public core::Observer {
 public:
  explicit Checks(std::vector<Definition> definitions);

  bool is_empty() const { return checks_.empty(); }
  /// The variables whose values the checks need.
  std::vector<core::VariableId> signals() const;

  void on_start(std::span<const core::Signal> signals) override;
  void on_message(const core::Message& message) override;
  void on_communication_point(Time time) override;

  /// What the checks have seen, at a communication point, behind on_start(). Reading throws
  /// core::BadState for the state of other checks.
  void persist(core::StateArchive& state);

  /// In the order of the definitions; after the run, also where it never began.
  std::vector<core::Verdict> verdicts(const Ending& ending) const;

 private:
  std::vector<Definition> definitions_;
  std::vector<std::unique_ptr<Check>> checks_;
  std::vector<Check*> message_checks_;
};

}  // namespace stride::checks

#endif
