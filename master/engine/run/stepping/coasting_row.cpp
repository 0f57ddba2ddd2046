#include "master/engine/run/stepping/coasting_row.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "master/base/wall_clock.h"

namespace stride::core {
namespace {

std::vector<StepValues> values_of(std::span<const CoastingRow::Member> members) {
  std::vector<StepValues> values;
  values.reserve(members.size());
  for (const CoastingRow::Member& member : members) values.push_back(member.values);
  return values;
}

}  // namespace

CoastingRow::CoastingRow(std::unique_ptr<UnitRow> row, std::span<const Member> members)
    : row_(std::move(row)),
      members_(members.begin(), members.end()),
      log_(values_of(members)),
      interval_(interval_of(members)) {
  log_.make_room(interval_.most());
  for (std::size_t i = 0; i < members_.size(); ++i) {
    members_[i].unit->set_row(this, i, members_[i].values);
  }
}

CoastingRow::~CoastingRow() {
  for (const Member& member : members_) member.unit->set_row(nullptr, 0, {});
}

/// No more steps than the logs of the units have room for.
SaveInterval CoastingRow::interval_of(std::span<const Member> members) const {
  constexpr SaveInterval::NoteCosts kOfUnit{.near = 2, .cramped = 4, .far = 5};
  SaveInterval interval = members.front().unit->interval();
  interval.set_note_costs(kOfUnit * static_cast<double>(members.size()));
  std::size_t cache = 0;
  for (const Member& member : members) {
    interval.limit(member.unit->interval().most());
    cache += member.unit->cache();
  }
  interval.limit(CoastingUnit::kMostBytes * members.size() / log_.step_size());
  interval.set_near(cache / log_.step_size());
  return interval;
}

bool CoastingRow::step(const StepInterval& interval, Progress& progress) {
  interval_.count_step();
  ++steps_;
  if (log_.end() >= settled_until_) [[unlikely]]
    return step_unsettled(interval, progress);
  const bool is_plain = row_->step(log_.begin_step(interval, true), progress);
  log_.end_step();
  return is_plain || conclude(progress);
}

void CoastingRow::release() {
  for (const Member& member : members_) member.unit->leave_row();
  row_->release();
}

void CoastingRow::count_rollback() {
  if (std::exchange(rolled_back_, steps_) != steps_) interval_.count_rollback();
}

bool CoastingRow::are_all_due() const {
  return std::ranges::all_of(members_,
                             [](const Member& member) { return member.unit->is_save_due(); });
}

bool CoastingRow::step_unsettled(const StepInterval& interval, Progress& progress) {
  const bool are_all = are_all_due();
  if (are_all) {
    for (const Member& member : members_) member.unit->drop_row();
    log_.restart();
  }
  const std::size_t stretch = interval_.begin_stretch();
  const bool is_measured = are_all && interval_.is_measured();
  log_.begin_step(interval, true);
  if (is_measured) [[unlikely]] {
    step_next_measured(stretch, interval, progress);
  } else {
    step_next(stretch, interval, progress);
  }
  log_.end_step();
  const bool is_plain = progress.plain == members_.size();
  if (is_plain) settle();
  return is_plain || conclude(progress);
}

void CoastingRow::step_next(std::size_t stretch, const StepInterval& interval, Progress& progress) {
  for (; progress.plain < members_.size(); ++progress.plain) {
    const auto& [unit, values] = members_[progress.plain];
    unit->join_row(stretch);
    progress.result = unit->step_in_row(interval, values);
    if (!progress.result.reached_without_request(interval.to)) return;
  }
}

/// Saves take some nanoseconds only, so what it takes to read the clock is left out.
void CoastingRow::step_next_measured(std::size_t stretch, const StepInterval& interval,
                                     Progress& progress) {
  const auto now = interval_.now();
  SaveInterval::Cost save{}, step{};
  for (; progress.plain < members_.size(); ++progress.plain) {
    const auto& [unit, values] = members_[progress.plain];
    const auto before = now();
    const auto began = now();
    unit->join_row(stretch);
    const auto saved = now();
    progress.result = unit->step_in_row(interval, values);
    const auto reading = began - before;
    save += saved - began - reading;
    step += now() - saved - reading;
    if (!progress.result.reached_without_request(interval.to)) return;
  }
  interval_.add_costs(save, step);
}

/// Until the first one is due.
void CoastingRow::settle() {
  settled_until_ = std::numeric_limits<std::uint64_t>::max();
  for (const Member& member : members_) {
    settled_until_ = std::min(settled_until_, member.unit->due_in_row());
  }
}

/// Of a step that is noted, and that not all of them have just made. Returns false.
bool CoastingRow::conclude(const Progress& progress) {
  if (progress.plain == members_.size()) return true;
  const StepResult& result = progress.result;
  if (result.rejected || result.early_return) count_rollback();  // of those before it
  members_[progress.plain].unit->end_step_in_row(result);
  for (const Member& member : std::span(members_).subspan(progress.plain + 1)) {
    member.unit->leave_before_step();
  }
  return false;
}

}  // namespace stride::core
