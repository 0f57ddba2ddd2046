// A run that is cut at a communication point: another simulation goes on from its state, with the
// same instances of the units.
#ifndef STRIDE_TESTS_MASTER_ENGINE_RUN_CUT_RUN_H
#define STRIDE_TESTS_MASTER_ENGINE_RUN_CUT_RUN_H

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "master/base/state_archive.h"
#include "master/engine/run/simulation.h"

namespace stride::tests {

/// All that observers can see of a run, as text in its order.
class Trace : public core::Observer {
 public:
  explicit Trace(const core::System& system) : system_(system) {}

  void on_start(std::span<const core::Signal> signals) override;
  bool watches_activities() const override { return true; }
  void on_message(const core::Message& message) override;
  void on_intervention(Time time, std::uint32_t index, core::VariableId id,
                       std::string_view text) override;
  void on_activity(const core::Activity& activity) override;
  void on_communication_point(Time time) override;

  const std::string& text() const { return text_; }
  const std::vector<Time>& points() const { return points_; }
  /// How the run failed.
  void note(const core::Error& error) { text_ += error.what(); }
  /// Drops what was observed since.
  void cut(std::size_t size) { text_.resize(size); }
  /// The run fails behind so many points.
  std::size_t most_points = 1'000'000;

 private:
  const core::System& system_;
  std::vector<core::Signal> signals_;
  std::string text_;
  std::vector<Time> points_;
};

/// Instances of units that one simulation after the other uses.
using SharedUnits = std::vector<std::shared_ptr<core::Unit>>;
SharedUnits share(std::vector<std::unique_ptr<core::Unit>> units);

struct CutRun {
  const core::System& system;
  SharedUnits units;
  Trace& trace;

  /// Up to the pause, or as a run that goes on from `state` up to there. Returns the state; nothing
  /// if the run ends before. A unit that is called behind the pause throws.
  std::vector<std::byte> up_to(const core::Pause& pause, const core::RunOptions& options,
                               const std::vector<std::byte>& state = {});
  /// Likewise, up to the communication point of this number, at which the run is interrupted.
  std::vector<std::byte> up_to_point(std::size_t point, core::RunOptions options);
  /// From the state to the end, or to a failure, which the trace ends with.
  core::RunStatistics from(const std::vector<std::byte>& state, const core::RunOptions& options);

  /// up_to(), with a further observer.
  std::vector<std::byte> cut(const std::optional<core::Pause>& pause,
                             const core::RunOptions& options, const std::vector<std::byte>& state,
                             core::Observer* observer);
};

}  // namespace stride::tests

#endif
