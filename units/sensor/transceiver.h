// The transceiver: ISO/IEC 14443 type A frames at 106 kbit/s, both ways.
#ifndef STRIDE_UNITS_SENSOR_TRANSCEIVER_H
#define STRIDE_UNITS_SENSOR_TRANSCEIVER_H

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <systemc>

#include <stride/time.h>

#include "units/nfc/frame.h"
#include "units/sensor/command_fifo.h"
#include "units/sensor/parameters.h"

namespace sensor {

struct Answer {
  stride::Time request_end;
  nfc::Bytes data;  ///< status byte and data, without CRC
};

/// What the control unit sees of the transceiver.
class TransmitInterface : public virtual sc_core::sc_interface {
 public:
  virtual bool can_send() const = 0;
  /// Only if can_send().
  virtual void send(const Answer& answer) = 0;
};

struct FrameCounters {
  std::int32_t received = 0;  ///< without error
  std::int32_t rejected =
      0;                  ///< wrong parity, CRC, length or bit rate, or garbled by another frame
  std::int32_t sent = 0;  ///< started
  std::int32_t cut = 0;   ///< started, but power failed before their end
};

/// Half duplex. A frame is received over its air time; one that comes while another is received
/// garbles both, one that comes while the transceiver transmits is rejected. Without power nothing
/// is received or sent, and a reception, an answer or a transmission that was under way is lost.
class Transceiver : public sc_core::sc_module, public TransmitInterface {
 public:
  sc_core::sc_in<bool> powered{"powered"};
  sc_core::sc_out<sc_dt::uint64> received_data{
      "received_data"};                                       ///< its last eight bytes, or fewer
  sc_core::sc_out<sc_dt::uint64> answer_data{"answer_data"};  ///< likewise
  sc_core::sc_out<double> current{"current"};                 ///< [A]

  Transceiver(sc_core::sc_module_name name, const TransceiverParameters& parameters,
              CommandFifo& fifo);

  /// A frame reaches the antenna at frame.start. One whose start is past is taken up now, and still
  /// ends at its own end unless that is past too.
  void arrive(const nfc::Frame& frame);

  /// Called at the instant a frame starts to be sent, which is its `start`.
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

  void run_receiver();
  void begin_reception(const nfc::Frame& frame);
  void finish_reception();
  std::optional<nfc::Bytes> decode(const Reception& reception) const;

  void run_transmitter();
  void begin_transmission();
  void lose_power();

  TransceiverParameters parameters_;
  CommandFifo& fifo_;
  FrameCounters counters_;

  sc_core::sc_event receiver_event_{"receiver_event"};
  std::deque<nfc::Frame> arriving_;  ///< by start
  std::optional<Reception> reception_;

  sc_core::sc_event transmitter_event_{"transmitter_event"};
  std::optional<Answer> answer_;
  stride::Time transmission_end_;
  bool transmitting_ = false;
};

}  // namespace sensor

#endif
