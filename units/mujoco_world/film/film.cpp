#include "units/mujoco_world/film/film.h"

#include <stdexcept>

namespace mujoco_world::film {
namespace {

using stride::Duration;
using stride::Time;

Duration positive(Duration interval) {
  if (interval > Duration{}) return interval;
  throw std::invalid_argument("film.interval is below a picosecond: expected more, or 0 for none");
}

Time first_at_or_after(Time time, Duration interval) {
  const Duration rest = time.time_since_epoch() % interval;
  if (rest == Duration{}) return time;
  return stride::later(time - rest, rest > Duration{} ? interval : Duration{});
}

}  // namespace

Film::Film(const World& world, Duration interval, const View& view,
           const std::filesystem::path& folder)
    : world_(world),
      interval_(positive(interval)),
      renderer_(world.model(), view),
      frames_(folder) {
  go_on();
}

void Film::advance(World& world, Time to) {
  while (next_ <= to) {
    world.advance(next_);
    take();
  }
  world.advance(to);
}

void Film::go_on() {
  frames_.remove_after(world_.now());
  next_ = first_at_or_after(world_.now(), interval_);
  if (next_ > world_.now()) return;
  if (frames_.ends_at(next_)) {
    next_ = stride::later(next_, interval_);
  } else {
    take();
  }
}

void Film::take() {
  frames_.add(next_, to_jpeg(renderer_.draw(world_.model(), world_.drawn())));
  next_ = stride::later(next_, interval_);
}

}  // namespace mujoco_world::film
