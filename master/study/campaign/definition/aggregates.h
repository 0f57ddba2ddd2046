// Numbers that sum up signals of a run.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_AGGREGATES_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_AGGREGATES_H

#include <optional>
#include <span>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"
#include "master/study/campaign/definition/definition.h"

namespace stride::campaign {

/// Reads signals at the communication points of a run. Added to a simulation with signals(), which
/// RunOptions::watched has to hold.
class Aggregates final : public core::Observer {
 public:
  /// Throws core::Error (Input) for a signal that the system does not have: another unit may have
  /// been swapped in.
  Aggregates(const std::vector<Aggregate>& aggregates, const core::System& system);

  /// One for each aggregate.
  const std::vector<core::VariableId>& signals() const { return signals_; }

  void on_start(std::span<const core::Signal> signals) override;
  void on_communication_point(Time time) override;

  /// What is known so far. Mean and integral are those of straight lines between communication
  /// points (the trapezoidal rule), the mean over the simulated time. At an instant it is the value
  /// at the last communication point that is not later. A boolean counts as 0 or 1.
  std::vector<std::optional<double>> values() const;

 private:
  struct Sum {
    Aggregate::Function function;
    Time at;
    core::Signal signal{};
    double last = 0;
    double result = 0;  ///< of mean and integral the integral
    double error = 0;   ///< of the summation (Kahan, Neumaier)
    bool is_known = false;
  };

  void add(Sum& sum, double value, Time time) const;

  std::vector<Sum> sums_;
  std::vector<core::VariableId> signals_;
  std::optional<Time> start_, last_;
};

}  // namespace stride::campaign

#endif
