#ifndef STRIDE_MASTER_OBSERVE_CHECKS_UNTIL_CHECK_H
#define STRIDE_MASTER_OBSERVE_CHECKS_UNTIL_CHECK_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/observe/checks/check.h"

namespace stride::checks {

/// Until: a signal keeps to a condition at each communication point of the interval before one at
/// which another signal meets a second condition, and there is such a point. NaN never is as it
/// should be. Its margin is the robustness of signal temporal logic over these points, so a check
/// that is decided goes on to the end of its interval.
class UntilCheck final : public Check {
 public:
  /// What it demands is an UntilDemand.
  explicit UntilCheck(const Definition& definition);

  std::vector<core::VariableId> signals() const override;
  void attach(std::span<const core::Signal> signals) override;
  void on_point(Time time) override;
  void persist(core::StateArchive& state) override;

 private:
  /// One of the two signals.
  struct Side {
    explicit Side(const SignalDemand& wanted) : demand(wanted), kept(core::ValueType::Boolean, 1) {}

    Judgement judge() const { return demand.condition.judge(*block, at); }
    std::string kept_text() const { return demand.condition.value_text(kept, 0); }

    const SignalDemand& demand;
    const core::ValueBlock* block = nullptr;
    std::size_t at = 0;
    core::ValueBlock kept;  ///< where it was decided, or else at the last point
  };
  /// A distance that is the least of some.
  struct Distance {
    double robustness = 0;
    bool is_of_end = false;  ///< of the condition that ends it, else of the one that is kept
    Time time{};
  };

  void judge(Time time, Truth holds, Truth ends);
  void extend_margin(Time time, double holds, double ends);

  core::Verdict judged(const Ending& ending) const override;
  core::Margin margin(const Ending& ending) const override;
  core::Verdict bad(Time time, const Side& side, const std::string& expected) const;

  Side holds_, ends_;
  std::optional<Distance> least_held_;  ///< up to the last point
  std::optional<Distance> best_;        ///< of all points as the one that ends it
  std::uint64_t points_ = 0;            ///< in the interval
  std::optional<Time> decided_at_;
  bool has_ended_ = false;    ///< decided_at_ is where it ended well
  std::optional<Time> last_;  ///< the last point that was seen
};

}  // namespace stride::checks

#endif
