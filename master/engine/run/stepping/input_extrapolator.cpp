#include "master/engine/run/stepping/input_extrapolator.h"

#include <algorithm>
#include <cmath>

#include "master/base/state_archive.h"
#include "master/engine/run/stepping/own_progress.h"

namespace stride::core {

InputExtrapolator::InputExtrapolator(RunContext& context)
    : exchange_(context.exchange),
      sequential_(context.options.coupling == Coupling::GaussSeidel),
      sources_(context.units.size()),
      steps_(context.units.size()),
      feeds_(context.units.size()) {
  SignalIndices indices;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;  // of feeds, by their ends
  for (const ContinuousLink& link : exchange_.continuous_links()) {
    std::vector<Feed>& feeds = feeds_[link.to.component];
    const std::pair ends(link.from.component, link.to.component);
    const auto [place, is_new] = places.emplace(ends, feeds.size());
    if (is_new) feeds.push_back({link.from.component, {}});
    feeds[place->second].inputs.push_back({signal_of(link, indices),
                                           context.system.variable(link.to).intermediate_update,
                                           link.target, link.conversion});
  }
  for (Source& source : sources_) {
    source.history =
        SignalHistory(source.signals.size(), static_cast<unsigned>(context.options.extrapolation));
  }
}

std::size_t InputExtrapolator::signal_of(const ContinuousLink& link, SignalIndices& indices) {
  Source& source = sources_[link.from.component];
  const auto [index, is_new] = indices.emplace(link.source, source.signals.size());
  if (is_new) {
    source.signals.push_back(link.source);
    source.ids.push_back(link.from);
  }
  return index->second;
}

void InputExtrapolator::sample(Source& source, Time time) {
  const std::span<double> values = source.history.add(time);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = real(source.signals[i]);
}

bool InputExtrapolator::keeps_own_step(std::size_t component) const {
  return own_steps_ != nullptr && own_steps_->keeps(component);
}

bool InputExtrapolator::is_behind(std::size_t component, Time time) const {
  return own_steps_ != nullptr && own_steps_->is_behind(component, time);
}

void InputExtrapolator::accept(Time time, std::span<const char> had_event) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    Source& source = sources_[i];
    if (source.signals.empty() || is_behind(i, time)) continue;
    SignalHistory& history = source.history;
    if (had_event[i]) history.clear();
    // what was read after a step may have changed since, and a step may end where it began
    if (!history.empty() && history.newest() == time) history.remove_newest();
    source.is_ahead = false;
    sample(source, time);
  }
}

void InputExtrapolator::persist(StateArchive& state, Time start, Time now) {
  state.mark("histories");
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Time newest = is_behind(i, now) ? own_steps_->reached(i) : now;
    if (!sources_[i].signals.empty()) sources_[i].history.persist(state, start, newest);
  }
}

void InputExtrapolator::set_targets(const Feed& feed, const SignalHistory& history,
                                    const SignalHistory::Weights& weights, bool within_step) {
  for (const FedInput& input : feed.inputs) {
    if (input.within_step != within_step) continue;
    const double value = history.value(input.signal, weights);
    set_real(input.target, input.conversion.factor * value + input.conversion.offset);
  }
}

void InputExtrapolator::before_step(std::size_t component, const StepInterval& interval) {
  if (feeds_[component].empty()) return;
  steps_[component] = {interval.from, interval.to};
  for (const Feed& feed : feeds_[component]) {
    const Source& source = sources_[feed.source];
    const SignalHistory& history = source.history;
    if (source.is_ahead && source.is_nan) exchange_.check_nan(history.newest());
    set_targets(feed, history, history.mean(interval.from, interval.to), false);
    set_targets(feed, history, history.at(interval.from, 0, interval.to - interval.from), true);
  }
  exchange_.keep_forced(component);
  exchange_.mark_changed(component);
}

void InputExtrapolator::within_step(std::size_t component, Unit& unit, double seconds_into_step) {
  const auto [from, to] = steps_[component];
  for (const Feed& feed : feeds_[component]) {
    const SignalHistory& history = sources_[feed.source].history;
    set_targets(feed, history, history.at(from, seconds_into_step, to - from), true);
  }
  exchange_.keep_forced(component);
  exchange_.write_inputs_within_step(component, unit);
}

void InputExtrapolator::after_step(std::size_t component, Time reached) {
  Source& source = sources_[component];
  if (!sequential_ || source.signals.empty() || source.history.newest() == reached) return;
  sample(source, reached);
  source.is_ahead = true;
  source.is_nan = std::any_of(source.signals.begin(), source.signals.end(),
                              [](const ValueSlice& signal) { return std::isnan(real(signal)); });
}

void InputExtrapolator::undo_step(std::size_t component) {
  Source& source = sources_[component];
  if (!source.is_ahead) return;  // never, with Jacobi, where other threads look at it
  source.history.remove_newest();
  source.is_ahead = false;
}

ExtrapolationError InputExtrapolator::extrapolation_error(Time time, double absolute,
                                                          double relative) {
  ExtrapolationError worst;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    if (source.signals.empty() || keeps_own_step(i)) continue;
    undo_step(i);
    const SignalHistory& history = source.history;
    const SignalHistory::Weights weights = history.at(time, 0, time - history.newest());
    for (std::size_t k = 0; k < source.signals.size(); ++k) {
      const double actual = real(source.signals[k]);
      const double error = std::abs(actual - history.value(k, weights));
      const bool is_relative = std::isfinite(error);  // what becomes infinite is no larger number
      const double tolerance = absolute + (is_relative ? relative * std::abs(actual) : 0);
      const double ratio = error / tolerance;
      if (ratio > worst.ratio) worst = {ratio, source.ids[k]};
    }
  }
  return worst;
}

}  // namespace stride::core
