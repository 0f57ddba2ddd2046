#ifndef STRIDE_MASTER_CLI_PROGRESS_H
#define STRIDE_MASTER_CLI_PROGRESS_H

#include <chrono>
#include <optional>
#include <string>

#include "master/algorithm/observer.h"
#include "master/algorithm/simulation.h"
#include "master/cli/pace.h"

namespace stride::cli {

/// How the progress of a run is shown, on the standard error stream.
enum class ProgressStyle {
  Auto,   ///< a line that is rewritten on a terminal, Plain elsewhere
  Plain,  ///< a line now and then, as for a log
  Json,   ///< an object a line, for programs
  None,
};

/// From "auto", "plain", "json" or "none". Throws core::Error (Input) for anything else.
ProgressStyle read_progress_style(const std::string& text);

/// Shows the progress of a run: the simulated share, the speed relative to real time, the time left
/// at this speed, and the share of the units' time in which they were suspended.
class Progress : public core::Observer {
 public:
  /// The simulation must outlive this object.
  Progress(ProgressStyle style, Time start, Time stop, const core::Simulation& simulation);

  void on_start(std::span<const core::Signal> signals) override;
  void on_communication_point(Time time) override;
  /// The run is over. Json writes how it ended.
  void end(const std::string& outcome);

 private:
  using Clock = Pace::Clock;
  enum class Form { Nothing, Rewritten, Lines, Json };

  struct State {
    double share;                ///< of the run that is simulated, 0 to 1
    double wall;                 ///< elapsed time [s]
    double speed;                ///< simulated seconds in a second
    double skipped;              ///< share of the units' time that was skipped, 0 to 1
    std::optional<double> left;  ///< [s]
  };

  static Form form_of(ProgressStyle style);
  bool is_due(Time time, Clock::time_point now) const;
  State state() const;
  void show(const State& state) const;
  void show_json(const State& state, const std::string* outcome) const;

  Form form_;
  Time start_, stop_;
  const core::Simulation& simulation_;
  std::optional<Pace> pace_;  ///< from the begin of the run on
  Clock::time_point began_{}, now_{}, shown_{};
  Time time_{}, next_tenth_{};
};

}  // namespace stride::cli

#endif
