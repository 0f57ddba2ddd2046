#include "master/observe/coverage/coverage.h"

#include <algorithm>
#include <utility>

namespace stride::coverage {
namespace {

/// Those that were not declared are brought into their order.
void take_counts(PointReport& report, const Tally& tally) {
  report.bins.clear();
  for (const Tally::Bin& bin : tally.bins()) {
    BinCount& taken = report.bins.emplace_back(BinCount{bin.name, bin.is_ignored, bin.count});
    if (bin.count > 0) taken.first = to_seconds(bin.first);
  }
  std::sort(report.bins.begin() + static_cast<std::ptrdiff_t>(tally.declared()), report.bins.end(),
            [](const BinCount& a, const BinCount& b) { return bin_order(a.name, b.name); });
}

bool needs_content(const PointDefinition& point) {
  return point.is_text && (point.kind == Kind::Words || point.kind == Kind::Sequences);
}

}  // namespace

Coverage::Coverage(std::vector<GroupDefinition> definitions)
    : definitions_(std::move(definitions)) {
  for (const GroupDefinition& definition : definitions_) {
    Group& group = groups_.emplace_back();
    group.component = definition.component;
    for (const PointDefinition& point : definition.points) add_point(group, point);
  }
}

void Coverage::add_point(Group& group, const PointDefinition& definition) {
  if (is_of_signal(definition.kind)) {
    auto point = std::make_unique<SignalPoint>(definition);
    group.signals.push_back(point.get());
    group.points.push_back(std::move(point));
  } else if (definition.kind != Kind::Cross) {
    auto point = std::make_unique<MessagePoint>(definition);
    group.messages.push_back(point.get());
    group.points.push_back(std::move(point));
  } else {
    std::vector<const Point*> parts;
    for (const std::size_t part : definition.of) parts.push_back(group.points[part].get());
    auto point = std::make_unique<CrossPoint>(definition, std::move(parts));
    (point->event() != nullptr ? group.message_crosses : group.value_crosses)
        .push_back(point.get());
    group.points.push_back(std::move(point));
  }
}

std::vector<core::VariableId> Coverage::signals() const {
  std::vector<core::VariableId> ids;
  for (const Group& group : groups_) {
    for (const SignalPoint* point : group.signals) ids.push_back(point->definition().id);
  }
  return ids;
}

void Coverage::on_start(std::span<const core::Signal> signals) {
  std::size_t next = 0;
  for (Group& group : groups_) {
    for (SignalPoint* point : group.signals) point->attach(signals[next++]);
  }
}

bool Coverage::wants_content() const {
  return std::ranges::any_of(definitions_, [](const GroupDefinition& group) {
    return std::ranges::any_of(group.points, needs_content);
  });
}

void Coverage::on_message(const core::Message& message) {
  for (Group& group : groups_) {
    if (group.component != message.id.component) continue;
    for (MessagePoint* point : group.messages) {
      if (point->definition().id == message.id) point->on_message(message);
    }
    for (CrossPoint* cross : group.message_crosses) {
      if (*cross->event() == message.id) cross->visit(message.time);
    }
  }
}

bool Coverage::is_suspended(std::size_t component) const {
  return simulation_ != nullptr && simulation_->was_suspended(component);
}

void Coverage::on_communication_point(Time time) {
  for (Group& group : groups_) {
    if (group.has_sample) commit(group);
    group.has_sample = !group.signals.empty() && !is_suspended(group.component);
    if (!group.has_sample) continue;
    for (SignalPoint* point : group.signals) point->sample();
    group.sampled_at = time;
  }
}

/// A step has begun with what was sampled.
void Coverage::commit(Group& group) {
  bool any = false;
  for (SignalPoint* point : group.signals) any |= point->commit(group.sampled_at);
  if (!any) return;
  for (CrossPoint* cross : group.value_crosses) cross->visit_changed(group.sampled_at);
}

void Coverage::persist(core::StateArchive& state) {
  state.mark("coverage");
  state.fixed(groups_, [&](Group& group) {
    state.fixed(group.points, [&](const std::unique_ptr<Point>& point) { point->persist(state); });
    state.value(group.has_sample);
    state.value(group.sampled_at);
  });
}

Report Coverage::report(std::string scenario) const {
  Report report = empty_report(std::move(scenario), definitions_, 1);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    for (std::size_t k = 0; k < groups_[i].points.size(); ++k) {
      take_counts(report.groups[i].points[k], groups_[i].points[k]->tally());
    }
  }
  return report;
}

}  // namespace stride::coverage
