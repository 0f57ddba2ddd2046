#include "master/study/results/result_recorders.h"

#include "master/base/files/output_file.h"
#include "master/study/results/checkpoint_states.h"

namespace stride::results {

ResultRecorders::ResultRecorders(const core::System& system, Time stop, const ResultsTarget& target,
                                 Beginning beginning) {
  using Existing = core::OutputFile::Existing;
  const auto& [folder, files] = target;
  const Existing all = beginning == Beginning::Empty ? Existing::Emptied : Existing::Kept;
  const Existing signals = beginning == Beginning::Kept ? Existing::Kept : Existing::Emptied;
  if (!files.signals.empty()) signals_.emplace(system, folder / files.signals, signals);
  if (!files.events.empty()) events_.emplace(system, folder / files.events, all);
  if (!files.trace.empty()) trace_.emplace(system, folder / files.trace, signals, stop);
  if (!files.activity.empty()) activity_.emplace(system, folder / files.activity, all);
}

template <class Visit>
void ResultRecorders::visit(Visit&& visit) {
  if (signals_) visit("signals", *signals_, &recorders::ResultFiles::signals);
  if (events_) visit("events", *events_, &recorders::ResultFiles::events);
  if (trace_) visit("trace", *trace_, &recorders::ResultFiles::trace);
  if (activity_) visit("activity", *activity_, &recorders::ResultFiles::activity);
}

void ResultRecorders::add_to(core::Simulation& simulation) {
  visit([&](const char*, auto& recorder, auto) { simulation.add_observer(recorder); });
}

void ResultRecorders::add_to(checkpoint::Checkpoint& checkpoint) {
  visit([&](const char* name, auto& recorder, auto) { add_state(checkpoint, name, recorder); });
}

void ResultRecorders::restore(const checkpoint::Checkpoint& checkpoint) {
  visit([&](const char* name, auto& recorder, auto) {
    if (recorder.file().is_untouched()) restore_state(checkpoint, name, recorder);
  });
}

void ResultRecorders::go_on() {
  visit([](const char*, auto& recorder, auto) { recorder.file().go_on(); });
}

void ResultRecorders::flush() {
  visit([](const char*, auto& recorder, auto) { recorder.file().flush(); });
}

void ResultRecorders::continue_in_copies(const ResultsTarget& target) {
  visit([&](const char*, auto& recorder, auto file) {
    recorder.file().continue_in_copy(target.folder / target.files.*file);
  });
}

}  // namespace stride::results
