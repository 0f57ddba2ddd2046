#ifndef STRIDE_MASTER_OBSERVE_CHECKS_SIGNAL_CHECK_H
#define STRIDE_MASTER_OBSERVE_CHECKS_SIGNAL_CHECK_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/observe/checks/check.h"

namespace stride::checks {

/// Always, Never, Eventually, Final: a signal's values at the communication points. NaN never is as
/// it should be. Its margin is the robustness of signal temporal logic over these points, so a
/// check that is decided goes on to the end of its interval.
class SignalCheck final : public Check {
 public:
  /// What it demands is a SignalDemand.
  explicit SignalCheck(const Definition& definition);

  std::vector<core::VariableId> signals() const override { return {demand_.id}; }
  void attach(std::span<const core::Signal> signals) override;
  void on_point(Time time) override;
  /// Behind attach().
  void persist(core::StateArchive& state) override;

 private:
  /// A communication point.
  struct Point {
    Truth truth = Truth::False;
    double robustness = 0;  ///< that of the condition, or with Never of its opposite
    Time time{};
  };

  Point present(Time time) const;
  void judge(const Point& point);
  /// Keeps the present value.
  void keep(Truth truth);
  void extend_range();
  void extend_margin(const Point& point);
  bool is_good(Truth truth) const { return truth == good_; }

  core::Verdict judged(const Ending& ending) const override;
  core::Margin margin(const Ending& ending) const override;
  std::optional<core::SignalLimits> limits() const override;
  core::Verdict bad(Time time) const;
  core::Verdict lasting_verdict() const;
  core::Verdict eventual_verdict(const Ending& ending) const;
  core::Verdict unseen_verdict() const;
  std::string kept_text() const;

  const SignalDemand& demand_;
  Truth good_;
  const core::ValueBlock* block_ = nullptr;
  std::size_t at_ = 0;

  std::optional<Point> before_;    ///< the last one before the interval
  std::optional<Point> after_;     ///< the first one behind it
  std::optional<Point> decisive_;  ///< that with the least margin; of Eventually: with the greatest
  std::uint64_t points_ = 0;       ///< in the interval
  std::optional<Time> decided_at_;  ///< a failure, or what is eventually so
  std::optional<Time> last_;        ///< the last point that was seen
  core::ValueBlock kept_;
  Truth kept_truth_ = Truth::False;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

}  // namespace stride::checks

#endif
