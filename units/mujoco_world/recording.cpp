#include "units/mujoco_world/recording.h"

#include <algorithm>

namespace mujoco_world {

using stride::Duration;
using stride::Time;

namespace {

template <class Visit>
void for_each(const Recordings& recordings, Visit visit) {
  for (Recording* recording : recordings) {
    if (recording != nullptr) visit(*recording);
  }
}

}  // namespace

bool advance(World& world, const Recordings& recordings, Time to, bool stops_at_contacts) {
  bool wants_contacts = stops_at_contacts;
  for_each(recordings, [&](Recording& recording) {
    recording.begin();
    recording.show_display();
    wants_contacts = wants_contacts || recording.wants_contact_changes();
  });
  while (true) {
    Time next = to;
    for_each(recordings, [&](Recording& recording) { next = std::min(next, recording.next()); });
    const bool has_changed = world.advance(next, wants_contacts);
    for_each(recordings, [&](Recording& recording) {
      if (has_changed) recording.see_contact_change();
      if (recording.next() == world.now()) recording.take();
    });
    if (has_changed && stops_at_contacts) return true;
    if (world.now() == to) return false;
  }
}

Time first_multiple_at_or_after(Time time, Duration interval) {
  const Duration rest = time.time_since_epoch() % interval;
  if (rest == Duration{}) return time;
  return stride::later(time - rest, rest > Duration{} ? interval : Duration{});
}

}  // namespace mujoco_world
