#include "master/engine/run/unit_counters.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"

namespace stride::core {

UnitCounters::UnitCounters(const RunContext& context, const std::vector<CoastingUnit*>& coasting,
                           const Stepper& stepper)
    : context_(context), coasting_(coasting), stepper_(stepper), ignored_(context.units.size()) {}

void UnitCounters::resume() {
  for (std::size_t i = 0; i < ignored_.size(); ++i) {
    const auto* const diagnostics = context_.units[i]->capability<UnitDiagnostics>();
    const auto* const process = context_.units[i]->capability<HostDiagnostics>();
    if (diagnostics != nullptr) ignored_[i].calls = diagnostics->calls();
    if (process == nullptr) continue;
    const HostStatistics host = process->host_statistics();
    ignored_[i].snapshots = host.snapshots;
    ignored_[i].restores = host.restores;
  }
}

void UnitCounters::add_to(RunStatistics& statistics) const {
  for (std::size_t i = 0; i < statistics.units.size(); ++i) {
    UnitStatistics& unit = statistics.units[i];
    add_counted_by_unit(i, unit);
    unit.steps = stepper_.steps(i) + unit.suspensions;
    if (coasting_[i] == nullptr) continue;
    const CoastingUnit::Counts& counts = coasting_[i]->counts();
    unit.saves = counts.saves;
    unit.repeated_steps = counts.repeated_steps;
    unit.inexact_repetition = counts.inexact_repetition;
  }
}

void UnitCounters::add_counted_by_unit(std::size_t component, UnitStatistics& statistics) const {
  Unit& unit = *context_.units[component];
  const Counts& ignored = ignored_[component];
  const auto* const diagnostics = unit.capability<UnitDiagnostics>();
  if (diagnostics != nullptr) statistics.calls += diagnostics->calls() - ignored.calls;
  const auto* const process = unit.capability<HostDiagnostics>();
  if (process == nullptr) return;
  const HostStatistics earlier =
      std::exchange(statistics.host, std::nullopt).value_or(HostStatistics{});
  HostStatistics& host = statistics.host.emplace(process->host_statistics());
  host.snapshots += earlier.snapshots - ignored.snapshots;
  host.restores += earlier.restores - ignored.restores;
  host.most_snapshots = std::max(host.most_snapshots, earlier.most_snapshots);
  host.most_snapshot_memory = std::max(host.most_snapshot_memory, earlier.most_snapshot_memory);
  host.most_memory = std::max(host.most_memory, earlier.most_memory);
}

}  // namespace stride::core
