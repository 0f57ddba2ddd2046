#include "units/nfc_channel/model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "units/nfc_channel/noise.h"

namespace nfc_channel {
namespace {

using stride::Time;

constexpr double kPi = 3.14159265358979323846;
constexpr std::array<std::uint32_t, 4> kBitRates = {106, 212, 424, 848};

std::size_t index_of(std::uint32_t bit_rate) {
  return static_cast<std::size_t>(std::find(kBitRates.begin(), kBitRates.end(), bit_rate) -
                                  kBitRates.begin());
}

FrameNumber down_number(const Reception& reception) {
  return {2 * reception.tag, reception.number};
}
FrameNumber up_number(const Reception& reception) {
  return {2 * reception.tag + 1, reception.number};
}

const Parameters& checked(const Parameters& parameters) {
  check(parameters);
  return parameters;
}

void require_pose(const std::string& coil, const Pose& pose) {
  const auto finite = [](const Eigen::Vector3d& v) { return v.array().isFinite().all(); };
  if (!finite(pose.position)) {
    throw std::invalid_argument("the position of " + coil + " is not finite: expected metres");
  }
  if (!finite(pose.axis) || !(pose.axis.norm() > 0.0)) {
    throw std::invalid_argument("the axis of " + coil +
                                " is no direction: expected a finite normal vector, its length "
                                "not zero");
  }
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

void take_bit(Reception& reception, double signal, double error_probability, std::uint64_t seed,
              FrameNumber frame) {
  const auto index = static_cast<std::uint32_t>(reception.heard.size());
  const bool wrong = uniform(seed, frame, index) < error_probability;
  reception.heard.push_back(reception.sent.bits[index] ^ (wrong ? 1 : 0));
  reception.strongest = std::max(reception.strongest, signal);
}

// Cuts the frame with this start short, if it is on the air.
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

}  // namespace

Channel::Channel(const Parameters& parameters)
    : parameters_(checked(parameters)),
      reader_noise_density_(noise_density(parameters.reader.noise)),
      capture_ratio_(std::pow(10.0, parameters.reader.capture_ratio / 10.0)) {
  const ReaderAntenna reader(parameters.reader.coil, parameters.reader.capacitance);
  for (const TagParameters& tag : parameters.tags) {
    const Circuit circuit(reader, tag.coil, tag.chip);
    Tag added{tag, circuit, {}, {}, nfc_channel::noise_density(tag.noise)};
    for (std::size_t i = 0; i < kBitRates.size(); ++i) {
      added.down[i] = down_signal(kBitRates[i], reader.quality, circuit.tag_quality());
      added.up[i] = up_signal(kBitRates[i], reader.quality, circuit.tag_quality());
    }
    tags_.push_back(added);
  }
  links_.resize(tags_.size());
  state_.frames_up.resize(tags_.size());
}

void Channel::move(const Pose& reader_coil, const std::vector<Pose>& tag_coils,
                   double carrier_power) {
  if (!(carrier_power >= 0.0 && std::isfinite(carrier_power))) {
    throw std::invalid_argument("carrier_power is " + std::to_string(carrier_power) +
                                " W: expected 0 or more");
  }
  require_pose("reader_coil", reader_coil);
  carrier_power_ = carrier_power;
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    require_pose(tags_[i].parameters.coil_name(), tag_coils[i]);
    move_tag(i, reader_coil, tag_coils[i]);
  }
}

void Channel::move_tag(std::size_t index, const Pose& reader_coil, const Pose& tag_coil) {
  const Tag& tag = tags_[index];
  const Coil& coil = tag.parameters.coil;
  Link& link = links_[index];
  link.distance = (tag_coil.position - reader_coil.position).norm();
  link.mutual = mutual_inductance(parameters_.reader.coil, reader_coil, coil, tag_coil);
  link.coupling = coupling_factor(parameters_.reader.coil, coil, link.mutual);

  const Operation operation = tag.circuit.operate(link.mutual, carrier_power_);
  const double flux = std::abs(link.mutual * operation.reader_current) / coil.turns;
  link.field_strength =
      flux / (kVacuumPermeability * kPi * coil.radius * coil.radius) / std::sqrt(2.0);
  link.tag_voltage = std::abs(operation.tag_voltage);
  link.tag_power = tag.circuit.in_load(operation);

  link.signals = signals(index, carrier_power_);
  const std::size_t rate = index_of(parameters_.bit_rate);
  link.snr_down = signal_to_noise(link.signals.down, tag.down[rate], tag.noise_density);
  link.snr_up = signal_to_noise(link.signals.up, tag.up[rate], reader_noise_density_);
  link.bit_error_rate_down = bit_error_probability(link.snr_down, tag.down[rate].coherent);
  link.bit_error_rate_up = bit_error_probability(link.snr_up, tag.up[rate].coherent);
}

Signals Channel::signals(std::size_t index, double carrier_power) const {
  const Circuit& circuit = tags_[index].circuit;
  const double mutual = links_[index].mutual;
  return {circuit.in_load(circuit.operate(mutual, carrier_power, false)),
          sideband_power(circuit, mutual, circuit.operate(mutual, carrier_power))};
}

Time Channel::now() const { return state_.observed.empty() ? Time{} : state_.observed.back().time; }

void Channel::observe(Time now) {
  auto& observed = state_.observed;
  if (observed.empty()) return add_observation(now, carrier_power_);
  if (now > observed.back().time) {
    decide();
    state_.forgotten += observed.size() - 1;
    observed.erase(observed.begin(), observed.end() - 1);
  }
  const double carrier_before = observed.back().carrier_power;
  if (carrier_before != carrier_power_) add_observation(now, carrier_before);
  add_observation(now, carrier_power_);
}

void Channel::add_observation(Time now, double carrier_power) {
  Observation added{now, carrier_power, std::vector<Signals>(tags_.size())};
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    added.signals[i] =
        carrier_power == carrier_power_ ? links_[i].signals : signals(i, carrier_power);
  }
  auto& observed = state_.observed;
  if (observed.empty() || !(observed.back() == added)) observed.push_back(std::move(added));
}

// Whatever can be said of the bits that have ended.
void Channel::decide() {
  for (Reception& reception : state_.down) decide(reception, false);
  for (Reception& reception : state_.up) decide(reception, true);
}

void Channel::decide(Reception& reception, bool up) const {
  const auto& observed = state_.observed;
  std::uint64_t& next = reception.next_observation;
  next = std::max(next, state_.forgotten);
  for (; next < state_.forgotten + observed.size(); ++next) {
    const auto index = static_cast<std::size_t>(next - state_.forgotten);
    const Observation& observation = observed[index];
    if (observation.time < reception.sent.start) continue;
    if (observation.time == reception.sent.start) {
      // what a frame begins with is the last word on that instant
      if (index + 1 == observed.size()) return;
      if (observed[index + 1].time == observation.time) continue;
    }
    decide_bits(reception, up, index);
  }
}

// Those that have ended since the observation before this one, and what this one ends.
void Channel::decide_bits(Reception& reception, bool up, std::size_t index) const {
  const Observation& observation = state_.observed[index];
  const Time start = reception.sent.start;
  if (index > 0 && state_.observed[index - 1].time < start) {  // it has entered late
    reception.lost |= is_too_weak(reception, signal_at(start, index, reception.tag, up), up);
  }
  while (!reception.lost && !reception.complete() && reception.next_bit_end() <= observation.time) {
    decide_bit(reception, up, index);
  }
  const double signal = signal_at(observation.time, index, reception.tag, up);
  reception.lost |= is_too_weak(reception, signal, up);
  if (observation.carrier_power == 0.0) reception.end_with_carrier(observation.time);
}

void Channel::decide_bit(Reception& reception, bool up, std::size_t index) const {
  const Tag& tag = tags_[reception.tag];
  const std::size_t rate = index_of(reception.sent.bit_rate);
  const BitSignal& bit = up ? tag.up[rate] : tag.down[rate];
  const double signal = signal_at(reception.next_bit_end(), index, reception.tag, up);
  reception.lost = is_too_weak(reception, signal, up);
  if (reception.lost) return;
  const double noise =
      up ? reader_noise_density_ + interference(reception, index, signal) : tag.noise_density;
  take_bit(reception, signal,
           bit_error_probability(signal_to_noise(signal, bit, noise), bit.coherent),
           parameters_.seed, up ? up_number(reception) : down_number(reception));
}

bool Channel::is_too_weak(const Reception& reception, double signal, bool up) const {
  const double least =
      up ? parameters_.reader.sensitivity : tags_[reception.tag].parameters.power_threshold;
  return !(signal > 0.0) || signal < least;
}

// Tags that are too weak to collide with this one are noise to it [W/Hz].
double Channel::interference(const Reception& reception, std::size_t index, double signal) const {
  const Time time = reception.next_bit_end();
  double power = 0.0;
  for (const Reception& other : state_.up) {
    if (&other == &reception || time <= other.sent.start || time > other.end) continue;
    const double disturbance = signal_at(time, index, other.tag, true);
    if (disturbance * capture_ratio_ < signal) power += disturbance;
  }
  return power / kInterferenceBandwidth;
}

// At an instant from the observation before this one up to this one.
double Channel::signal_at(Time time, std::size_t index, std::size_t tag, bool up) const {
  const auto signal = [&](const Observation& observation) {
    return up ? observation.signals[tag].up : observation.signals[tag].down;
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

void Channel::from_reader(const nfc::Frame& frame) {
  require_near(frame.start, now());
  if (cut(state_.down, frame)) return;
  const std::uint64_t number = state_.frames_down++;
  for (std::uint32_t tag = 0; tag < tags_.size(); ++tag) {
    Reception reception(frame, tag, number);
    for (Reception& other : state_.up) {
      if (!reception.overlaps(other)) continue;
      other.deaf = true;
      if (other.tag == tag) reception.deaf = true;
    }
    state_.down.push_back(std::move(reception));
  }
}

void Channel::from_tag(std::size_t tag, const nfc::Frame& frame) {
  require_near(frame.start, now());
  const auto index = static_cast<std::uint32_t>(tag);
  if (cut(state_.up, frame, index)) return;
  Reception reception(frame, index, state_.frames_up[tag]++);
  for (Reception& other : state_.down) {
    if (!reception.overlaps(other)) continue;
    reception.deaf = true;
    if (other.tag == tag) other.deaf = true;
  }
  state_.up.push_back(std::move(reception));
}

std::optional<nfc::Frame> Channel::to_tag(std::size_t tag) {
  decide();
  for (std::size_t i = 0; i < state_.down.size();) {
    Reception& candidate = state_.down[i];
    if (candidate.tag != tag || candidate.end > now()) {
      ++i;
      continue;
    }
    const Reception reception = std::move(candidate);
    state_.down.erase(state_.down.begin() + static_cast<std::ptrdiff_t>(i));
    if (reception.is_heard()) return reception.heard_frame();
  }
  return std::nullopt;
}

std::optional<nfc::Frame> Channel::to_reader() {
  decide();
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
std::optional<std::vector<std::size_t>> Channel::overlapping(std::size_t first) const {
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
std::vector<nfc::Frame> Channel::take(const std::vector<std::size_t>& group) {
  double strongest = 0.0;
  for (const std::size_t i : group) strongest = std::max(strongest, state_.up[i].strongest);
  std::vector<nfc::Frame> heard;
  for (const std::size_t i : group) {
    const Reception& reception = state_.up[i];
    const bool masked = reception.strongest * capture_ratio_ < strongest;
    if (reception.is_heard() && !masked) heard.push_back(reception.heard_frame());
  }
  for (auto i = group.rbegin(); i != group.rend(); ++i) {
    state_.up.erase(state_.up.begin() + static_cast<std::ptrdiff_t>(*i));
  }
  return heard;
}

std::optional<Time> Channel::next_end() {
  decide();
  std::optional<Time> next;
  for (const auto* receptions : {&state_.down, &state_.up}) {
    for (const Reception& reception : *receptions) {
      if (reception.end > now() && (!next || reception.end < *next)) next = reception.end;
    }
  }
  return next;
}

}  // namespace nfc_channel
