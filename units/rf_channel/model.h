// A packet radio between a reader and tags: frames both ways, no power to live on.
#ifndef STRIDE_UNITS_RF_CHANNEL_MODEL_H
#define STRIDE_UNITS_RF_CHANNEL_MODEL_H

#include <cstdint>
#include <vector>

#include <stride/time.h>

#include "units/channel/model.h"
#include "units/rf_channel/parameters.h"

namespace rf_channel {

/// The coupling is the amplitude that is received over the one that is sent; the field is that of
/// the reader's wave; the tag's voltage is that at its receiver, of 50 Ohm. No power is delivered.
/// The ratios are those of the signal to noise and interference in the receiver's bandwidth.
struct Link : channel::Link {
  double gain = 0.0;  ///< share of the sent power that is received, 0 to 1
};

/// The carrier power is what the reader's radio sends with; with 0 it hears nothing either.
///
/// Each side hands its frames to its radio over a wire, at the frame's bit rate. The radio takes in
/// the whole frame, sends it as one packet as soon as it has no other on the air, and the radio
/// that hears it passes the bits on so that the last comes when the packet has ended. So the
/// receiver gets the frame as it was sent, later by the packet and the way. A frame that its sender
/// cuts short is not sent.
class Channel : public channel::Model<Link> {
 public:
  /// Throws std::invalid_argument, naming the parameter, if one is out of its range.
  explicit Channel(const Parameters& parameters = {});

 protected:
  void move_tag(std::size_t index, const Pose& reader, const Pose& tag, Link& link) override;
  channel::Signals signals(std::size_t tag, double carrier_power) const override;
  double least_signal(channel::Direction direction, std::size_t tag) const override;
  double bit_error_probability(channel::Direction direction, std::size_t tag,
                               std::uint32_t bit_rate, double signal, double others) const override;
  /// Throws std::invalid_argument for a frame that no packet can hold.
  channel::Transit transit(const nfc::Frame& frame, std::size_t tag,
                           stride::Time free) const override;

 private:
  Parameters parameters_;
  double reader_noise_;             // [W]
  std::vector<double> tag_noises_;  // [W]
};

}  // namespace rf_channel

#endif
