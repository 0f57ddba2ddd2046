// The transceiver: ISO/IEC 14443 type A frames at 106 kbit/s, both ways.
#ifndef STRIDE_UNITS_SENSOR_TRANSCEIVER_H
#define STRIDE_UNITS_SENSOR_TRANSCEIVER_H

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <systemc>

#include <stride/nfc/frame.h>
#include <stride/systemc/timer.h>
#include <stride/time.h>

#include "units/sensor/command_fifo.h"
#include "units/sensor/parameters.h"

namespace sensor {

struct Answer {
  stride::Time first_start;  ///< of the grid on which it may start, see nfc::first_answer_start()
  nfc::Bytes data;           ///< status byte and data, without CRC
};

/// The part of the transceiver that the control unit uses.
class TransmitInterface : public virtual sc_core::sc_interface {
 public:
  virtual bool can_send() const = 0;
  /// Only if can_send().
  virtual void send(const Answer& answer) = 0;
};

struct FrameCounters {
  std::int32_t received = 0;  ///< without error
  std::int32_t rejected =
      0;                     ///< wrong parity, CRC, length or bit rate, or garbled by another frame
  std::int32_t sent = 0;     ///< started
  std::int32_t cut = 0;      ///< of these, cut off because power or carrier failed
  std::int32_t dropped = 0;  ///< answers not started, because power or carrier was missing
};

/// Half duplex. A frame is received if there was power from its start to its end. Where two
/// overlap, the later one is garbled, and the earlier one too if it has not been received yet; one
/// that overlaps an own transmission is rejected.
///
/// An answer is made by modulating the reader's carrier. Without one it is not begun, and it ends
/// where the carrier, or the power, ends.
class Transceiver : public sc_core::sc_module, public TransmitInterface {
 public:
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_in<double> field_power{"field_power"};  ///< that the antenna can give [W]
  sc_core::sc_out<bool> carrier{"carrier"};           ///< whether there is one, powered or not
  sc_core::sc_out<sc_dt::uint64> received_data{
      "received_data"};                                       ///< its last eight bytes, or fewer
  sc_core::sc_out<sc_dt::uint64> answer_data{"answer_data"};  ///< likewise
  sc_core::sc_out<double> current{"current"};                 ///< [A]

  /// `carrier_power`: field power from which on there is a carrier [W]; 0: it has one of its own.
  Transceiver(sc_core::sc_module_name name, const TransceiverParameters& parameters,
              double carrier_power, CommandFifo& fifo);

  /// A frame from the air, at any instant from its start on: it is received at its end, or now if
  /// that is past. A frame with the start of one that is still being received takes its place.
  void arrive(const nfc::Frame& frame);

  /// Called at the instant at which a frame starts to be sent, which is its `start`; and again, if
  /// it is cut off, with the bits that got out.
  std::function<void(const nfc::Frame&)> on_transmit;

  const FrameCounters& counters() const { return counters_; }
  /// Nothing is being received or sent and nothing waits for it.
  bool idle() const;

  bool can_send() const override { return !answer_.has_value(); }
  void send(const Answer& answer) override;

 private:
  struct Reception {
    nfc::Frame frame;
    stride::Time end;
    bool garbled = false;
  };

  bool has_carrier() const;
  void detect_carrier();

  void run_receiver();
  void begin_reception(const nfc::Frame& frame);
  void finish_reception();
  bool overlaps_transmission(const nfc::Frame& frame) const;
  std::optional<nfc::Bytes> decode(const Reception& reception) const;

  void run_transmitter();
  void begin_transmission();
  void finish_transmission();
  void stop_transmitter();

  TransceiverParameters parameters_;
  double carrier_power_;
  CommandFifo& fifo_;
  FrameCounters counters_;

  stride::systemc::Timer receiver_timer_{"receiver_timer"};
  std::deque<nfc::Frame> arriving_;  ///< by start
  std::optional<Reception> reception_;
  stride::Time received_until_;  ///< the end of the last reception
  bool was_powered_ = false;
  stride::Time powered_since_;

  stride::systemc::Timer transmitter_timer_{"transmitter_timer"};
  std::optional<Answer> answer_;
  std::optional<nfc::Frame> on_air_;
  stride::Time transmission_start_;  ///< of the last one
  stride::Time transmission_end_;
};

}  // namespace sensor

#endif
