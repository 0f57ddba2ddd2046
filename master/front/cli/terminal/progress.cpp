#include "master/front/cli/terminal/progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "master/base/error.h"

namespace stride::cli {
namespace {

using namespace std::chrono_literals;

/// Between two updates of a line that is rewritten.
constexpr auto kRefresh = 100ms;
/// A log gets a line at each tenth of a run, within these bounds.
constexpr auto kLeastPause = 1s;
constexpr auto kMostPause = 30s;

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

ProgressStyle read_progress_style(const std::string& text) {
  if (text == "auto") return ProgressStyle::Auto;
  if (text == "plain") return ProgressStyle::Plain;
  if (text == "json") return ProgressStyle::Json;
  if (text == "none") return ProgressStyle::None;
  core::fail_input({}, fmt::format("--progress {}: there is no such style", text),
                   "it is auto, plain, json or none");
}

void Pace::note(Clock::time_point now, Time time) {
  last_ = {now, time};
  const Note& newest = notes_[(oldest_ + kNotes - 1) % kNotes];
  if (now - newest.wall < kInterval) return;
  notes_[oldest_] = last_;
  oldest_ = (oldest_ + 1) % kNotes;
}

double Pace::speed() const {
  const Note& before = notes_[oldest_];
  const double wall = std::chrono::duration<double>(last_.wall - before.wall).count();
  return wall > 0 ? to_seconds(last_.simulated - before.simulated) / wall : 0;
}

Progress::Progress(ProgressStyle style, Time start, Time stop, const core::Simulation& simulation)
    : form_(form_of(style)), start_(start), stop_(stop), simulation_(simulation), time_(start) {}

Progress::Form Progress::form_of(ProgressStyle style) {
  switch (style) {
    case ProgressStyle::Auto:
      return isatty(STDERR_FILENO) != 0 ? Form::Rewritten : Form::Lines;
    case ProgressStyle::Plain:
      return Form::Lines;
    case ProgressStyle::Json:
      return Form::Json;
    case ProgressStyle::None:
      break;
  }
  return Form::Nothing;
}

void Progress::on_start(std::span<const core::Signal>) {
  began_ = shown_ = Clock::now();
  clock_ = core::SparseClock(began_);
  pace_.emplace(began_, start_);
  next_tenth_ = start_ + (stop_ - start_) / 10;
}

void Progress::on_communication_point(Time time) {
  if (form_ == Form::Nothing) return;
  time_ = time;
  if (!clock_.read()) return;
  pace_->note(clock_.now(), time);
  if (!is_due(time, clock_.now())) return;
  show(state());
  shown_ = clock_.now();
  const Duration tenth = std::max((stop_ - start_) / 10, Duration(1));
  next_tenth_ = time + (tenth - (time - start_) % tenth);
}

bool Progress::is_due(Time time, Clock::time_point now) const {
  const auto pause = now - shown_;
  if (form_ != Form::Lines) return pause >= kRefresh || time == start_;
  return pause >= kMostPause || (pause >= kLeastPause && time >= next_tenth_);
}

void Progress::end(const std::string& outcome) {
  if (form_ == Form::Nothing || !pace_) return;
  State last = state();
  last.left.reset();
  last.wall = std::chrono::duration<double>(Clock::now() - began_).count();
  last.speed = last.wall > 0 ? to_seconds(time_ - start_) / last.wall : 0;  // of all of it
  if (form_ == Form::Json) return show_json(last, &outcome);
  show(last);
  if (form_ == Form::Rewritten) put("\n");
}

Progress::State Progress::state() const {
  const double done = to_seconds(time_ - start_);
  const double whole = to_seconds(stop_ - start_);
  const double units = static_cast<double>(simulation_.statistics().units.size());
  State state{whole > 0 ? done / whole : 1,
              std::chrono::duration<double>(clock_.now() - began_).count(), pace_->speed(),
              done > 0 ? to_seconds(simulation_.suspended_time()) / (done * units) : 0.0,
              std::nullopt};
  if (state.speed > 0 && time_ < stop_) state.left = to_seconds(stop_ - time_) / state.speed;
  return state;
}

void Progress::put(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void Progress::show(const State& state) const {
  if (form_ == Form::Json) return show_json(state, nullptr);
  std::string line =
      fmt::format("{:5.1f} % of {:.6g} s simulated", 100 * state.share, to_seconds(stop_ - start_));
  if (state.speed > 0) line += fmt::format(", {:.3g} times real time", state.speed);
  if (state.skipped > 0) line += fmt::format(", {:.1f} % skipped", 100 * state.skipped);
  if (state.left) line += fmt::format(", {} left", duration_text(*state.left));
  put(form_ == Form::Rewritten ? fmt::format("\r{}\033[K", line) : line + "\n");
}

void Progress::show_json(const State& state, const std::string* outcome) const {
  nlohmann::ordered_json object = {{"time", to_seconds(time_)}, {"start", to_seconds(start_)},
                                   {"stop", to_seconds(stop_)}, {"share", state.share},
                                   {"wall_time", state.wall},   {"speed", state.speed},
                                   {"skipped", state.skipped},  {"left", nullptr}};
  if (state.left) object["left"] = *state.left;
  if (outcome != nullptr) object["outcome"] = *outcome;
  put(object.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace stride::cli
