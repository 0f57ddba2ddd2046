// Inputs for a unit that promises to be idle.
#ifndef STRIDE_MASTER_STUDY_VERIFY_IDLE_STIMULUS_H
#define STRIDE_MASTER_STUDY_VERIFY_IDLE_STIMULUS_H

#include <cstddef>
#include <cstdint>
#include <optional>

#include "master/study/verify/stimulus.h"

namespace stride::verify {

/// How an input with a deadband moves between two jumps.
enum class Wander { Still, WithinDeadbands };
/// How far inputs jump: to the values of Stimulus, or far beyond them, where min and max allow it.
/// Once and Late: near, all of them at one point, and nothing else happens; with Once soon after
/// the start, with Late in the last tenth of the run, and Event Mode is entered there. Never:
/// nothing at all.
enum class Jump { Near, Far, Once, Late, Never };

/// Inputs that jump at random points, and mostly beyond their deadbands. In between they stay what
/// they are, or move at random such that two values are never further apart than the deadband.
/// Event Mode is entered without a reason at random points, too. Like every stimulus a function of
/// the seed and the point alone, and with Jump::Late of the number of points.
class IdleStimulus final : public Stimulus {
 public:
  IdleStimulus(const TestedUnit& tested, std::uint64_t seed, Wander wander, Jump jump);

  bool changes_at(std::size_t k) const override;
  bool ticks_at(std::size_t k) const override;
  core::ValueBlock value(const Input& input, std::size_t k) const override;

 private:
  std::size_t jumps_until(const Input& input, std::size_t k) const;
  bool is_quiet() const { return jump_ != Jump::Near && jump_ != Jump::Far; }
  double element(const Input& input, double start, double other, std::uint64_t jump) const;

  const core::UnitDescription& unit_;
  std::uint64_t seed_;
  Wander wander_;
  Jump jump_;
  std::optional<std::size_t> only_jump_;  ///< the point
};

}  // namespace stride::verify

#endif
