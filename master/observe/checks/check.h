// One check while a run goes on.
#ifndef STRIDE_MASTER_OBSERVE_CHECKS_CHECK_H
#define STRIDE_MASTER_OBSERVE_CHECKS_CHECK_H

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/engine/port/observer.h"
#include "master/engine/run/verdict.h"
#include "master/observe/checks/definition.h"

namespace stride::checks {

/// How a run has ended.
struct Ending {
  Time reached{};            ///< the last communication point
  bool is_complete = false;  ///< at its stop time, or where a unit wanted; else it failed
};

/// Sees what its definition is about, in simulated order, without allocating (but where a text
/// grows that it keeps).
class Check {
 public:
  /// The definition must outlive the check.
  explicit Check(const Definition& definition) : definition_(definition) {}
  virtual ~Check() = default;
  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  /// The variables whose values it needs.
  virtual std::vector<core::VariableId> signals() const { return {}; }
  /// Before the first communication point: where the values of signals() will be.
  virtual void attach(std::span<const core::Signal> /*signals*/) {}

  virtual void on_message(const core::Message& /*message*/) {}
  /// All messages of that time have been seen.
  virtual void on_point(Time time) = 0;
  /// What it has seen, between two communication points.
  virtual void persist(core::StateArchive& state) = 0;
  /// After the run.
  core::Verdict verdict(const Ending& ending) const {
    core::Verdict verdict = judged(ending);
    if (verdict.passed) verdict.margin = margin(ending);
    verdict.limits = limits();
    return verdict;
  }

 protected:
  /// The verdict without margin and limits.
  virtual core::Verdict judged(const Ending& ending) const = 0;
  /// Of a check that is decided.
  virtual core::Margin margin(const Ending& ending) const = 0;
  /// Of a check of a signal.
  virtual std::optional<core::SignalLimits> limits() const { return std::nullopt; }

  const Definition& definition() const { return definition_; }
  const Window& window() const { return definition_.window; }
  /// Whether nothing more can come that the check is about, `last` being the last instant seen.
  bool is_over(Time last, const Ending& ending) const {
    return window().to ? last >= *window().to : ending.is_complete;
  }
  /// Where the interval ended.
  Time end(const Ending& ending) const { return window().to.value_or(ending.reached); }

  core::Verdict make(std::optional<bool> passed, std::string text) const {
    return {definition_.name, passed, std::move(text), checks::name(definition_.kind),
            definition_.where};
  }
  core::Verdict failed(Time time, std::string text) const {
    core::Verdict verdict = make(false, std::move(text));
    verdict.time = time;
    return verdict;
  }
  core::Verdict cut_short(const Ending& ending) const {
    return make(std::nullopt, "the run ended at " + core::to_text(ending.reached) +
                                  " s, before this was decided");
  }

 private:
  const Definition& definition_;
};

}  // namespace stride::checks

#endif
