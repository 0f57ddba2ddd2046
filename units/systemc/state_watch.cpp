#include <algorithm>
#include <functional>

#include <stride/systemc/state_watch.h>

#include "units/systemc/kernel_internals.h"

namespace stride::systemc {
namespace {

/// A level may come and go in each period, as that of a clock does; another value does not.
std::function<std::uint64_t()> state_of(const sc_core::sc_signal_channel& channel) {
  if (auto* level = dynamic_cast<const sc_core::sc_signal_in_if<bool>*>(&channel)) {
    return [level] { return std::uint64_t{level->read()}; };
  }
  if (auto* level = dynamic_cast<const sc_core::sc_signal_in_if<sc_dt::sc_logic>*>(&channel)) {
    return [level] { return static_cast<std::uint64_t>(level->read().value()); };
  }
  return [&channel] { return change_stamp(channel); };
}

}  // namespace

StateWatch::StateWatch(const sc_core::sc_module& module, const unsigned char* bytes,
                       std::size_t size)
    : bytes_(bytes), before_(size), present_(size) {
  landmarks_.push_back({0, &module});
  add_all(sc_core::sc_get_top_level_objects());
  const auto comes_first = [](const Landmark& a, const Landmark& b) { return a.offset < b.offset; };
  std::stable_sort(landmarks_.begin(), landmarks_.end(), comes_first);
}

void StateWatch::add_all(const std::vector<sc_core::sc_object*>& objects) {
  for (const sc_core::sc_object* object : objects) {
    add(*object);
    for (const sc_core::sc_event* event : object->get_child_events()) ignore(event, sizeof *event);
    add_all(object->get_child_objects());
  }
}

void StateWatch::add(const sc_core::sc_object& object) {
  const std::size_t offset = offset_of(dynamic_cast<const void*>(&object));
  const bool is_inside = offset < before_.size();
  if (is_inside) landmarks_.push_back({offset, &object});
  if (const auto* port = dynamic_cast<const sc_core::sc_port_base*>(&object)) {
    const auto* channel = dynamic_cast<const sc_core::sc_signal_channel*>(port->get_interface());
    if (channel != nullptr) ports_.emplace(channel, port->name());
  } else if (const auto* clock = dynamic_cast<const sc_core::sc_clock*>(&object)) {
    ignore(clock, sizeof *clock);
  } else if (const auto* channel = dynamic_cast<const sc_core::sc_signal_channel*>(&object)) {
    ignore(channel, sizeof *channel);
    if (is_inside) return;
    auto state = state_of(*channel);
    signals_.push_back({channel, state, state()});
  }
}

std::size_t StateWatch::offset_of(const void* address) const {
  const auto* const byte = static_cast<const unsigned char*>(address);
  const bool is_before = std::less<>()(byte, bytes_);
  if (is_before || !std::less<>()(byte, bytes_ + before_.size())) return before_.size();
  return static_cast<std::size_t>(byte - bytes_);
}

void StateWatch::ignore(const void* begin, std::size_t size) {
  const std::size_t offset = offset_of(begin);
  if (offset < before_.size())
    ignored_.push_back({offset, std::min(size, before_.size() - offset)});
}

// both, since each notes the present state
bool StateWatch::has_changed() {
  const bool in_bytes = bytes_have_changed();
  const bool in_signals = signals_have_changed();
  return in_bytes || in_signals;
}

bool StateWatch::bytes_have_changed() {
  std::copy_n(bytes_, present_.size(), present_.begin());
  for (const Range& range : ignored_) std::fill_n(present_.begin() + range.begin, range.size, 0);
  const auto change = std::mismatch(present_.begin(), present_.end(), before_.begin()).first;
  if (change == present_.end()) return false;
  place_ = place_at(static_cast<std::size_t>(change - present_.begin()));
  std::swap(before_, present_);
  return true;
}

bool StateWatch::signals_have_changed() {
  bool has_changed = false;
  for (Signal& signal : signals_) {
    const std::uint64_t present = signal.state();
    if (present == signal.before) continue;
    signal.before = present;
    place_ = name_of(*signal.channel);
    has_changed = true;
  }
  return has_changed;
}

std::string StateWatch::name_of(const sc_core::sc_signal_channel& channel) const {
  const auto port = ports_.find(&channel);
  const bool is_outside = channel.get_parent_object() == nullptr;
  return is_outside && port != ports_.end() ? port->second : channel.name();
}

std::string StateWatch::place_at(std::size_t offset) const {
  const auto behind = std::upper_bound(
      landmarks_.begin(), landmarks_.end(), offset,
      [](std::size_t at, const Landmark& landmark) { return at < landmark.offset; });
  return std::prev(behind)->object->name();
}

}  // namespace stride::systemc
