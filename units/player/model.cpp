#include "units/player/model.h"

namespace player {

bool Playback::is_before_run(stride::Time start) const {
  const Entry& entry = next();
  if (entry.kind == Entry::Kind::End) return false;
  if (entry.kind == Entry::Kind::Step) return after_next().time <= start;
  const bool is_event = entry.kind == Entry::Kind::Tick || entry.event > Entry::kAtStepEnd;
  return entry.time < start || (entry.time == start && !is_event);
}

/// A step is over where something follows it.
bool Playback::is_due(stride::Time now) const {
  const Entry& entry = next();
  switch (entry.kind) {
    case Entry::Kind::End:
      return false;
    case Entry::Kind::Step:
      return after_next().time <= now;
    case Entry::Kind::Tick:
      if (ticked_[entry.input]) return false;
      break;
    case Entry::Kind::Value:
    case Entry::Kind::Jump:
      break;
  }
  return entry.time < now || (entry.time == now && entry.event <= position_.iteration);
}

bool Playback::has_more(stride::Time now) const {
  const Entry& entry = next();
  const bool is_stimulus = entry.kind != Entry::Kind::Step && entry.kind != Entry::Kind::End;
  return is_stimulus && entry.time <= now;
}

std::optional<stride::Time> Playback::target() const {
  if (next().kind == Entry::Kind::Step) return next().target;
  return following();
}

std::optional<stride::Time> Playback::following() const {
  if (next().kind == Entry::Kind::End) return std::nullopt;
  return next().kind == Entry::Kind::Step ? after_next().time : next().time;
}

/// What is behind its time, and points where the captured unit had none.
void Playback::note_irregular(stride::Time now) {
  if (next().kind != Entry::Kind::Step) return;
  const Entry& after = after_next();
  if (after.time < now && after.kind != Entry::Kind::End && position_.late < 0) {
    position_.late = static_cast<std::int64_t>(position_.next + 1);
  }
  if (now < after.time && next().time < now && position_.beside == kNowhere) {
    position_.beside = now;
  }
}

}  // namespace player
