#include "units/sensor/transceiver.h"

#include <algorithm>
#include <utility>

#include <stride/nfc/frame_delay.h>
#include <stride/nfc/iso14443a.h>
#include <stride/systemc/time.h>

namespace sensor {
namespace {

using stride::systemc::current_time;

constexpr std::uint32_t kBitRate = 106;  // the only one before others have been agreed on

sc_dt::uint64 as_number(const nfc::Bytes& bytes) {
  sc_dt::uint64 number = 0;
  for (const std::uint8_t byte : bytes) number = number << 8 | byte;
  return number;
}

stride::Time end_of(const nfc::Frame& frame) { return frame.start + nfc::air_time(frame); }

}  // namespace

Transceiver::Transceiver(sc_core::sc_module_name name, const TransceiverParameters& parameters,
                         double carrier_power, CommandFifo& fifo)
    : sc_module(name), parameters_(parameters), carrier_power_(carrier_power), fifo_(fifo) {
  SC_HAS_PROCESS(Transceiver);
  SC_METHOD(detect_carrier);
  sensitive << field_power;
  SC_METHOD(run_receiver);
  sensitive << powered << receiver_timer_.event();
  SC_METHOD(run_transmitter);
  sensitive << powered << field_power << transmitter_timer_.event();
}

bool Transceiver::idle() const { return arriving_.empty() && !reception_ && !answer_ && !on_air_; }

bool Transceiver::has_carrier() const { return field_power.read() >= carrier_power_; }

void Transceiver::detect_carrier() { carrier.write(has_carrier()); }

void Transceiver::arrive(const nfc::Frame& frame) {
  const auto later = [](const nfc::Frame& a, const nfc::Frame& b) { return a.start < b.start; };
  arriving_.insert(std::upper_bound(arriving_.begin(), arriving_.end(), frame, later), frame);
  receiver_timer_.set(current_time());
}

void Transceiver::run_receiver() {
  const stride::Time now = current_time();
  if (!powered.read()) reception_.reset();
  if (powered.read() && !was_powered_) powered_since_ = now;
  was_powered_ = powered.read();
  for (;;) {
    if (reception_ && reception_->end <= now) {
      finish_reception();
    } else if (!arriving_.empty() && arriving_.front().start <= now) {
      const nfc::Frame frame = std::move(arriving_.front());
      arriving_.pop_front();
      begin_reception(frame);
    } else {
      break;
    }
  }
  stride::Time next = stride::Time::max();
  if (reception_) next = reception_->end;
  if (!arriving_.empty()) next = std::min(next, arriving_.front().start);
  receiver_timer_.cancel();
  if (next != stride::Time::max()) receiver_timer_.set(next);
}

void Transceiver::begin_reception(const nfc::Frame& frame) {
  if (!powered.read() || frame.start < powered_since_) return;
  const stride::Time end = std::max(end_of(frame), current_time());
  if (reception_ && reception_->frame.start == frame.start) {
    reception_ = Reception{frame, end, reception_->garbled};
  } else if (overlaps_transmission(frame) || frame.start < received_until_) {
    ++counters_.rejected;
  } else if (reception_) {
    ++counters_.rejected;
    reception_->garbled = true;
    reception_->end = std::max(reception_->end, end);
  } else {
    reception_ = Reception{frame, end, false};
  }
}

bool Transceiver::overlaps_transmission(const nfc::Frame& frame) const {
  return frame.start < transmission_end_ && end_of(frame) > transmission_start_;
}

void Transceiver::finish_reception() {
  const Reception reception = *std::exchange(reception_, std::nullopt);
  received_until_ = end_of(reception.frame);
  const std::optional<nfc::Bytes> data = decode(reception);
  if (!data) {
    ++counters_.rejected;
    return;
  }
  ++counters_.received;
  received_data.write(as_number(*data));
  fifo_.push({end_of(reception.frame), nfc::first_answer_start(reception.frame), *data});
}

std::optional<nfc::Bytes> Transceiver::decode(const Reception& reception) const {
  if (reception.garbled || reception.frame.bit_rate != kBitRate) return std::nullopt;
  const std::optional<nfc::Bytes> bytes = nfc::to_bytes(reception.frame.bits);
  return bytes ? nfc::without_crc(*bytes) : std::nullopt;
}

void Transceiver::send(const Answer& answer) {
  answer_ = answer;
  transmitter_timer_.set(current_time());
}

void Transceiver::run_transmitter() {
  if (!powered.read() || !has_carrier()) return stop_transmitter();
  const stride::Time now = current_time();
  if (on_air_ && now >= transmission_end_) finish_transmission();
  stride::Time next = on_air_ ? transmission_end_ : stride::Time::max();
  if (answer_ && !on_air_) {
    next =
        nfc::answer_start(answer_->first_start, reception_ ? std::max(now, reception_->end) : now);
    if (next == now) {
      begin_transmission();
      next = transmission_end_;
    }
  }
  transmitter_timer_.cancel();
  if (next != stride::Time::max()) transmitter_timer_.set(next);
}

void Transceiver::begin_transmission() {
  nfc::Frame frame;
  frame.start = current_time();
  frame.bits = nfc::to_bits(nfc::with_crc(answer_->data));
  answer_data.write(as_number(answer_->data));
  answer_.reset();
  current.write(parameters_.transmit_current);
  on_air_ = frame;
  transmission_start_ = frame.start;
  transmission_end_ = end_of(frame);
  ++counters_.sent;
  if (on_transmit) on_transmit(frame);
}

void Transceiver::finish_transmission() {
  on_air_.reset();
  current.write(0);
}

void Transceiver::stop_transmitter() {
  transmitter_timer_.cancel();
  if (answer_) ++counters_.dropped;
  answer_.reset();
  if (!on_air_) return;
  const nfc::Frame rest = nfc::cut_off(*on_air_, current_time());
  const bool complete = rest.bits.size() == on_air_->bits.size();
  transmission_end_ = current_time();
  finish_transmission();
  if (complete) return;
  ++counters_.cut;
  if (on_transmit) on_transmit(rest);
}

}  // namespace sensor
