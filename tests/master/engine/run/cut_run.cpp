#include "tests/master/engine/run/cut_run.h"

#include <csignal>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::tests {
namespace {

/// The instance belongs to another simulation once `is_over`.
class LentUnit : public core::Unit {
 public:
  LentUnit(std::shared_ptr<core::Unit> unit, std::shared_ptr<const bool> is_over)
      : unit_(std::move(unit)), is_over_(std::move(is_over)) {}

  void enter_initialization(Time start, std::optional<Time> stop) override {
    unit().enter_initialization(start, stop);
  }
  void exit_initialization() override { unit().exit_initialization(); }
  void get(std::span<const core::ValueReference> references, core::ValueBlock& values) override {
    unit().get(references, values);
  }
  void set(std::span<const core::ValueReference> references,
           const core::ValueBlock& values) override {
    unit().set(references, values);
  }
  core::StepResult step(const core::StepInterval& interval) override {
    return unit().step(interval);
  }
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override {
    return unit().step(interval, values);
  }
  void enter_event_mode() override { unit().enter_event_mode(); }
  core::EventResult update_discrete_states() override { return unit().update_discrete_states(); }
  void enter_step_mode() override { unit().enter_step_mode(); }
  void terminate() override {
    if (!*is_over_) unit_->terminate();
  }
  void free() override {
    if (!*is_over_) unit_->free();
  }

 private:
  core::Unit& unit() {
    if (*is_over_) throw std::logic_error("a unit is called behind the end of its simulation");
    return *unit_;
  }
  core::Capability* find_capability(core::CapabilityId id) override {
    return unit_->capability(id);
  }

  std::shared_ptr<core::Unit> unit_;
  std::shared_ptr<const bool> is_over_;
};

std::vector<std::unique_ptr<core::Unit>> lend(const SharedUnits& units,
                                              const std::shared_ptr<const bool>& is_over) {
  std::vector<std::unique_ptr<core::Unit>> lent;
  for (const auto& unit : units) lent.push_back(std::make_unique<LentUnit>(unit, is_over));
  return lent;
}

/// Ends a simulation that has handed its units over.
struct HandOver {};

/// Writes the state at its pause.
class Cutter : public core::RunControl {
 public:
  Cutter(core::Simulation& simulation, const std::optional<core::Pause>& pause, const Trace& trace)
      : simulation_(simulation), pause_(pause), trace_(trace) {}

  std::optional<core::Pause> next(Time) override { return pause_; }
  void on_pause(Time) override { hand_over(); }
  void on_interruption(Time) override { hand_over(); }

  std::vector<std::byte> state;
  std::size_t traced = 0;
  std::shared_ptr<bool> is_over = std::make_shared<bool>(false);

 private:
  [[noreturn]] void hand_over() {
    core::StateArchive archive;
    simulation_.persist(archive);
    state = archive.bytes();
    traced = trace_.text().size();
    *is_over = true;
    throw HandOver();
  }

  core::Simulation& simulation_;
  std::optional<core::Pause> pause_;
  const Trace& trace_;
};

/// Interrupts the run at a point.
class Interrupter : public core::Observer {
 public:
  explicit Interrupter(std::size_t point) : point_(point) {}
  void on_communication_point(Time) override {
    if (count_++ == point_) flag = 1;
  }
  volatile std::sig_atomic_t flag = 0;

 private:
  std::size_t point_;
  std::size_t count_ = 0;
};

void run_or_resume(core::Simulation& simulation, const std::vector<std::byte>& state) {
  if (state.empty()) return simulation.run();
  core::StateArchive archive(state);
  simulation.resume(archive, [&] { archive.end(); });
}

}  // namespace

void Trace::on_start(std::span<const core::Signal> signals) {
  signals_.assign(signals.begin(), signals.end());
}

void Trace::on_message(const core::Message& message) {
  text_ += fmt::format("{}/{} {} {} {}\n", core::to_text(message.time), message.index,
                       system_.full_name(message.id), message.received,
                       message.block != nullptr ? core::elements_text(*message.block) : "");
}

void Trace::on_intervention(Time time, std::uint32_t index, core::VariableId id,
                            std::string_view text) {
  text_ += fmt::format("{}/{} {} {}\n", core::to_text(time), index, system_.full_name(id), text);
}

void Trace::on_activity(const core::Activity& activity) {
  text_ += fmt::format("{} {} {}-{}\n", activity.component, static_cast<int>(activity.kind),
                       core::to_text(activity.from), core::to_text(activity.until));
}

void Trace::on_communication_point(Time time) {
  if (points_.size() >= most_points) core::fail_run({}, "there are too many points");
  points_.push_back(time);
  text_ += core::to_text(time);
  for (const core::Signal& signal : signals_) {
    const std::size_t size = system_.variable(signal.id).size;
    text_ += ' ' + core::elements_text(*signal.block, signal.first, size);
  }
  text_ += '\n';
}

SharedUnits share(std::vector<std::unique_ptr<core::Unit>> units) {
  return {std::make_move_iterator(units.begin()), std::make_move_iterator(units.end())};
}

std::vector<std::byte> CutRun::up_to(const core::Pause& pause, const core::RunOptions& options,
                                     const std::vector<std::byte>& state) {
  return cut(pause, options, state, nullptr);
}

std::vector<std::byte> CutRun::up_to_point(std::size_t point, core::RunOptions options) {
  Interrupter interrupter(point);
  options.interrupted = &interrupter.flag;
  return cut(std::nullopt, options, {}, &interrupter);
}

std::vector<std::byte> CutRun::cut(const std::optional<core::Pause>& pause,
                                   const core::RunOptions& options,
                                   const std::vector<std::byte>& state, core::Observer* observer) {
  const auto is_over = std::make_shared<bool>(false);
  core::Simulation simulation(system, lend(units, is_over), options);
  simulation.add_observer(trace);
  if (observer != nullptr) simulation.add_observer(*observer);
  Cutter cutter(simulation, pause, trace);
  cutter.is_over = is_over;
  simulation.set_control(cutter);
  try {
    run_or_resume(simulation, state);
  } catch (const HandOver&) {
    trace.cut(cutter.traced);
  } catch (const core::Error& error) {
    trace.note(error);
  }
  return cutter.state;
}

core::RunStatistics CutRun::from(const std::vector<std::byte>& state,
                                 const core::RunOptions& options) {
  core::Simulation simulation(system, lend(units, std::make_shared<bool>(false)), options);
  simulation.add_observer(trace);
  try {
    run_or_resume(simulation, state);
  } catch (const core::Error& error) {
    trace.note(error);
  }
  return simulation.statistics();
}

}  // namespace stride::tests
