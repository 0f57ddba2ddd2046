#include "units/mujoco_world/film/film.h"

#include <stdexcept>
#include <utility>

namespace mujoco_world::film {
namespace {

using stride::Duration;
using stride::Time;

FilmSettings checked(const FilmSettings& settings) {
  if (settings.interval > Duration{}) return settings;
  throw std::invalid_argument("the interval of a film is not above 0");
}

}  // namespace

Film::Film(const World& world, const FilmSettings& settings, const std::filesystem::path& folder)
    : world_(world),
      settings_(checked(settings)),
      renderer_(world.model(), settings.view),
      frames_(folder) {}

void Film::begin() {
  if (has_begun_) return;
  frames_.begin();
  has_begun_ = true;
  continue_from_present();
}

void Film::show_display() {
  if (!world_.has_display() || !frames_.ends_at(world_.now())) return;
  if (shown_ != world_.display()) frames_.replace_last(draw());
}

std::optional<std::size_t> Film::pictures() const {
  return has_begun_ ? std::optional(frames_.size()) : std::nullopt;
}

bool Film::go_on(std::optional<std::size_t> pictures) {
  const bool was_here = std::exchange(has_begun_, pictures.has_value());
  if (!has_begun_) return true;
  was_here ? frames_.remove_after(world_.now()) : frames_.adopt(world_.now());
  shown_.reset();  // the picture of the present may be that of a step that was undone
  const bool is_whole = frames_.size() >= *pictures;
  continue_from_present();
  return is_whole;
}

void Film::continue_from_present() {
  next_ = first_multiple_at_or_after(world_.now(), settings_.interval);
  if (next_ > world_.now()) return;
  if (frames_.ends_at(next_)) {
    next_ = stride::later(next_, settings_.interval);
  } else {
    take();
  }
}

std::vector<std::uint8_t> Film::draw() {
  shown_ = world_.display();
  return to_jpeg(renderer_.draw(world_.model(), world_.drawn(), *shown_));
}

void Film::take() {
  frames_.add(next_, draw());
  next_ = stride::later(next_, settings_.interval);
}

}  // namespace mujoco_world::film
