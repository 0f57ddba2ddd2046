#include "master/engine/run/events/interventions.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace stride::core {

Interventions::Interventions(RunContext& context, EventHandler& event_handler)
    : system_(context.system),
      units_(context.units),
      exchange_(context.exchange),
      observers_(context.observers),
      event_handler_(event_handler) {
  for (const Intervention& intervention : context.options.interventions) plan(intervention);
  sort();
}

void Interventions::plan(const Intervention& intervention) {
  changes_.push_back({intervention.from, &intervention, false});
  if (intervention.until) changes_.push_back({*intervention.until, &intervention, true});
}

void Interventions::sort() {
  // at one instant the ends come first, since another one may begin there
  std::ranges::stable_sort(
      changes_, {}, [](const Change& change) { return std::tuple(change.time, !change.is_end); });
}

void Interventions::add(std::vector<Intervention> interventions, Time earliest) {
  for (Intervention& intervention : interventions) {
    if (intervention.from < earliest) {
      throw std::logic_error("an intervention is added that would have begun already");
    }
    plan(added_.emplace_back(std::move(intervention)));
  }
  sort();
}

void Interventions::go_on(Time now) {
  for (; made_ < changes_.size() && changes_[made_].time <= now; ++made_) {
    const auto& [time, intervention, is_end] = changes_[made_];
    if (!disturbs_messages(intervention->kind)) continue;
    is_end ? event_handler_.release(*intervention) : event_handler_.disturb(*intervention);
  }
}

void Interventions::make_all(Time time) {
  for (; is_due(time); ++made_) {
    const Change& change = changes_[made_];
    change.is_end ? end(*change.intervention, time) : begin(*change.intervention, time);
  }
  exchange_.route(time);
}

void Interventions::make_sets(std::span<const Intervention> sets, Time time) {
  for (const Intervention& intervention : sets) set(intervention, time);
}

void Interventions::begin(const Intervention& intervention, Time time) {
  if (intervention.kind == Intervention::Kind::Set) return set(intervention, time);
  if (!disturbs_messages(intervention.kind)) return force(intervention, time);
  event_handler_.disturb(intervention);
  report(intervention, time, to_text(intervention));
}

void Interventions::set(const Intervention& intervention, Time time) {
  const std::size_t i = intervention.id.component;
  if (system_.components()[i].description->has_event_mode) {
    event_handler_.set_in_event(intervention.id, *intervention.value);
  } else {
    event_handler_.catch_up(i, time);
    units_[i]->set({&variable(intervention).reference, 1}, *intervention.value);
  }
  report(intervention, time, to_text(intervention, system_, *intervention.value));
}

void Interventions::force(const Intervention& intervention, Time time) {
  const ValueBlock value =
      intervention.value ? *intervention.value : exchange_.value(intervention.id);
  event_handler_.catch_up(intervention.id.component, time);
  exchange_.force(intervention.id, value);
  event_handler_.request_event(intervention.id.component);
  report(intervention, time, to_text(intervention, system_, value));
}

void Interventions::end(const Intervention& intervention, Time time) {
  if (disturbs_messages(intervention.kind)) {
    event_handler_.release(intervention);
    return report(intervention, time, "messages are received as they are sent");
  }
  event_handler_.catch_up(intervention.id.component, time);
  exchange_.release(intervention.id);
  event_handler_.request_event(intervention.id.component);
  report(intervention, time, "released");
}

void Interventions::report(const Intervention& intervention, Time time,
                           const std::string& text) const {
  for (Observer* observer : observers_) observer->on_intervention(time, 0, intervention.id, text);
}

}  // namespace stride::core
