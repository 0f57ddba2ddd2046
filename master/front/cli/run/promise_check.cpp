#include "master/front/cli/run/promise_check.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "master/base/archive/temporary_folder.h"
#include "master/engine/model/array_element.h"
#include "master/engine/port/observer.h"
#include "master/engine/run/idle/idle_agreement.h"
#include "master/engine/run/simulation.h"
#include "master/front/cli/program/crash_guard.h"
#include "master/front/cli/program/interruption.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/system/plan/instances.h"

namespace stride::cli {
namespace {

double magnitude(double value) { return std::isfinite(value) ? std::abs(value) : 0; }

struct BrokenPromise {
  Time time;
  std::string variable;
  std::string text;
};

/// An output of a unit and of its twin.
class OutputPair {
 public:
  OutputPair(const core::Variable& variable, std::optional<double> tolerance)
      : variable_(variable), tolerance_(tolerance.value_or(0)), offsets_(variable.size) {}

  void follow(const core::Signal& unit, const core::Signal& twin) {
    unit_ = unit;
    twin_ = twin;
  }

  std::optional<BrokenPromise> difference(Time time) {
    for (std::size_t e = 0; e < variable_.size; ++e) {
      if (agrees(e)) continue;
      return BrokenPromise{
          time, core::element_name(variable_, e),
          fmt::format("the value is {}, and {} of an instance with the same inputs that is never "
                      "suspended{}",
                      core::element_text(*unit_.block, unit_.first + e),
                      core::element_text(*twin_.block, twin_.first + e),
                      tolerance_ > 0 ? fmt::format("; the tolerance is {}", tolerance_) : "")};
    }
    return std::nullopt;
  }

  /// A suspension is over.
  void catch_up() {
    if (tolerance_ == 0) return;
    for (std::size_t e = 0; e < variable_.size; ++e) {
      offsets_[e] = magnitude(value(unit_, e) - value(twin_, e));
    }
  }

 private:
  static double value(const core::Signal& signal, std::size_t element) {
    return core::real(*signal.block, signal.first + element);
  }

  bool agrees(std::size_t e) {
    if (core::is_same(*unit_.block, unit_.first + e, *twin_.block, twin_.first + e)) return true;
    if (!core::is_real(variable_.type)) return false;
    const double one = value(unit_, e);
    const double other = value(twin_, e);
    greatest_ = std::max({greatest_, magnitude(one), magnitude(other)});
    return core::agree_when_idle(one, other, tolerance_ + offsets_[e], greatest_);
  }

  const core::Variable& variable_;
  double tolerance_;
  core::Signal unit_, twin_;
  std::vector<double> offsets_;  ///< by element
  double greatest_ = 0;
};

/// An input whose changes within its deadband a unit need not be told.
class DeadbandInput {
 public:
  DeadbandInput(std::size_t size, double deadband) : deadband_(deadband), last_(size) {}

  void follow(const core::Signal& input) {
    input_ = input;
    for (std::size_t e = 0; e < last_.size(); ++e) last_[e] = value(e);
  }

  /// Whether it has made such a change.
  bool wanders() {
    bool any = false;
    for (std::size_t e = 0; e < last_.size(); ++e) {
      const double change = std::abs(value(e) - last_[e]);
      any |= change > 0 && change <= deadband_;
      last_[e] = value(e);
    }
    return any;
  }

 private:
  double value(std::size_t e) const { return core::real(*input_.block, input_.first + e); }

  double deadband_;
  core::Signal input_;
  std::vector<double> last_;
};

/// A tick of an output clock, with what it carries.
struct Sent {
  Time time;
  std::size_t variable;
  std::string value;
};

std::string text_of(const Sent& sent, const core::UnitDescription& unit) {
  const std::string& name = unit.variables[sent.variable].name;
  return sent.value.empty() ? fmt::format("'{}'", name)
                            : fmt::format("'{}' with {}", name, sent.value);
}

/// A unit and its twin.
class UnitPair {
 public:
  /// Once an input has wandered within its deadband, what differs may do so for a `step`.
  UnitPair(const scenario::IdleTwin& components, const core::UnitDescription& unit, Duration step)
      : components_(components), unit_(unit), step_(step) {}

  void add_output(std::size_t variable, std::optional<double> tolerance) {
    outputs_.emplace_back(unit_.variables[variable], tolerance);
  }
  void add_input(std::size_t variable, double deadband) {
    inputs_.emplace_back(unit_.variables[variable].size, deadband);
  }
  /// The signals are those of the inputs, and then of each output and its twin's.
  std::size_t follow(std::span<const core::Signal> signals) {
    std::size_t next = 0;
    for (DeadbandInput& input : inputs_) input.follow(signals[next++]);
    for (OutputPair& output : outputs_) {
      output.follow(signals[next], signals[next + 1]);
      next += 2;
    }
    return next;
  }
  const scenario::IdleTwin& components() const { return components_; }

  void send(std::size_t component, Sent sent) {
    (component == components_.unit ? sent_ : expected_).push_back(std::move(sent));
  }
  void catch_up() { has_caught_up_ = true; }

  /// The first difference that has lasted too long.
  std::optional<BrokenPromise> difference(Time time) {
    for (DeadbandInput& input : inputs_) {
      if (input.wanders()) grace_ = step_;
    }
    std::optional<BrokenPromise> now = message_difference();
    for (OutputPair& output : outputs_) {
      if (!now) now = output.difference(time);
      if (has_caught_up_) output.catch_up();
    }
    has_caught_up_ = false;
    if (!now || !first_) first_ = std::move(now);
    if (first_ && time - first_->time >= grace_) return first_;
    return std::nullopt;
  }

 private:
  std::optional<BrokenPromise> message_difference() {
    while (!sent_.empty() && !expected_.empty()) {
      const Sent& one = sent_.front();
      const Sent& other = expected_.front();
      const bool is_same = one.variable == other.variable && one.value == other.value;
      if (!is_same || std::chrono::abs(one.time - other.time) > grace_) break;
      sent_.pop_front();
      expected_.pop_front();
    }
    if (sent_.empty() && expected_.empty()) return std::nullopt;
    const bool are_both =
        !sent_.empty() && !expected_.empty() && sent_.front().time == expected_.front().time;
    if (are_both) {
      return BrokenPromise{
          sent_.front().time, unit_.variables[sent_.front().variable].name,
          fmt::format("it sends {}, and an instance with the same inputs that is "
                      "never suspended {}",
                      text_of(sent_.front(), unit_), text_of(expected_.front(), unit_))};
    }
    const bool has_more =
        expected_.empty() || (!sent_.empty() && sent_.front().time <= expected_.front().time);
    const Sent& first = has_more ? sent_.front() : expected_.front();
    return BrokenPromise{first.time, unit_.variables[first.variable].name,
                         fmt::format("{} {}, and an instance with the same inputs that is never "
                                     "suspended {}",
                                     has_more ? "it sends" : "it does not send",
                                     text_of(first, unit_), has_more ? "does not" : "does")};
  }

  scenario::IdleTwin components_;
  const core::UnitDescription& unit_;
  Duration step_;
  Duration grace_{};
  std::vector<DeadbandInput> inputs_;
  std::vector<OutputPair> outputs_;
  std::deque<Sent> sent_, expected_;
  bool has_caught_up_ = false;
  std::optional<BrokenPromise> first_;
};

class PromiseCheck : public core::Observer {
 public:
  explicit PromiseCheck(const scenario::RunPlan& loaded)
      : system_(loaded.system()), idle_(loaded.options().idle) {
    for (const scenario::IdleTwin& twin : loaded.idle_twins()) {
      add(twin, loaded.options().step.size.rounded());
    }
  }

  const std::vector<core::VariableId>& signals() const { return signals_; }

  void on_start(std::span<const core::Signal> signals) override {
    for (UnitPair& pair : pairs_) signals = signals.subspan(pair.follow(signals));
  }

  void on_message(const core::Message& message) override {
    const auto found = by_component_.find(message.id.component);
    if (message.received || found == by_component_.end()) return;
    const std::size_t size = system_.variable(message.id).size;
    pairs_[found->second].send(
        message.id.component,
        {message.time, message.id.variable,
         message.block == nullptr ? "" : core::elements_text(*message.block, message.first, size)});
  }

  bool watches_activities() const override { return true; }
  void on_activity(const core::Activity& activity) override {
    if (activity.kind != core::Activity::Kind::Idle) return;
    const auto found = by_component_.find(activity.component);
    if (found != by_component_.end()) pairs_[found->second].catch_up();
  }

  void on_communication_point(Time time) override {
    for (UnitPair& pair : pairs_) {
      const auto difference = pair.difference(time);
      if (!difference) continue;
      core::fail_run(
          {{},
           system_.components()[pair.components().unit].name,
           difference->variable,
           difference->time},
          difference->text,
          "the unit does not keep its promises to be idle; until it is corrected, switch "
          "idle skipping off for it: <stride:IdleSkip components=\"…\" "
          "enabled=\"false\"/>");
    }
  }

 private:
  void add(const scenario::IdleTwin& twin, Duration step) {
    if (!idle_.longest_suspension(system_, twin.unit)) return;
    const core::UnitDescription& unit = *system_.components()[twin.unit].description;
    UnitPair pair(twin, unit, step);
    for (const core::Connection& connection : system_.connections()) {
      const core::VariableId id = connection.to;
      const double deadband = idle_.deadband(system_, id);
      if (id.component != twin.unit || deadband == 0 || !system_.is_signal(id)) continue;
      pair.add_input(id.variable, deadband);
      signals_.push_back(id);
    }
    for (std::size_t i = 0; i < unit.variables.size(); ++i) {
      const core::VariableId id{twin.unit, i};
      if (unit.variables[i].causality != core::Causality::Output) continue;
      if (!system_.is_signal(id) || !system_.is_signal({twin.twin, i})) continue;
      pair.add_output(i, idle_.tolerance(system_, id));
      signals_.insert(signals_.end(), {id, {twin.twin, i}});
    }
    by_component_[twin.unit] = by_component_[twin.twin] = pairs_.size();
    pairs_.push_back(std::move(pair));
  }

  const core::System& system_;
  const core::IdleOptions& idle_;
  std::vector<UnitPair> pairs_;
  std::map<std::size_t, std::size_t> by_component_;  ///< the pair of each component that is in one
  std::vector<core::VariableId> signals_;
};

}  // namespace

void run_beside_twins(scenario::ScenarioRequest request) {
  request.idle_twins = request.no_checks = true;
  request.film.clear();
  request.scene.clear();
  spdlog::set_level(spdlog::level::off);  // the run itself says the same
  const CrashGuard guard;
  const scenario::RunPlan loaded(request);
  const archive::TemporaryFolder folder;
  const recorders::UnitFolders unit_folders(folder.path(), loaded.component_names());
  const LimitedEnd end;
  core::RunOptions options = loaded.options();
  PromiseCheck check(loaded);
  options.recorded.clear();
  options.watched = check.signals();
  options.interrupted = &Interruption::flag();
  core::Simulation simulation(
      loaded.system(), scenario::instantiate(loaded, folder.path(), options.interrupted), options);
  simulation.add_observer(check, check.signals());
  simulation.run();
}

}  // namespace stride::cli
