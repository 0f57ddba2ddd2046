#ifndef STRIDE_MASTER_FRONT_CLI_TERMINAL_PROGRESS_H
#define STRIDE_MASTER_FRONT_CLI_TERMINAL_PROGRESS_H

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include <stride/time.h>

#include "master/base/sparse_clock.h"
#include "master/engine/port/observer.h"
#include "master/engine/run/simulation.h"

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

/// For people: "12 s".
std::string duration_text(double seconds);

/// The present speed of a run, over the last seconds of the wall clock. It differs from the mean
/// speed, since units are suspended at one time and busy at another.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  Pace(Clock::time_point now, Time time) : last_{now, time} { notes_.fill(last_); }

  /// In the order of both clocks.
  void note(Clock::time_point now, Time time);
  /// Simulated seconds per second of the wall clock; 0 before there are two entries.
  double speed() const;

 private:
  static constexpr std::chrono::milliseconds kInterval{250};
  static constexpr std::size_t kNotes = 20;

  struct Note {
    Clock::time_point wall;
    Time simulated;
  };
  std::array<Note, kNotes> notes_;  ///< a ring
  std::size_t oldest_ = 0;
  Note last_;
};

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

  /// What a style is for the standard error stream as it is.
  enum class Form { Nothing, Rewritten, Lines, Json };
  static Form form_of(ProgressStyle style);
  /// A run goes on where its progress cannot be shown any longer.
  static void put(const std::string& text);

 private:
  using Clock = Pace::Clock;

  struct State {
    double share;                ///< of the run that is simulated, 0 to 1
    double wall;                 ///< elapsed time [s]
    double speed;                ///< simulated seconds in a second
    double skipped;              ///< share of the units' time that was skipped, 0 to 1
    std::optional<double> left;  ///< [s]
  };

  bool is_due(Time time, Clock::time_point now) const;
  State state() const;
  void show(const State& state) const;
  void show_json(const State& state, const std::string* outcome) const;

  Form form_;
  Time start_, stop_;
  const core::Simulation& simulation_;
  std::optional<Pace> pace_;  ///< from the begin of the run on
  core::SparseClock clock_{};
  Clock::time_point began_{}, shown_{};
  Time time_{}, next_tenth_{};
};

}  // namespace stride::cli

#endif
