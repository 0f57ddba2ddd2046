#ifndef STRIDE_MASTER_CHECKS_SIGNAL_CHECK_H
#define STRIDE_MASTER_CHECKS_SIGNAL_CHECK_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "master/checks/check.h"

namespace stride::checks {

/// Always, Never, Eventually, Final: a signal's values at the communication points. NaN never is as
/// it should be.
class SignalCheck final : public Check {
 public:
  /// What it demands is a SignalDemand.
  explicit SignalCheck(const Definition& definition);

  core::VariableId id() const { return demand_.id; }
  /// Before the first communication point: where its value will be.
  void attach(const core::Signal& signal);

  void on_point(Time time) override;
  /// Behind attach().
  void persist(core::StateArchive& state) override;
  core::Verdict verdict(const Ending& ending) const override;

 private:
  void judge(Time time, Truth truth);
  /// Keeps the present value.
  void keep(Truth truth);
  void extend_range();
  bool is_good(Truth truth) const { return truth == good_; }

  core::Verdict bad(Time time) const;
  core::Verdict lasting_verdict() const;
  core::Verdict eventual_verdict(const Ending& ending) const;
  core::Verdict unseen_verdict() const;
  std::string kept_text() const;

  const SignalDemand& demand_;
  Truth good_;
  const core::ValueBlock* block_ = nullptr;
  std::size_t at_ = 0;

  std::optional<Truth> before_;     ///< at the last point before the interval
  std::optional<Truth> after_;      ///< at the first point behind it
  std::uint64_t points_ = 0;        ///< in it
  std::optional<Time> decided_at_;  ///< a failure, or what is eventually so
  std::optional<Time> last_;        ///< the last point that was seen
  core::ValueBlock kept_;
  Truth kept_truth_ = Truth::False;
  double least_ = std::numeric_limits<double>::infinity();
  double most_ = -std::numeric_limits<double>::infinity();
};

}  // namespace stride::checks

#endif
