#include "units/channel/air.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "units/channel/noise.h"
#include "units/channel/superposition.h"

namespace channel {
namespace {

using stride::Time;

FrameNumber number_of(const Reception& reception, Direction direction) {
  return {2 * reception.tag + (direction == Direction::Up ? 1 : 0), reception.number};
}

// So that no sum of times overflows; an importer may bring a frame late, but not by an hour.
void require_near(Time start, Time now) {
  constexpr stride::Duration kHour{3'600'000'000'000'000};
  if (start >= now - kHour && start <= now + kHour) return;
  throw std::invalid_argument("a frame begins at " + std::to_string(stride::to_seconds(start)) +
                              " s, and is handed over at " +
                              std::to_string(stride::to_seconds(now)) +
                              " s: expected the instant at which it begins");
}

// Cuts the frame with this start short, if it has not ended.
bool cut(std::vector<Reception>& receptions, const nfc::Frame& frame,
         std::optional<std::uint32_t> tag = std::nullopt) {
  bool found = false;
  for (Reception& reception : receptions) {
    if (reception.sent.start != frame.start || (tag && reception.tag != *tag)) continue;
    reception.cut(frame.bits);
    found = true;
  }
  return found;
}

void add(std::vector<Reception>& receptions, Reception reception) {
  const auto earlier = [](const Reception& a, const Reception& b) {
    return a.transit.begin < b.transit.begin;
  };
  const auto place = std::upper_bound(receptions.begin(), receptions.end(), reception, earlier);
  receptions.insert(place, std::move(reception));
}

Time sent_until(const std::vector<Reception>& receptions, std::size_t tag) {
  Time last = Time::min();
  for (const Reception& reception : receptions) {
    if (reception.tag == tag) last = std::max(last, reception.end - reception.transit.propagation);
  }
  return last;
}

}  // namespace

Air::Air(std::size_t tag_count, const Rules& rules, std::uint64_t seed)
    : rules_(rules), seed_(seed) {
  state_.frames_up.resize(tag_count);
}

Transit Air::transit(const nfc::Frame& frame, std::size_t, Time) const {
  return nominal_transit(frame);
}

std::vector<Reception>& Air::receptions(Direction direction) {
  return direction == Direction::Up ? state_.up : state_.down;
}

Time Air::now() const { return state_.observed.empty() ? Time{} : state_.observed.back().time; }

void Air::observe(Time now) {
  auto& observed = state_.observed;
  if (observed.empty()) return add_observation(now, carrier_power());
  if (now > observed.back().time) {
    decide();
    state_.forgotten += observed.size() - 1;
    observed.erase(observed.begin(), observed.end() - 1);
  }
  const double carrier_before = observed.back().carrier_power;
  if (carrier_before != carrier_power()) add_observation(now, carrier_before);
  add_observation(now, carrier_power());
}

void Air::add_observation(Time now, double carrier_power) {
  Observation added{now, carrier_power, std::vector<Signals>(tag_count())};
  for (std::size_t i = 0; i < tag_count(); ++i) added.signals[i] = signals(i, carrier_power);
  auto& observed = state_.observed;
  if (observed.empty() || !(observed.back() == added)) observed.push_back(std::move(added));
}

// Whatever is known of the bits that have ended.
void Air::decide() {
  for (const Direction direction : {Direction::Down, Direction::Up}) {
    for (Reception& reception : receptions(direction)) decide(reception, direction);
  }
}

void Air::decide(Reception& reception, Direction direction) {
  const auto& observed = state_.observed;
  const Time begin = reception.transit.begin;
  std::uint64_t& next = reception.next_observation;
  next = std::max(next, state_.forgotten);
  for (; next < state_.forgotten + observed.size(); ++next) {
    const auto index = static_cast<std::size_t>(next - state_.forgotten);
    const Observation& observation = observed[index];
    if (observation.time < begin) continue;
    if (observation.time == begin) {
      // what a frame begins with is the last word on that instant
      if (index + 1 == observed.size()) return;
      if (observed[index + 1].time == observation.time) continue;
    }
    decide_bits(reception, direction, index);
  }
}

// Those that have ended since the observation before this one, and what this one ends.
void Air::decide_bits(Reception& reception, Direction direction, std::size_t index) {
  const Observation& observation = state_.observed[index];
  const Time begin = reception.transit.begin;
  if (index > 0 && state_.observed[index - 1].time < begin) {  // it has begun between the two
    reception.lost |=
        is_too_weak(reception, signal_at(begin, index, reception.tag, direction), direction);
  }
  while (!reception.lost && !reception.complete() && reception.next_instant() <= observation.time) {
    decide_next(reception, direction, index);
  }
  const double signal = signal_at(observation.time, index, reception.tag, direction);
  reception.lost |= is_too_weak(reception, signal, direction);
  if (observation.carrier_power == 0.0) reception.end_with_carrier(observation.time);
}

// The next bit, or the header before the first.
void Air::decide_next(Reception& reception, Direction direction, std::size_t index) {
  const double signal = signal_at(reception.next_instant(), index, reception.tag, direction);
  reception.lost = is_too_weak(reception, signal, direction);
  if (reception.lost) return;
  const double others = direction == Direction::Up ? disturbance(reception, index, signal) : 0.0;
  const double error_probability =
      bit_error_probability(direction, reception.tag, reception.sent.bit_rate, signal, others);
  if (!reception.has_header) return hear_header(reception, direction, error_probability);
  const auto bit = static_cast<std::uint32_t>(reception.heard.size());
  const bool is_wrong = uniform(seed_, number_of(reception, direction), bit) < error_probability;
  reception.heard.push_back(reception.sent.bits[bit] ^ (is_wrong ? 1 : 0));
  reception.strongest = std::max(reception.strongest, signal);
}

// Whose header is heard keeps the receiver busy to its end, whatever becomes of its bits.
void Air::hear_header(Reception& reception, Direction direction, double error_probability) {
  constexpr std::uint32_t kHeader = 0xFFFFFFFF;  // in the place of a bit's index
  const double intact = std::pow(1.0 - error_probability, reception.transit.header_bits);
  reception.has_header = true;
  if (uniform(seed_, number_of(reception, direction), kHeader) >= intact) reception.deaf = true;
  if (direction == Direction::Down) return;
  for (Reception& other : state_.up) {
    if (reception.keeps_busy_at(other.transit.begin)) other.deaf = true;
  }
}

bool Air::is_too_weak(const Reception& reception, double signal, Direction direction) const {
  return !(signal > 0.0) || signal < least_signal(direction, reception.tag);
}

// Of tags that are too weak to collide with this one, or of all [W].
double Air::disturbance(const Reception& reception, std::size_t index, double signal) const {
  if (rules_.overlap == Overlap::Pass) return 0.0;
  const Time time = reception.next_instant();
  double power = 0.0;
  for (const Reception& other : state_.up) {
    if (&other == &reception || time <= other.transit.begin || time > other.end) continue;
    const double disturbing = signal_at(time, index, other.tag, Direction::Up);
    const bool is_masked = disturbing * rules_.capture_ratio < signal;
    if (is_masked || rules_.overlap == Overlap::Interfere) power += disturbing;
  }
  return power;
}

// At an instant from the observation before this one up to this one.
double Air::signal_at(Time time, std::size_t index, std::size_t tag, Direction direction) const {
  const auto signal = [&](const Observation& observation) {
    return observation.signals[tag].of(direction);
  };
  const Observation& last = state_.observed[index];
  if (index == 0 || time >= last.time) return signal(last);
  const Observation& first = state_.observed[index - 1];
  if (time <= first.time) return signal(first);
  const double before = signal(first);
  const double after = signal(last);
  if (!(before > 0.0 && after > 0.0)) return 0.0;
  const double share =
      stride::to_seconds(time - first.time) / stride::to_seconds(last.time - first.time);
  return before * std::pow(after / before, share);
}

void Air::from_reader(const nfc::Frame& frame) {
  require_near(frame.start, now());
  if (cut(state_.down, frame)) return;
  const std::uint64_t number = state_.frames_down++;
  for (std::uint32_t tag = 0; tag < tag_count(); ++tag) {
    Reception reception(frame, transit(frame, tag, sent_until(state_.down, tag)), tag, number);
    for (Reception& other : state_.up) {
      if (!rules_.half_duplex || !reception.overlaps(other)) continue;
      other.deaf = true;
      if (other.tag == tag) reception.deaf = true;
    }
    add(state_.down, std::move(reception));
  }
}

void Air::from_tag(std::size_t tag, const nfc::Frame& frame) {
  require_near(frame.start, now());
  const auto index = static_cast<std::uint32_t>(tag);
  if (cut(state_.up, frame, index)) return;
  Reception reception(frame, transit(frame, tag, sent_until(state_.up, tag)), index,
                      state_.frames_up[tag]++);
  for (Reception& other : state_.down) {
    if (!rules_.half_duplex || !reception.overlaps(other)) continue;
    reception.deaf = true;
    if (other.tag == tag) other.deaf = true;
  }
  for (const Reception& other : state_.up) {
    if (other.keeps_busy_at(reception.transit.begin)) reception.deaf = true;
  }
  add(state_.up, std::move(reception));
}

std::optional<nfc::Frame> Air::to_tag(std::size_t tag) {
  decide();
  return take_ended(state_.down, now(), static_cast<std::uint32_t>(tag));
}

std::optional<nfc::Frame> Air::to_reader() {
  decide();
  if (rules_.overlap == Overlap::Superpose) return superposed_at_reader();
  return take_ended(state_.up, now());
}

std::optional<nfc::Frame> Air::superposed_at_reader() {
  for (std::size_t i = 0; i < state_.up.size();) {
    const auto group = overlapping(i);
    if (!group) {
      ++i;
      continue;
    }
    const auto heard = take(*group);
    i = 0;
    if (heard.size() == 1) return heard.front();
    if (!heard.empty()) return superposed(heard);
  }
  return std::nullopt;
}

// The frames that overlap this one or one that overlaps it; nothing as long as one is on the air.
std::optional<std::vector<std::size_t>> Air::overlapping(std::size_t first) const {
  std::vector<std::size_t> group = {first};
  for (std::size_t member = 0; member < group.size(); ++member) {
    const Reception& reception = state_.up[group[member]];
    if (reception.end > now()) return std::nullopt;
    for (std::size_t i = 0; i < state_.up.size(); ++i) {
      const bool known = std::find(group.begin(), group.end(), i) != group.end();
      if (!known && reception.overlaps(state_.up[i])) group.push_back(i);
    }
  }
  std::sort(group.begin(), group.end());
  return group;
}

// Takes the frames off the air, and gives those of them that the reader hears.
std::vector<nfc::Frame> Air::take(const std::vector<std::size_t>& group) {
  double strongest = 0.0;
  for (const std::size_t i : group) strongest = std::max(strongest, state_.up[i].strongest);
  std::vector<nfc::Frame> heard;
  for (const std::size_t i : group) {
    const Reception& reception = state_.up[i];
    const bool masked = reception.strongest * rules_.capture_ratio < strongest;
    if (reception.is_heard() && !masked) heard.push_back(reception.heard_frame());
  }
  for (auto i = group.rbegin(); i != group.rend(); ++i) {
    state_.up.erase(state_.up.begin() + static_cast<std::ptrdiff_t>(*i));
  }
  return heard;
}

std::optional<Time> Air::next_end() {
  decide();
  std::optional<Time> next;
  for (const auto* receptions : {&state_.down, &state_.up}) {
    for (const Reception& reception : *receptions) {
      if (reception.end > now() && (!next || reception.end < *next)) next = reception.end;
    }
  }
  return next;
}

}  // namespace channel
