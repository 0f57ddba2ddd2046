#ifndef STRIDE_MASTER_CHECKS_COUNT_CHECK_H
#define STRIDE_MASTER_CHECKS_COUNT_CHECK_H

#include <cstdint>
#include <optional>
#include <string>

#include "master/checks/check.h"

namespace stride::checks {

/// Count: how many messages travel during the interval.
class CountCheck final : public Check {
 public:
  /// What it demands is a CountDemand.
  explicit CountCheck(const Definition& definition);

  void on_message(const core::Message& message) override;
  void on_point(Time time) override { last_ = time; }
  core::Verdict verdict(const Ending& ending) const override;

 private:
  std::string text() const;

  const CountDemand& demand_;
  std::uint64_t count_ = 0;
  std::optional<Time> exceeded_at_;
  std::optional<Time> last_;  ///< the last communication point
};

}  // namespace stride::checks

#endif
